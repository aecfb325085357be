// plumb campaign as a user runs it.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <future>
#include <map>
#include <random>
#include <thread>

#include <fmt/format.h>

#include "tests/cli/campaign.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

const std::string kAssets = " --assets " PLUMBLINE_SOURCE_DIR "/tests/scenes/texture";
const std::string kTruncates = " --fault depth.truncated";

TEST_F(Campaign, OfOursHolds) {
  const Outcome run = campaign("c", "--seeds 1..6");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("ordinary scenes: 6\nhard scenes: 6\nhold: 12\n")) << run.text;
  EXPECT_FALSE(fs::exists(folder_ / "c/findings"));
}

TEST_F(Campaign, OfAFaultNamesItAndLeavesItsSmallestScene) {
  const Outcome run = campaign("c", "--seeds 1..6" + kTruncates);
  EXPECT_EQ(run.code, 1) << run.text;
  ASSERT_TRUE(run.says("depth, different z (against exact, per stage): ")) << run.text;
  const fs::path finding = folder_ / "c/findings/depth-different-z-exact-per-stage";
  for (const char* name : {"scene.json", "found.json", "scene.txt", "scene/index.html"}) {
    EXPECT_TRUE(fs::exists(finding / name)) << name;
  }
  EXPECT_LT(test::text_of(finding / "scene.json").size(), test::text_of(finding / "found.json").size());
  const std::string scene = (finding / "scene.json").string();
  const Outcome faulted = plumb(fmt::format("check {} --no-cache{}", scene, kTruncates));
  EXPECT_EQ(faulted.code, 1) << faulted.text;
  EXPECT_TRUE(faulted.says("first different stage: depth")) << faulted.text;
  EXPECT_EQ(plumb(fmt::format("check {} --no-cache", scene)).code, 0);
  // A known finding stays as it is, and is counted.
  test::write_text(finding / "scene.txt", "mine");
  const Outcome again = campaign("c", kTruncates);
  EXPECT_EQ(again.code, 1);
  EXPECT_TRUE(again.says("depth, different z")) << again.text;
  EXPECT_EQ(test::text_of(finding / "scene.txt"), "mine");
}

TEST_F(Campaign, IsTheSameInPartsAndInOne) {
  ASSERT_EQ(campaign("one", "--seeds 1..8 --jobs 1" + kTruncates).code, 1);
  ASSERT_EQ(campaign("parts", "--seeds 1..3 --judge-only --jobs 2" + kTruncates).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "parts/results.json"));
  ASSERT_EQ(campaign("parts", "--seeds 3..8 --jobs 2" + kTruncates).code, 1);
  EXPECT_EQ(results("one"), results("parts"));
  std::set<std::string> one, parts;
  for (const auto& name : entries()) {
    if (!name.ends_with("scene.json")) continue;
    (name.starts_with("one/") ? one : parts).insert(name.substr(name.find('/')) + test::text_of(folder_ / name));
  }
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one, parts);
}

TEST_F(Campaign, WritesScenesFiles) {
  const Outcome run = campaign("c", "--seeds 3..4 --write");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_EQ(entries(), (std::set<std::string>{"c", "c/hard", "c/hard/3.json", "c/hard/4.json", "c/ordinary",
                                              "c/ordinary/3.json", "c/ordinary/4.json"}));
  EXPECT_TRUE(run.says("note: images that ordinary scenes name are found by --assets ")) << run.text;
  const Outcome check = plumb(fmt::format("check {} --no-cache{}", at("c"), kAssets));
  EXPECT_EQ(check.code, 0) << check.text;
  EXPECT_EQ(campaign("c", "--write").code, 2);
}

TEST_F(Campaign, GoesOnWhereItWas) {
  ASSERT_EQ(campaign("c", "--seeds 1..4 --generator hard --against exact").code, 0);
  const auto journal = folder_ / "c/journal/hard-1-4.journal";
  const auto before = test::text_of(journal);
  ASSERT_FALSE(before.empty());
  const Outcome again = campaign("c", "--seeds 1..4 --generator hard --against exact");
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_TRUE(again.says("hard scenes: 4\nhold: 4\n")) << again.text;
  EXPECT_EQ(test::text_of(journal), before);
}

