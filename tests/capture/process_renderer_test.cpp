// A program as a renderer: every way in which one can fail is named, with the end of its stderr.
#include "capture/renderers/process_renderer.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/supervise.h"
#include "capture/files/capture_folder.h"
#include "tests/test_folder.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

class Process : public TestFolder {
 protected:
  void SetUp() override {
    scene_.name = "group/scene";
    scene_.path = (root_ / "scene.json").string();
    scene_.frame.width = 4;
    scene_.frame.height = 2;
  }

  static std::unique_ptr<Renderer> shell(const std::string& script) {
    return make_process_renderer({.name = "outside",
                                  .version = "7",
                                  .argv = {"sh", "-c", script, "sh", "{scene}", "{output}"},
                                  .environment = {{"PLUMBLINE_TEST", "told"}},
                                  .timeout = std::chrono::milliseconds{2000},
                                  .shows = {Stage::merge, Stage::depth}});
  }
  std::string failure(const std::unique_ptr<Renderer>& renderer, const Request& request = {}) const {
    try {
      renderer->capture(scene_, request);
    } catch (const RendererFailed& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find("outside: "), 0u) << what;
      return what;
    }
    return "it did not fail";
  }
  /// A capture of the scene's size for programs to copy.
  fs::path good_capture(int width, int height) const {
    Capture c;
    c.renderer = "inside";
    c.version = "42";
    c.width = width;
    c.height = height;
    c.planes.depth = {width, height, 0.5};
    c.records.depth = {0.25};
    write_capture(c, root_ / "good");
    return root_ / "good";
  }

  struct Run {
    pid_t self, program;  ///< program: what its shell writes into the file `pid`; 0: nothing within 10 s
  };
  /// A process as plumb is: supervised, in the test's folder, with TMPDIR `temporary` there. It runs the script as its
  /// renderer.
  Run supervised_run(const std::string& script) const {
    fs::create_directory(root_ / "temporary");
    const pid_t self = ::fork();
    if (self == 0) {
      supervise();
      try {
        fs::current_path(root_);
        ::setenv("TMPDIR", (root_ / "temporary").c_str(), 1);
        make_process_renderer(
            {.name = "outside", .version = "", .argv = {"sh", "-c", script}, .environment = {}, .shows = {}})
            ->capture(scene_, {});
      } catch (...) {
      }
      ::_exit(0);  // not reached
    }
    pid_t program = 0;
    for (int i = 0; i < 500 && program == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds{20});
      std::ifstream(root_ / "pid") >> program;
    }
    return {self, program};
  }

  /// An orphan is reaped by init, or stays a zombie where init does not: dead either way.
  static bool dies(pid_t process) {
    const auto dead = [&] {
      std::string pid, name, state;
      std::ifstream(fs::path("/proc") / std::to_string(process) / "stat") >> pid >> name >> state;
      return state.empty() || state == "Z" || state == "X";
    };
    for (int i = 0; i < 100 && !dead(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds{20});
    return dead();
  }

  Scene scene_;
};

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST_F(Process, InfoShowsWhatItIsTold) {
  const RendererInfo info =
      make_process_renderer(
          {.name = "outside", .version = "7", .argv = {"/does/not/exist"}, .environment = {}, .shows = {Stage::merge}})
          ->info();
  EXPECT_EQ(info.name, "outside");
  EXPECT_EQ(info.version, "7");
  EXPECT_TRUE(info[Stage::merge].shows);
  EXPECT_FALSE(info[Stage::depth].shows);
  EXPECT_FALSE(info[Stage::depth].reason.empty());
  EXPECT_FALSE(info[Stage::merge].runs);
  EXPECT_THROW(make_process_renderer({.name = "outside", .version = "", .argv = {}, .environment = {}, .shows = {}}),
               std::invalid_argument);
}

