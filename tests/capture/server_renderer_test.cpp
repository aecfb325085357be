// A program that is started once and asked by lines.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "base/confine.h"
#include "capture/files/capture_folder.h"
#include "capture/renderers/process_renderer.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

class Server : public TestFolder {
 protected:
  void SetUp() override {
    scene_.name = "group/scene";
    scene_.frame.width = 4;
    scene_.frame.height = 2;
    Capture c;
    c.renderer = "inside";
    c.width = 4;
    c.height = 2;
    c.planes.depth = {4, 2, 0.5};
    write_capture(c, root_ / "good");
  }
  /// Each start leaves a line in `starts`; `answer` is run for each line, with the folders $in and $out.
  std::unique_ptr<Renderer> server(const std::string& answer) const {
    ProcessSpec spec;
    spec.name = "outside";
    spec.argv = {"sh", "-c",
                 "echo >> '" + (root_ / "starts").string() + "'; tab=$(printf '\\t'); good='" +
                     (root_ / "good").string() + "'; while IFS=\"$tab\" read -r in out; do " + answer + "; done"};
    spec.serves = true;
    spec.timeout = std::chrono::milliseconds{2000};
    spec.write_input = [](const Scene& scene, const fs::path& folder) {
      fs::create_directory(folder);
      test::write_text(folder / "name", scene.name);
    };
    return make_process_renderer(std::move(spec));
  }
  std::string failure(Renderer& renderer) const {
    try {
      renderer.capture(scene_, {});
    } catch (const RendererFailed& error) {
      return error.what();
    } catch (const Unsupported& reason) {
      return std::string("unsupported: ") + reason.what();
    }
    return "it did not fail";
  }
  std::size_t starts() const { return test::text_of(root_ / "starts").size(); }

  Scene scene_;
};

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST_F(Server, IsStartedOnceAndHandsOnEachScene) {
  const auto renderer =
      server("test \"$(cat \"$in/name\")\" = \"$(echo group/scene)\" && cp \"$good\"/* \"$out\"; echo ok");
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(renderer->capture(scene_, {}).planes.depth.values(), Plane<double>::Values(8, 0.5));
  EXPECT_EQ(starts(), 1u);
}

TEST_F(Server, MayEndItsLinesInCrLf) {
  const auto renderer = server(
      "n=$((n+1)); case $n in 1) printf 'unsupported no fog here\\r\\n';; "
      "*) cp \"$good\"/* \"$out\"; printf 'ok\\r\\n';; esac");
  EXPECT_EQ(failure(*renderer), "unsupported: no fog here");
  EXPECT_EQ(failure(*renderer), "it did not fail");
}

TEST_F(Server, SaysWhatItCannotDrawAndGoesOn) {
  const auto renderer = server(
      "n=$((n+1)); case $n in 1) echo unsupported no fog here;; 2) echo failed out of ink;; "
      "3) echo unsupported;; *) cp \"$good\"/* \"$out\"; echo ok;; esac");
  EXPECT_EQ(failure(*renderer), "unsupported: no fog here");
  EXPECT_HAS(failure(*renderer), "failed: out of ink");
  EXPECT_EQ(failure(*renderer), "unsupported: outside gave no reason");
  EXPECT_EQ(failure(*renderer), "it did not fail");
  EXPECT_EQ(starts(), 1u);
}

TEST_F(Server, IsStartedAgainWhereItEndedHungOrSpokeNonsense) {
  const std::string good = "cp \"$good\"/* \"$out\"; echo ok";
  for (const auto& [bad, words] :
       {std::pair("echo the end >&2; exit 3", "exited with status 3\nthe end of its stderr:\nthe end"),
        std::pair("kill -SEGV $$", "was killed by signal 11"),
        std::pair("sleep 60", "took longer than 2s and was killed"),
        std::pair("cp \"$good\"/* \"$out\"; sleep 60", "killed: it left a capture, and no line of answer on stdout"),
        std::pair("echo hello", "answered \"hello\", expected ok, unsupported REASON or"),
        std::pair("printf '\\377\\033[31m\\n'", "answered \"\xef\xbf\xbd?[31m\", expected ok"),
        std::pair("exit 0", "ended without an answer"), std::pair("echo ok", "left no capture that can be read")}) {
    const fs::path mark = root_ / "mark";
    fs::remove(mark);
    const auto renderer = server("if [ -e '" + mark.string() + "' ]; then " + good + "; else : > '" + mark.string() +
                                 "'; " + bad + "; fi");
    EXPECT_HAS(failure(*renderer), words);
    EXPECT_EQ(failure(*renderer), "it did not fail") << bad;
  }
}