TEST_F(Campaign, OfTwoCandidatesInOneFolderIsRefused) {
  ASSERT_EQ(campaign("c", "--seeds 1..1 --against exact").code, 0);
  for (const std::string& other : {kTruncates, std::string(" --against embree")}) {
    const Outcome run = campaign("c", "--seeds 1..1" + other);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says("expected a journal of this campaign")) << run.text;
  }
  EXPECT_EQ(campaign("c", "--seeds 1..2 --against embree").code, 2) << "other seeds";
  EXPECT_EQ(campaign("c", "--seeds 1..2 --memory-limit 9000 --against exact").code, 2) << "another limit";
  const Outcome run = campaign("c", "--seeds 1..2 --against exact,exact");
  EXPECT_EQ(run.code, 0) << "what was refused left nothing: " << run.text;
}

// Nothing judged is no pass.
TEST_F(Campaign, ThatJudgesNothingDoesNotHold) {
  fs::create_directories(folder_ / "d/journal");
  const Outcome empty = campaign("d", "");
  EXPECT_EQ(empty.code, 2) << empty.text;
  EXPECT_TRUE(empty.says("expected a scene that could be judged, found none")) << empty.text;
}

// A finding whose page was never written is made again.
TEST_F(Campaign, EndsWhatAKilledOneBeganOfAFinding) {
  ASSERT_EQ(campaign("c", "--seeds 1..2 --against exact" + kTruncates).code, 1);
  const fs::path finding = folder_ / "c/findings/depth-different-z-exact-per-stage";
  fs::remove_all(finding / "scene");
  fs::remove(finding / "scene.txt");
  ASSERT_EQ(campaign("c", "--against exact" + kTruncates).code, 1);
  EXPECT_TRUE(fs::exists(finding / "scene/index.html") && fs::exists(finding / "scene.txt"));
}

// A crash in a worker fails its renderer's rows, and the campaign goes on.
TEST_F(Campaign, OfRenderersThatCrashNamesThem) {
  const Outcome reference =
      campaign("c", "--seeds 1..2 --generator hard --against embree,exact --fault endings.crash:embree:hard/2");
  EXPECT_EQ(reference.code, 1) << reference.text;
  EXPECT_TRUE(reference.says("failed: ") && reference.says("(against embree): hard/2\n")) << reference.text;
  const Outcome ours = campaign("d", "--seeds 1..2 --generator hard --against exact --fault endings.crash");
  EXPECT_EQ(ours.code, 1) << ours.text;
  EXPECT_TRUE(ours.says("      2  clip, failed: was killed by signal # (Segmentation fault)")) << ours.text;
}

TEST_F(Campaign, RefusesBadInput) {
  const std::pair<const char*, const char*> kBad[] = {
      {"", "expected the folder of a campaign, found no journal"},
      {"--seeds 5", "--seeds: expected FIRST..LAST"},
      {"--seeds 5..4", "--seeds: expected FIRST..LAST"},
      {"--seeds 1..-4", "--seeds: expected FIRST..LAST"},
      {"--seeds 1..x", "--seeds: expected FIRST..LAST"},
      {"--seeds 1..99999999999999999999999", "--seeds: expected FIRST..LAST"},
      {"--seeds 0..18446744073709551615", "--seeds: expected FIRST..LAST"},
      {"--seeds 1..2 --generator soft", "soft"},
      {"--seeds 1..2 --fault none_such", "none_such"},
      {"--seeds 1..2 --against none_such", "none_such"},
      {"--seeds 1..2 --program cp", "{scene}"},
      {"--seeds 1..2 --program './none_such {serve}'",
       "--program: ./none_such: expected a program that can be run, found none"},
      {"--seeds 1..2 --program 'none_such {serve}'",
       "--program: none_such: expected a program that can be run, found none"},
      {"--seeds 1..2 --program '/etc/passwd {serve}'", "found another file"},
      {"--seeds 1..2 --program '/etc {serve}'", "found a folder"},
      {"--seeds 1..1000001", "at most 1000000 seeds"},
      {"--judge-only", "--seeds"}};
  for (const auto& [options, why] : kBad) {
    const Outcome run = campaign("c", options);
    EXPECT_EQ(run.code, 2) << options << ": " << run.text;
    EXPECT_TRUE(run.says(why)) << options << ": " << run.text;
    EXPECT_FALSE(fs::exists(folder_ / "c/results.json"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "c/journal"));
}

// Away from the project's folders, in a program that is alone.
TEST_F(Campaign, NamesAFileThatAnOrdinarySceneLacks) {
  fs::copy(PLUMBLINE_PLUMB, folder_ / "plumb");
  for (const auto& file : fs::directory_iterator(fs::path(PLUMBLINE_PLUMB).parent_path())) {
    if (file.path().extension() == ".so") fs::copy(file, folder_ / file.path().filename());
  }
  const Outcome run =
      shell(fmt::format("{} campaign {} --generator ordinary --seeds 1..60 --against exact", at("plumb"), at("c")));
  EXPECT_EQ(run.code, 2) << run.text;
  EXPECT_TRUE(run.says("no file \"")) << run.text;
}

// A round's scenes are a function of the results of the rounds before, whoever judged them.
TEST_F(Campaign, NamesTheFileOfABadRound) {
  ASSERT_EQ(campaign("c", "--seeds 1..2 --generator hard --against exact").code, 0);
  fs::create_directories(folder_ / "c/rounds");
  test::write_text(folder_ / "c/rounds/1.txt", "hard/1\nnonsense\n");
  const Outcome bad = campaign("c", "--seeds 1..2 --generator hard --against exact --round 2");
  EXPECT_EQ(bad.code, 2) << bad.text;
  EXPECT_TRUE(bad.says("rounds/1.txt: line 2: expected GENERATOR/SEED such as hard/17, found nonsense")) << bad.text;
  test::write_text(folder_ / "c/rounds/1.txt", "");
  const Outcome none = campaign("c", "--seeds 1..2 --generator hard --against exact --round 2");
  EXPECT_TRUE(none.says("rounds/1.txt: expected scenes, found none")) << none.text;
}

// The worker of a run whose environment holds `mark`: a process whose parent and grandparent (program, supervisor) are
// of the run as well; 0: there is none yet.
pid_t worker_of(const std::string& mark) {
  std::map<pid_t, pid_t> parents;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const pid_t pid = std::atoi(entry.path().filename().c_str());
    if (pid <= 0 || test::text_of(entry.path() / "environ").find(mark) == std::string::npos) continue;
    const std::string stat = test::text_of(entry.path() / "stat");
    const std::size_t state = stat.rfind(')') + 2;
    if (state + 2 < stat.size()) parents[pid] = std::atoi(stat.c_str() + state + 2);
  }
  for (const auto& [pid, parent] : parents) {
    if (parents.contains(parent) && parents.contains(parents.at(parent))) return pid;
  }
  return 0;
}