TEST_F(Process, HandsOnWhatTheProgramLeaves) {
  const std::string script = "test \"$PLUMBLINE_TEST\" = told && test -n \"$PATH\" && test \"$1\" = '" + scene_.path +
                             "' && cp '" + good_capture(4, 2).string() + "'/* \"$2\"";
  Capture c = shell(script)->capture(scene_, {});
  EXPECT_EQ(c.renderer, "outside");
  EXPECT_EQ(c.version, "42");
  EXPECT_EQ(c.planes.depth.values(), Plane<double>::Values(8, 0.5));
  EXPECT_TRUE(c.records.depth.empty());  // not asked for
  Request request;
  request.records = {Stage::depth};
  EXPECT_EQ(shell(script)->capture(scene_, request).records.depth, std::vector{0.25});
}

TEST_F(Process, NamesWhatWentWrong) {
  EXPECT_HAS(failure(shell("true")), "left no capture that can be read");
  EXPECT_HAS(failure(shell("true")), "manifest.json");
  EXPECT_HAS(failure(shell("exit 3")), "exited with status 3");
  EXPECT_HAS(failure(shell("false")), "exited with status 1");
  EXPECT_HAS(failure(shell("sh -c 'kill -SEGV $$'; exit $?")), "exited with status 139: signal 11");
  EXPECT_HAS(failure(shell("exit 255")), "exited with status 255");
  EXPECT_HAS(failure(shell("kill -SEGV $$")), "was killed by signal 11 (Segmentation fault)");
  EXPECT_HAS(failure(shell("kill -ABRT $$")), "was killed by signal 6");
  EXPECT_HAS(failure(shell("rmdir \"$2\"")), "left no capture: its folder is gone");
  EXPECT_HAS(failure(shell("head -c 1000 /dev/urandom > \"$2\"/manifest.json")), "left no capture that can be read");
  EXPECT_HAS(failure(shell("echo '{\"format\": \"plumbline capture\"}' > \"$2\"/manifest.json")), "/version");
  EXPECT_HAS(failure(shell("cp '" + good_capture(2, 4).string() + "'/* \"$2\"")),
             "left a capture of 2 x 4 pixels where the scene has 4 x 2");
  Capture empty;
  empty.renderer = "inside", empty.version = "42", empty.width = 4, empty.height = 2;
  write_capture(empty, root_ / "empty");
  EXPECT_HAS(failure(shell("cp '" + (root_ / "empty").string() + "'/* \"$2\"")), "left a capture that holds no array");
  EXPECT_HAS(failure(shell("cp '" + (root_ / "empty").string() + "'/* \"$2\" && touch \"$2\"/planes.color.bin")),
             "left a capture that holds no array");
  EXPECT_HAS(failure(make_process_renderer(
                 {.name = "outside", .version = "", .argv = {"/does/not/exist"}, .environment = {}, .shows = {}})),
             "/does/not/exist cannot be started: No such file");
}

TEST_F(Process, ShowsTheEndOfStderr) {
  const std::string what = failure(shell("i=0; while [ $i -lt 5000 ]; do echo line $i >&2; i=$((i+1)); done; exit 1"));
  EXPECT_HAS(what, "exited with status 1\nthe end of its stderr:\nline 4990\n");
  EXPECT_EQ(what.substr(what.size() - 10), "\nline 4999");
  EXPECT_HAS(failure(shell("printf 'only line' >&2; exit 1")), "stderr:\nonly line");
}

TEST_F(Process, AnExitWith77IsUnsupportedForTheLastLinesReason) {
  const auto reason = [&](const std::string& script) -> std::string {
    try {
      shell(script)->capture(scene_, {});
    } catch (const Unsupported& unsupported) {
      return unsupported.what();
    }
    return "it was supported";
  };
  EXPECT_EQ(reason("echo working >&2; echo no fog here >&2; exit 77"), "no fog here");
  EXPECT_EQ(reason("exit 77"), "outside: exited with status 77, and gave no reason");
  EXPECT_HAS(failure(shell("echo no fog here >&2; exit 76")), "exited with status 76");
  EXPECT_HAS(failure(shell("echo no fog here >&2; kill -KILL $$")), "was killed by signal 9");
}

