// plumb golden as a user meets it: what is told, what is refused, what is written, and how a run ends.
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <random>
#include <thread>

#include <fmt/format.h>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

// A suite of four small scenes, and goldens of theirs made of the project's own: no reference need be asked.
class GoldenCommand : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    const std::string project = test::text_of(PLUMBLINE_SOURCE_DIR "/golden/manifest.json");
    std::string manifest = project.substr(0, project.find("\"scenes\": {") + 11);
    for (const char* scene :
         {"cull/both_windings", "coverage/shared_edges", "depth/on_clear", "frame/one_pixel_float"}) {
      fs::create_directories((folder_ / "suite" / scene).parent_path());
      fs::copy(kScenes + scene + ".json", folder_ / "suite" / (scene + std::string(".json")));
      fs::create_directories(folder_ / "golden" / scene);
      fs::copy(std::string(PLUMBLINE_SOURCE_DIR "/golden/") + scene, folder_ / "golden" / scene);
      const std::size_t line = project.find(fmt::format("\n\"{}\": ", scene));  // each has a line
      manifest += (manifest.ends_with('}') ? "," : "") + project.substr(line, project.find("},\n", line) + 1 - line);
    }
    test::write_text(folder_ / "golden/manifest.json", manifest + "}}\n");
    test::write_text(folder_ / "golden/tolerances.json", "{}");
  }
  Outcome golden(const std::string& verb, const std::string& more = "") const {
    return plumb("golden " + verb + " --suite " + at("suite") + " --golden " + at("golden") + " " + more);
  }
  void change_scene(const std::string& from, const std::string& to) const {
    std::string text = test::text_of(scene());
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos);
    test::write_text(scene(), text.replace(place, from.size(), to));
  }
  fs::path scene() const { return folder_ / "suite/cull/both_windings.json"; }
  fs::path file(const std::string& kind, const std::string& of = "cull/both_windings") const {
    for (const auto& entry : fs::directory_iterator(folder_ / "golden" / of)) {
      if (entry.path().filename().string().starts_with(kind)) return entry.path();
    }
    return {};
  }
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "golden")) {
      if (entry.is_regular_file()) out[entry.path().string()] = test::text_of(entry.path());
    }
    return out;
  }
};

TEST_F(GoldenCommand, CheckHoldsAndEnds0) {
  const Outcome run = golden("check");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("ok: ")) << run.text;
}

TEST_F(GoldenCommand, FilesThatAreNotWhatTheManifestSaysAreFailures) {
  const std::string picture = test::text_of(file("color"));
  for (const auto& [what, bytes] :
       std::map<std::string, std::string>{{"truncated", picture.substr(0, picture.size() / 2)},
                                          {"a bit", std::string(picture).replace(60, 1, "~")},
                                          {"empty", ""}}) {
    test::write_text(file("color"), bytes);
    const Outcome run = golden("check", scene().string());
    EXPECT_EQ(run.code, 1) << what << run.text;
    EXPECT_TRUE(run.says(file("color").string() + ": expected the ")) << what << run.text;
    EXPECT_TRUE(run.says("different cull/both_windings")) << what << run.text;
  }
  fs::remove(file("color"));
  const Outcome run = golden("check", scene().string());
  EXPECT_EQ(run.code, 1);
  EXPECT_TRUE(run.says("is not there")) << run.text;
}

TEST_F(GoldenCommand, UpdateMakesABrokenFileAnew) {
  const auto before = files();
  const fs::path broken[] = {file("color"), file("depth", "coverage/shared_edges"), file("stages", "depth/on_clear")};
  for (const fs::path& one : broken) test::write_text(one, "");
  const Outcome update = golden("update");
  EXPECT_EQ(update.code, 1) << update.text;
  for (const fs::path& one : broken) {
    EXPECT_TRUE(test::text_of(one) == before.at(one.string())) << "the same bytes, on any day: " << one;
  }
  EXPECT_EQ(golden("check").code, 0);
}