// A worker killed from outside says nothing of its scene, which is asked for again; what happens then is the scene's
// own (here its reference hangs).
TEST_F(Campaign, AsksAgainWhereAWorkerWasKilled) {
  const std::string mark = "PLUMBLINE_KILLED_WORKER=" + folder_.string();
  auto killed = std::async(std::launch::async, [&] {
    for (int i = 0; i < 2000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
      if (const pid_t worker = worker_of(mark); worker != 0) return ::kill(worker, SIGKILL) == 0;
    }
    return false;
  });
  const Outcome run = shell(fmt::format(
      "{} {} campaign {} --seeds 2..2 --generator hard --against exact --jobs 1 --judge-only --time-limit 3 "
      "--fault endings.hang:exact:hard/2",
      mark, PLUMBLINE_PLUMB, at("c")));
  EXPECT_TRUE(killed.get());
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("failed: took longer than #s and was killed (against exact)")) << run.text;
  EXPECT_FALSE(run.says("signal")) << run.text;
}

// A campaign is not told without the scenes that another process judges, and no other campaign enters its folder.
TEST_F(Campaign, IsNotToldWhileAPartOfItRuns) {
  const std::string hangs = "--generator hard --against exact --fault endings.hang:exact:hard/9";
  ASSERT_EQ(campaign("c", "--seeds 1..4 " + hangs).code, 0);
  const std::string before = results("c");
  for (const char* folder : {"c", "d"}) {
    const pid_t part = ::fork();
    if (part == 0) {
      const std::string line = fmt::format("exec {} campaign {} --seeds 9..9 --judge-only {} >/dev/null 2>&1",
                                           PLUMBLINE_PLUMB, at(folder), hangs);
      ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      ::_exit(127);
    }
    const fs::path journal = folder_ / folder / "journal/hard-9-9.journal";
    for (int i = 0; i < 6000 && !fs::exists(journal.string() + "-wal"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const Outcome told = campaign(folder, hangs);
    EXPECT_EQ(told.code, 2) << told.text;
    EXPECT_TRUE(told.says("hard-9-9.journal: in use")) << told.text;
    const Outcome other = campaign(folder, "--seeds 5..5 --generator hard --against exact --judge-only");
    EXPECT_EQ(other.code, 2) << other.text;
    EXPECT_TRUE(other.says("expected a journal of this campaign")) << other.text;
    if (folder == std::string("d")) {  // ten seconds
      const Outcome twin = campaign(folder, "--seeds 9..9 --judge-only " + hangs);
      EXPECT_EQ(twin.code, 2) << twin.text;
      EXPECT_TRUE(twin.says("note: " + journal.string() + ": in use by another process: waiting 10s for it"))
          << twin.text;
    }
    ::kill(part, SIGKILL);
    ::waitpid(part, nullptr, 0);
  }
  EXPECT_EQ(results("c"), before);
  EXPECT_FALSE(fs::exists(folder_ / "d/results.json"));
}

TEST_F(Campaign, ProvesItsOutputsBeforeTheWork) {
  for (const char* name : {"results.json", "findings"}) {
    const std::string folder = std::string("of_") + name;
    fs::create_directories(folder_ / folder / (name == std::string("findings") ? "" : name));
    if (name == std::string("findings")) test::write_text(folder_ / folder / name, "a file");
    const Outcome run = campaign(folder, "--seeds 1..1 --generator hard --against exact");
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says(std::string(name) + ": cannot be written")) << run.text;
    EXPECT_FALSE(fs::exists(folder_ / folder / "journal/hard-1-1.journal"));
  }
}

TEST_F(Campaign, GoesInRounds) {
  EXPECT_EQ(campaign("none", "--seeds 1..2 --round 2").code, 2);
  for (const char* first : {"1..8", "1..3"}) {
    const std::string folder = first[3] == '8' ? "one" : "parts";
    ASSERT_EQ(campaign(folder, fmt::format("--seeds {} --against exact", first)).code, 0);
  }
  ASSERT_EQ(campaign("parts", "--seeds 4..8 --against exact --judge-only").code, 0);
  ASSERT_EQ(campaign("parts", "--seeds 1..4 --round 2 --against exact --judge-only").code, 0);
  for (const char* folder : {"one", "parts"}) {
    const Outcome run = campaign(folder, "--seeds 1..8 --round 2 --against exact");
    EXPECT_EQ(run.code, 0) << run.text;
    EXPECT_TRUE(run.says("ordinary scenes: 16\nhard scenes: 16\nhold: 32\n")) << run.text;
  }
  EXPECT_EQ(results("one"), results("parts"));
  EXPECT_EQ(test::text_of(folder_ / "one/rounds/1.txt"), test::text_of(folder_ / "parts/rounds/1.txt"));
  EXPECT_TRUE(test::text_of(folder_ / "one/rounds/1.txt").starts_with("ordinary/1\n"));
  ASSERT_EQ(campaign("one", "--seeds 1..2 --round 3 --against exact").code, 0);
  EXPECT_EQ(campaign("one", "--seeds 1..2 --round 0").code, 2);
  ASSERT_EQ(campaign("hard", "--seeds 1..2 --generator hard --against exact").code, 0);
  const Outcome none = campaign("hard", "--seeds 1..2 --generator ordinary --round 2 --against exact");
  EXPECT_EQ(none.code, 2) << none.text;
  EXPECT_TRUE(none.says("--round 2: expected ordinary scenes that round 1 keeps, found none")) << none.text;
  ASSERT_EQ(campaign("one", "--seeds 1..1 --generator hard --round 2 --write").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "one/hard/1.json"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "one/hard"), fs::directory_iterator()), 1);
}