TEST_F(Server, IsSlowWhereItsManifestIsNotWhole) {
  const std::string how = failure(*server("printf '{' > \"$out/manifest.json\"; sleep 60"));
  EXPECT_HAS(how, "took longer than 2s and was killed");
  EXPECT_EQ(how.find("no line of answer"), std::string::npos) << how;
}

TEST_F(Server, AnAnswerBeforeTheQuestionIsNotTakenForTheNext) {
  const auto renderer = server("cp \"$good\"/* \"$out\"; printf 'ok\\nok\\n'");
  EXPECT_EQ(failure(*renderer), "it did not fail");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // until the second has arrived
  EXPECT_HAS(failure(*renderer), "answered before it was asked, and was killed");
  EXPECT_EQ(failure(*renderer), "it did not fail") << "it is started again";
}

TEST_F(Server, ThatEndsWithStatus77CannotDrawTheScene) {
  const auto renderer = server("if [ $(wc -l < '" + (root_ / "starts").string() +
                               "') = 1 ]; then echo no fog here >&2; exit 77; fi; cp \"$good\"/* \"$out\"; echo ok");
  EXPECT_EQ(failure(*renderer), "unsupported: no fog here");
  EXPECT_EQ(failure(*renderer), "it did not fail") << "it is started again";
  EXPECT_EQ(starts(), 2u);
}

TEST_F(Server, ItsAnswersAreShort) {
  EXPECT_HAS(failure(*server("head -c 200000 /dev/zero | tr '\\0' x; sleep 60")),
             "answered with more than 65536 bytes, where ok, unsupported REASON or failed REASON was expected");
}

TEST_F(Server, EndsWithItsRenderer) {
  const fs::path pid = root_ / "pid";
  {
    const auto renderer = server("echo $$ > '" + pid.string() + "'; cp \"$good\"/* \"$out\"; echo ok");
    EXPECT_EQ(failure(*renderer), "it did not fail");
  }
  pid_t server = 0;
  std::ifstream(pid) >> server;
  ASSERT_GT(server, 1);
  EXPECT_NE(::kill(server, 0), 0);
}

class Confined : public Server {
 protected:
  // Run once, with the folder for the capture as $1.
  std::unique_ptr<Renderer> program(const std::string& script) const {
    ProcessSpec spec;
    spec.name = "outside";
    spec.argv = {"sh", "-c", script + "; cp '" + (root_ / "good").string() + "'/* \"$1\"", "sh", "{output}"};
    spec.confined = true;
    return make_process_renderer(std::move(spec));
  }
};

TEST_F(Confined, WritesInItsOwnFolderAlone) {
  const fs::path elsewhere = root_ / "elsewhere";
  EXPECT_EQ(failure(*program("echo mine > \"$TMPDIR/file\" && echo > /dev/null || exit 5")), "it did not fail");
  if (!can_confine()) GTEST_SKIP() << "this kernel refuses no writes";
  for (const std::string& bad : std::vector<std::string>{
           "echo > '" + elsewhere.string() + "'", "mkdir '" + elsewhere.string() + "'",
           "ln -s /etc '" + elsewhere.string() + "'", "setsid sh -c \"echo > '" + elsewhere.string() + "'\""}) {
    EXPECT_EQ(failure(*program(bad + " && exit 6")), "it did not fail") << bad;
    EXPECT_FALSE(fs::exists(fs::symlink_status(elsewhere))) << bad;
  }
}

TEST_F(Confined, AFileBeyondTheBudgetEndsIt) {
  Request request;
  request.memory_budget = std::size_t{1} << 20;
  try {
    program("head -c 2000000 /dev/zero > \"$1\"/huge || exit 4")->capture(scene_, request);
    FAIL() << "it did not fail";
  } catch (const RendererFailed& error) {
    EXPECT_HAS(std::string(error.what()), "exited with status 4");
  }
}

TEST_F(Confined, ALinkIsNoCapture) {
  EXPECT_HAS(failure(*program("ln -s /etc/passwd \"$1\"/planes.color.bin")),
             "left a link, planes.color.bin, where a file was expected");
}

}  // namespace
}  // namespace plumbline