TEST_F(GoldenCommand, AnExtraFileIsAFailureWhatAKillLeftIsNot) {
  test::write_text(folder_ / "golden/cull/both_windings/.plumb-1-2", "half");
  test::write_text(folder_ / "golden/cull/both_windings/color.0123456789abcdef.png", "half");
  const Outcome left = golden("check");
  EXPECT_EQ(left.code, 0) << left.text;
  EXPECT_TRUE(left.says("2 files are left of an update")) << left.text;
  test::write_text(folder_ / "golden/cull/notes.txt", "mine");
  const Outcome extra = golden("check");
  EXPECT_EQ(extra.code, 1);
  EXPECT_TRUE(extra.says("extra " + at("golden/cull/notes.txt"))) << extra.text;
  EXPECT_EQ(golden("update").code, 1) << "as the check";
  EXPECT_FALSE(fs::exists(at("golden/cull/both_windings/.plumb-1-2")));
  EXPECT_FALSE(fs::exists(at("golden/cull/both_windings/color.0123456789abcdef.png")));
  EXPECT_TRUE(fs::exists(at("golden/cull/notes.txt"))) << "nobody else's file is removed";
}

TEST_F(GoldenCommand, AManifestThatAHandHasChangedEnds2) {
  const fs::path manifest = folder_ / "golden/manifest.json";
  const std::string text = test::text_of(manifest);
  const std::string line = "\"cull/both_windings\": ";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string out = text;
    out.replace(out.find(from, out.find(line)), from.size(), to);
    test::write_text(manifest, out);
    return golden("check");
  };
  const Outcome vouched = with("\"vouched\":[\"", "\"vouched\":[\"ours\",\"");
  EXPECT_EQ(vouched.code, 2);
  EXPECT_TRUE(vouched.says(manifest.string() + ": at \"/scenes/cull~1both_windings/seal\": expected the seal"))
      << vouched.text;
  EXPECT_EQ(with("\"equal\":\"", "\"equal\":\"window ").code, 2);
  EXPECT_EQ(with("/color.", "/../color.").code, 2);
  EXPECT_EQ(with("\"bytes\":", "\"bytes\":1").code, 2);
  EXPECT_EQ(with("\"scene\":\"", "\"scene\":\"x").code, 2);
  EXPECT_EQ(with("\"files\":{", "\"files\":{\"more\":1,").code, 2);
  test::write_text(manifest, text.substr(0, text.size() / 2));
  EXPECT_EQ(golden("check").code, 2);
  EXPECT_EQ(golden("update").code, 2) << "a set that is not understood is not replaced";
  fs::remove(manifest);
  EXPECT_EQ(golden("check").code, 2);
}

TEST_F(GoldenCommand, ASceneThatChangedIsStaleUntilTheReferencesVouchAgain) {
  change_scene("\"description\": \"", "\"description\": \"Changed. ");
  const Outcome stale = golden("check");
  EXPECT_EQ(stale.code, 1);
  EXPECT_TRUE(stale.says("the scene changed since its golden was made")) << stale.text;
  const auto before = files();
  const Outcome would = golden("update", "--check");
  EXPECT_EQ(would.code, 1);
  EXPECT_TRUE(would.says("would be written cull/both_windings")) << would.text;
  EXPECT_TRUE(would.says("vouched for by " + kOpenGl + ", embree, exact")) << would.text;
  EXPECT_TRUE(files() == before) << "--check writes nothing";
  const Outcome written = golden("update", "--report " + at("page"));
  EXPECT_EQ(written.code, 1) << "a run that writes does not pass";
  EXPECT_TRUE(written.says("accepted cull/both_windings")) << written.text;
  EXPECT_TRUE(fs::exists(at("page/index.html")));
  EXPECT_TRUE(fs::exists(at("page/cull/both_windings/new.png")));
  const auto after = files();
  EXPECT_TRUE(after != before);
  const Outcome again = golden("update");
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_TRUE(again.says("nothing to write")) << again.text;
  EXPECT_TRUE(files() == after) << "twice in a row: the second changes nothing";
}

TEST_F(GoldenCommand, AFaultIsRefusedWithTheReasonAndNothingIsWritten) {
  const auto before = files();
  const Outcome check = golden("check", "--fault coverage.inclusive_edges");
  EXPECT_EQ(check.code, 1);
  EXPECT_TRUE(check.says("first stage that differs: coverage")) << check.text;
  EXPECT_TRUE(check.says("wrong by itself: coverage")) << check.text;
  EXPECT_TRUE(check.says("pixels differ, the worst at pixel")) << check.text;
  const Outcome update = golden("update", "--fault coverage.inclusive_edges");
  EXPECT_EQ(update.code, 1);
  EXPECT_TRUE(update.says("refused coverage/shared_edges")) << update.text;
  EXPECT_TRUE(update.says("because of " + kOpenGl + ", coverage: different")) << update.text;
  EXPECT_TRUE(update.says("because of exact, per stage, coverage: different")) << update.text;
  EXPECT_TRUE(files() == before);
}