// A campaign is killed and begun again until it ends; then the next one. PLUMBLINE_KILLS: how often
// (scripts/kill_updates asks for many).
TEST_F(Campaign, LosesNothingWhenItIsKilled) {
  const std::string options = "--seeds 1..30 --against exact --jobs 2" + kTruncates;
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(campaign("whole", options).code, 1);
  const auto duration = std::chrono::steady_clock::now() - start;
  const char* said = std::getenv("PLUMBLINE_KILLS");
  const int kills = said != nullptr ? std::atoi(said) : 5;
  std::mt19937 random(11);
  int killed = 0;
  const auto expect_whole = [&] {
    EXPECT_EQ(results("killed"), results("whole")) << killed;
    fs::remove_all(folder_ / "killed");
  };
  for (int runs = 0; killed < kills && runs < 20 * kills; ++runs) {
    const pid_t child = ::fork();
    if (child == 0) {
      const std::string line =
          fmt::format("exec {} campaign {} {} >/dev/null 2>&1", PLUMBLINE_PLUMB, at("killed"), options);
      ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      ::_exit(127);
    }
    std::this_thread::sleep_for(duration * (random() % 1000) / 1000);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    killed += WIFSIGNALED(status) ? 1 : 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 1) expect_whole();
  }
  ASSERT_EQ(killed, kills);
  Outcome last{2, ""};
  for (int i = 0; i < 100 && last.code == 2; ++i) {  // until the kernel has ended the killed run's children
    last = campaign("killed", options);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(last.code, 1) << last.text;
  expect_whole();
}

}  // namespace
}  // namespace plumbline
