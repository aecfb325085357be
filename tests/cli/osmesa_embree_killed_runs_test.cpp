// A run that a signal ends: nothing is lost, and nothing is left behind.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <random>
#include <thread>

#include <fmt/format.h>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

using Clock = std::chrono::steady_clock;

// Processes whose environment holds PLUMBLINE_KILLED_RUN=`mark`: all that the run started, whatever its parent is now.
std::vector<pid_t> processes_of(const std::string& mark) {
  std::vector<pid_t> out;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const pid_t pid = std::atoi(entry.path().filename().c_str());
    if (pid > 0 && test::text_of(entry.path() / "environ").find("PLUMBLINE_KILLED_RUN=" + mark) != std::string::npos) {
      out.push_back(pid);
    }
  }
  return out;
}

// True: a process of plumb is ending: its environment is gone, and its files, with their locks, are not yet closed.
// The last of its threads closes them; the first may be a zombie long before.
bool is_one_ending() {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    if (std::atoi(entry.path().filename().c_str()) == 0) continue;
    const std::string status = test::text_of(entry.path() / "status");
    const bool is_closed =
        status.find("\nState:\tZ") != std::string::npos && status.find("\nThreads:\t1\n") != std::string::npos;
    if (status.starts_with("Name:\tplumb\n") && !is_closed && test::text_of(entry.path() / "environ").empty())
      return true;
  }
  return false;
}

class KilledRuns : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_directories(folder_ / "tmp");
    fs::create_directories(folder_ / "out");
    fs::copy(kSharedEdges, folder_ / "scene.json");
  }

  // plumb with TMPDIR in the test's folder. Returns its process.
  pid_t begin(const std::string& arguments) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);  // nohup's, or a shell's, are ignored
    const std::string line = fmt::format("exec env TMPDIR={} PLUMBLINE_KILLED_RUN={} {} {} >/dev/null 2>&1", at("tmp"),
                                         folder_.string(), PLUMBLINE_PLUMB, arguments);
    ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    ::_exit(127);
  }
  static int end_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
  }

  // Hidden files and folders, and what is left in TMPDIR.
  std::set<std::string> leftovers() const {
    std::set<std::string> out;
    for (const std::string& name : entries()) {
      if (name.find("/.plumb-") != std::string::npos || name.starts_with("tmp/")) out.insert(name);
      const bool is_golden = name.starts_with("golden/") && fs::is_regular_file(folder_ / name);
      if (is_golden && !name.ends_with(".json") &&
          test::text_of(folder_ / "golden/manifest.json").find(name.substr(7)) == std::string::npos)
        out.insert(name);
    }
    return out;
  }

  // Runs plumb whole twice; then kills PLUMBLINE_KILLS runs (3 unless set) by each of INT, TERM, HUP and KILL, at
  // moments spread over the shorter run's time. `holds`: whether what a run writes is whole.
  void kill_at_all_moments(const std::string& arguments, const std::function<bool()>& holds) {
    const char* said = std::getenv("PLUMBLINE_KILLS");
    const int kills = said != nullptr ? std::atoi(said) : 3;
    auto duration = Clock::duration::max();  // of the shorter run: the first may find no shaders compiled
    for (int i = 0; i < 2; ++i) {
      const auto start = Clock::now();
      const int whole = end_of(begin(arguments));
      ASSERT_TRUE(WIFEXITED(whole) && WEXITSTATUS(whole) < 2) << whole;
      duration = std::min<Clock::duration>(duration, Clock::now() - start);
      ASSERT_TRUE(holds());
    }
    std::mt19937 random(7);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGKILL}) {
      int killed = 0;
      for (int i = 0; i < kills; ++i) {
        SCOPED_TRACE(fmt::format("{}: {} {}", arguments, strsignal(signal), i));
        const pid_t child = begin(arguments);
        const double share = (i + static_cast<double>(random()) / std::mt19937::max()) / kills;
        const double stretch = i == 0 ? 0.5 : 1.1;  // the first before the end, whatever slowed the whole run down
        std::this_thread::sleep_for(std::chrono::duration_cast<Clock::duration>(stretch * share * duration));
        ::kill(child, signal);
        const int status = end_of(child);
        if (WIFSIGNALED(status)) ++killed;
        EXPECT_TRUE(WIFSIGNALED(status) ? WTERMSIG(status) == signal : WEXITSTATUS(status) < 2) << status;
        if (signal == SIGKILL) {  // the kernel ends the others in a moment
          for (int j = 0; j < 1000 && (!processes_of(folder_.string()).empty() || is_one_ending()); ++j) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
          }
        }
        EXPECT_EQ(processes_of(folder_.string()), std::vector<pid_t>{});
        EXPECT_TRUE(holds());
        if (signal == SIGKILL) end_of(begin(arguments));  // the next run cleans up
        ASSERT_EQ(leftovers(), std::set<std::string>{});
      }
      EXPECT_GT(killed, 0) << arguments << ": none was killed by " << strsignal(signal);
    }
  }
};