TEST_F(GoldenCommand, ASceneThatIsGoneTakesItsGoldenWithIt) {
  fs::remove(at("suite/cull/both_windings.json"));
  const Outcome orphan = golden("check");
  EXPECT_EQ(orphan.code, 1);
  EXPECT_TRUE(orphan.says("orphan cull/both_windings")) << orphan.text;
  const Outcome update = golden("update");
  EXPECT_EQ(update.code, 1);
  EXPECT_TRUE(update.says("removed cull/both_windings")) << update.text;
  EXPECT_FALSE(fs::exists(at("golden/cull/both_windings")));
  EXPECT_TRUE(fs::exists(at("golden/tolerances.json")));
  EXPECT_EQ(golden("update").code, 0);
}

TEST_F(GoldenCommand, AGroupSaysNothingOfTheOthers) {
  const std::map<std::string, std::string> before = files();
  const std::string group = "golden update --golden " + at("golden") + " --suite " + at("suite/cull");
  Outcome run = plumb(group);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_EQ(files(), before);
  fs::copy(scene(), folder_ / "suite/cull/another.json");
  fs::remove(scene());
  run = plumb(group + " --check");
  EXPECT_TRUE(run.says("would be removed cull/both_windings")) << run.text;
  EXPECT_TRUE(run.says("1 removed")) << "its own alone" << run.text;
  run = plumb("golden update --golden " + at("golden") + " --suite " + at("suite/cull/another.json"));
  EXPECT_EQ(run.code, 2) << "no folder" << run.text;
  fs::create_directories(folder_ / "suite/cull/below");
  fs::copy(folder_ / "suite/cull/another.json", folder_ / "suite/cull/below/one.json");
  run = plumb(group + " --check");
  EXPECT_TRUE(run.says("1 removed")) << "a folder in a group" << run.text;
  EXPECT_TRUE(fs::exists(folder_ / "golden/coverage"));
}

TEST_F(GoldenCommand, AnUpdateThatWritesNothingMakesNoFolder) {
  Outcome run =
      plumb("golden update --suite " + at("suite/cull") + " --golden " + at("nowhere") + " --fault window.y_flipped");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("REFUSED")) << run.text;
  EXPECT_FALSE(fs::exists(at("nowhere")));
  test::write_text(folder_ / "golden/notes.txt", "mine");
  run = golden("update");
  EXPECT_EQ(run.code, 1) << "check fails, too";
  EXPECT_TRUE(run.says("notes.txt: a file that the manifest does not name")) << run.text;
  EXPECT_EQ(test::text_of(folder_ / "golden/notes.txt"), "mine");
}

TEST_F(GoldenCommand, OneUpdateAtATime) {
  const int folder = ::open(at("golden").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(folder, LOCK_EX), 0);
  for (const char* verb : {"update", "check"}) {
    const Outcome run = golden(verb);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says(at("golden") + ": another run")) << run.text;
  }
  ASSERT_EQ(::flock(folder, LOCK_SH), 0);
  EXPECT_EQ(golden("check").code, 0) << "many may read";
  EXPECT_EQ(golden("update").code, 2);
  ::close(folder);
}

TEST_F(GoldenCommand, BadInputEnds2) {
  EXPECT_EQ(plumb("golden").code, 2);
  EXPECT_EQ(plumb("golden bless").code, 2);
  EXPECT_EQ(golden("check", at("no_such.json")).code, 2);
  EXPECT_EQ(golden("check", "--fault nonsense").code, 2);
  EXPECT_TRUE(golden("check", scene().string() + " " + scene().string()).says("found cull/both_windings twice"));
  EXPECT_EQ(plumb("golden check --suite " + at("suite") + " --golden " + at("nowhere")).code, 2);
  EXPECT_EQ(plumb("golden check --suite " + at("nowhere") + " --golden " + at("golden")).code, 2);
  EXPECT_EQ(golden("check", "--against exact").code, 2) << "who is asked is not for the run to choose";
  EXPECT_EQ(golden("update", "--against exact").code, 2);
}