TEST_F(Process, KillsAHangingProgramAndAllThatItStarted) {
  const auto renderer = make_process_renderer(
      {.name = "outside",
       .version = "",
       .argv = {"sh", "-c", "echo waiting >&2; sleep 60 & echo $! > '" + (root_ / "pid").string() + "'; sleep 60"},
       .environment = {},
       .timeout = std::chrono::milliseconds{300},
       .shows = {}});
  const auto start = std::chrono::steady_clock::now();
  const std::string what = failure(renderer);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds{10});
  EXPECT_HAS(what, "took longer than 0.3s and was killed");
  EXPECT_HAS(what, "stderr:\nwaiting");
  pid_t child = 0;
  std::ifstream(root_ / "pid") >> child;
  ASSERT_GT(child, 1);
  EXPECT_TRUE(dies(child));
}

// A process in a session of its own, which has left the program's process group.
TEST_F(Process, KillsWhatLeftTheProgramsSession) {
  const fs::path pid_file = root_ / "pid";
  const auto renderer = [&](const std::string& last) {
    return make_process_renderer(
        {.name = "outside",
         .version = "",
         .argv = {"sh", "-c", "setsid sh -c 'echo $$ > \"" + pid_file.string() + "\"; exec sleep 60' & " + last},
         .environment = {},
         .timeout = std::chrono::milliseconds{2000},
         .shows = {}});
  };
  for (const std::string& last :
       std::vector<std::string>{"sleep 60", "while [ ! -s '" + pid_file.string() + "' ]; do :; done; exit 1"}) {
    fs::remove(pid_file);
    failure(renderer(last));
    pid_t child = 0;
    std::ifstream(pid_file) >> child;
    ASSERT_GT(child, 1) << last;
    EXPECT_TRUE(dies(child)) << last;
  }
}

TEST_F(Process, KilledItTakesTheProgramAlong) {
  const auto [self, program] = supervised_run("setsid sh -c 'echo $$ > pid; exec sleep 60' & sleep 60");
  ASSERT_GT(program, 1);
  ASSERT_EQ(::kill(self, SIGKILL), 0);
  ASSERT_EQ(::waitpid(self, nullptr, 0), self);
  EXPECT_TRUE(dies(program));
}

TEST_F(Process, AnEndFromOutsideLeavesNeitherProgramNorFolder) {
  const auto [self, program] = supervised_run("echo $$ > pid; exec sleep 60");
  const fs::path temporary = root_ / "temporary";
  ASSERT_GT(program, 1);
  ASSERT_FALSE(fs::is_empty(temporary));
  ASSERT_EQ(::kill(self, SIGTERM), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(self, &status, 0), self);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
  EXPECT_TRUE(fs::is_empty(temporary));
  EXPECT_TRUE(dies(program));
}

TEST_F(Process, RefusesWhatItCannotHandOver) {
  const std::string script = "cp '" + good_capture(4, 2).string() + "'/* \"$2\"; head -c 100000 /dev/zero > \"$2\"/x";
  Request small;
  small.memory_budget = 10;
  EXPECT_THROW(shell("exit 1")->capture(scene_, small), OverBudget);
  small.memory_budget = 50000;
  EXPECT_THROW(shell(script)->capture(scene_, small), OverBudget);
  scene_.path.clear();
  EXPECT_THROW(shell("true")->capture(scene_, {}), Unsupported);
}

TEST_F(Process, MayLeaveNoMoreThanItsBudgetInAnyFolder) {
  Request small;
  small.memory_budget = 100000;
  const std::string fill = "mkdir -p \"$2\"/a/b && head -c 200000 /dev/zero > \"$2\"/a/b/x";
  EXPECT_THROW(shell(fill)->capture(scene_, small), OverBudget);
}

TEST_F(Process, LeavesNoFolderBehind) {
  const fs::path temporary = root_ / "tmp";
  fs::create_directories(temporary);
  const char* before = std::getenv("TMPDIR");
  const std::string old = before != nullptr ? before : "";
  ::setenv("TMPDIR", temporary.c_str(), 1);
  failure(shell("echo x > \"$2\"/x; exit 1"));
  EXPECT_TRUE(fs::is_empty(temporary));
  if (before != nullptr)
    ::setenv("TMPDIR", old.c_str(), 1);
  else
    ::unsetenv("TMPDIR");
}

}  // namespace
}  // namespace plumbline