TEST_F(KilledRuns, CheckWithAReport) {
  kill_at_all_moments(
      fmt::format("check {} --report {} --json {}", at("scene.json"), at("out/report"), at("out/j")),
      [&] { return test::text_of(folder_ / "out/report/index.html").find("</html>") != std::string::npos; });
}

// Verdicts that a killed run keeps do not alter what later runs say.
TEST_F(KilledRuns, CheckWithACache) {
  ::unsetenv("PLUMBLINE_NO_CACHE");
  const std::string run = fmt::format("check {} {}clip/behind_eye.json", at("scene.json"), kScenes);
  const auto said = [&](const std::string& option) {
    const std::string text = shell(fmt::format("{} {} {}", PLUMBLINE_PLUMB, run, option)).text;
    return text.substr(0, text.rfind(" in "));
  };
  const std::string anew = said("--no-cache"), cache = "--cache " + at("out/kept");
  EXPECT_FALSE(anew.empty());
  kill_at_all_moments(fmt::format("{} {}", run, cache), [&] {
    const bool same = said(cache) == anew;
    fs::remove_all(folder_ / "out/kept");
    return same;
  });
  ::setenv("PLUMBLINE_NO_CACHE", "1", 1);
}

TEST_F(KilledRuns, Capture) {
  kill_at_all_moments(fmt::format("capture {} {}", at("scene.json"), at("out/capture")),
                      [&] { return plumb(fmt::format("compare {0} {0}", at("out/capture"))).code == 0; });
}

TEST_F(KilledRuns, DiagnoseOfAProgram) {
  const std::string program = fmt::format(
      "sh -c '\\''setsid sleep 60 & {} capture \"$0\" \"$1\"; sleep 0.3'\\'' {{scene}} {{output}}", PLUMBLINE_PLUMB);
  const fs::path json = folder_ / "out/j.json";
  kill_at_all_moments(fmt::format("diagnose {} --program '{}' --json {}", at("scene.json"), program, json.string()),
                      [&] { return test::text_of(json).ends_with("}\n"); });
}

TEST_F(KilledRuns, GoldenUpdate) {
  fs::create_directories(folder_ / "suite/coverage");
  fs::create_directories(folder_ / "golden");
  const fs::path scene = folder_ / "suite/coverage/scene.json";
  fs::copy(kSharedEdges, scene);
  bool changed = false;
  kill_at_all_moments(fmt::format("golden update --suite {} --golden {}", at("suite"), at("golden")), [&] {
    const std::string manifest = test::text_of(folder_ / "golden/manifest.json");
    for (const std::string kind : {"color", "depth", "stages"}) {  // the old set or the new one: whole
      const std::size_t from = manifest.find("coverage/scene/" + kind);
      if (from == manifest.npos) return false;
      if (!fs::exists(folder_ / "golden" / manifest.substr(from, manifest.find('"', from) - from))) return false;
    }
    std::string text = test::text_of(scene);  // so that the next run has what to write
    changed = !changed;
    const std::string words[] = {"\"description\": \"", "\"description\": \"Changed. "};
    const std::string& old = words[!changed];
    text.replace(text.find(old), old.size(), words[changed]);
    test::write_text(scene, text);
    return true;
  });
}

}  // namespace
}  // namespace plumbline