TEST_F(GoldenCommand, CheckBesideTheReferencesHasARowForEachStage) {
  const std::string scene = at("suite/coverage/shared_edges.json") + " --golden " + at("golden");
  const Outcome holds = plumb("check " + scene);
  EXPECT_EQ(holds.code, 0) << holds.text;
  EXPECT_TRUE(holds.says("golden                   visibility equal")) << holds.text;
  const Outcome fault = plumb("check " + scene + " --against exact --fault coverage.inclusive_edges");
  EXPECT_EQ(fault.code, 1);
  EXPECT_TRUE(fault.says("golden                   coverage   different")) << fault.text;
  EXPECT_TRUE(fault.says("golden                   window     equal")) << fault.text;
  EXPECT_TRUE(fault.says("--golden " + at("golden") + " --fault")) << fault.text;
  fs::remove_all(folder_ / "golden/coverage/shared_edges");
  const Outcome gone = plumb("check " + scene + " --against exact");
  EXPECT_EQ(gone.code, 1);
  EXPECT_TRUE(gone.says("golden                   merge      failed")) << gone.text;
}

// True: the last process of a killed run has released the goldens' lock. With AddressSanitizer's address space, on a
// busy machine, the kernel may take seconds to end it.
bool is_released_within_a_minute(const std::string& goldens) {
  const int folder = ::open(goldens.c_str(), O_RDONLY | O_DIRECTORY);
  bool is_free = false;
  for (int i = 0; i < 3000 && !is_free; ++i) {
    is_free = ::flock(folder, LOCK_EX | LOCK_NB) == 0;
    if (!is_free) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ::close(folder);
  return is_free;
}

// The whole program, killed anywhere between its start and its end. (Where it writes: golden_kill_test.)
TEST_F(GoldenCommand, AKilledUpdateLeavesTheOldSetOrTheNewOne) {
  const char* said = std::getenv("PLUMBLINE_KILLS");
  const int kills = said != nullptr ? std::atoi(said) : 2;
  const std::string words[] = {"\"description\": \"", "\"description\": \"Changed. "};
  const fs::path manifest = folder_ / "golden/manifest.json";
  const std::string arguments = "golden update " + scene().string() + " --golden " + at("golden");
  const auto start = std::chrono::steady_clock::now();
  change_scene(words[0], words[1]);
  ASSERT_EQ(plumb(arguments).code, 1);
  const auto whole = std::chrono::steady_clock::now() - start;
  std::mt19937 random(7);
  bool changed = true;
  int olds = 0;
  for (int i = 0; i < kills; ++i) {
    const std::string before = test::text_of(manifest);
    change_scene(words[changed], words[!changed]);
    const pid_t child = ::fork();
    if (child == 0) {
      ::execl("/bin/sh", "sh", "-c", ("exec " PLUMBLINE_PLUMB " " + arguments + " > /dev/null").c_str(), nullptr);
      ::_exit(127);
    }
    const double share = (i + static_cast<double>(random()) / std::mt19937::max()) / kills;  // of every moment some
    std::this_thread::sleep_for(whole * (1.2 * share));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(is_released_within_a_minute(at("golden")));
    const bool old = test::text_of(manifest) == before;
    olds += old;
    const Outcome check = plumb("golden check " + scene().string() + " --golden " + at("golden"));
    ASSERT_EQ(check.code, old ? 1 : 0) << check.text;
    ASSERT_EQ(check.says("the scene changed since"), old) << check.text;
    if (old) {
      change_scene(words[!changed], words[changed]);  // the old scene still has its golden, whole
      ASSERT_EQ(plumb("golden check " + scene().string() + " --golden " + at("golden")).code, 0);
    } else {
      changed = !changed;
    }
  }
  fmt::print("{} kills: {} left the old set, {} the new one\n", kills, olds, kills - olds);
}

TEST_F(GoldenCommand, ASuiteOfAFewDoesNotRemoveTheGoldensOfAllOthers) {
  const std::string manifest = test::text_of(PLUMBLINE_SOURCE_DIR "/golden/manifest.json");
  fs::create_directories(folder_ / "whole");
  test::write_text(folder_ / "whole/manifest.json", manifest);
  const Outcome run = plumb("golden update --suite " + at("suite") + " --golden " + at("whole"));
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(run.says("--suite " + at("suite") + ": expected the scenes of " + at("whole"))) << run.text;
  EXPECT_EQ(test::text_of(folder_ / "whole/manifest.json"), manifest);
}

}  // namespace
}  // namespace plumbline
