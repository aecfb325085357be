// An update of goldens is killed at any moment: the set is the old one or the new one, to the last file.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include "base/temporary_path.h"
#include "check/golden/golden_set.h"
#include "tests/text_file.h"

namespace plumbline::check {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A set of goldens of 20 scenes, whose pictures go by `shade`.
struct Update {
  GoldenManifest manifest;
  std::map<std::string, std::string> files;
};
Update update_of(float shade) {
  Update out;
  const std::map<std::string, std::string> versions = {{"ours", fmt::format("{}", shade)}};
  out.manifest.versions[key_of(versions)] = versions;
  for (int i = 0; i < 20; ++i) {
    Scene scene;
    scene.name = fmt::format("group{}/scene{}", i % 4, i);
    Fingerprint drawn;
    drawn.color = Plane<glm::vec4>(16, 16, glm::vec4(shade, static_cast<float>(i) / 255, 0, 1));
    drawn.depth = Plane<double>(16, 16, 1);  // the same file in both
    Hasher hasher;
    hasher.add_value(shade);
    drawn.stages[0] = hasher.done();
    Golden golden = make_golden(scene, drawn, out.files);
    golden.producer = "ours";
    golden.versions = key_of(versions);
    out.manifest.scenes[scene.name] = golden;
  }
  return out;
}

// PLUMBLINE_KILLS: how many, 30 where it is not said.
TEST(GoldenKill, LeavesTheOldSetOrTheNewOne) {
  const char* said = std::getenv("PLUMBLINE_KILLS");
  const int kills = said != nullptr ? std::atoi(said) : 30;
  // A folder in memory, if that is free: a disk takes long to sync, and most kills would find it at that.
  const fs::path folder = temporary_files() / fmt::format("plumb-golden-kill-{}", ::getpid());
  fs::create_directories(folder);
  const Update updates[] = {update_of(0), update_of(1)};
  const std::string texts[] = {manifest_text(updates[0].manifest), manifest_text(updates[1].manifest)};
  const auto write = [&](std::size_t which) {
    GoldenSet(folder, GoldenSet::Access::update).write(updates[which].manifest, updates[which].files);
  };
  write(0);
  const auto start = Clock::now();
  write(1);
  const Clock::duration whole = Clock::now() - start;
  std::mt19937 random(7);
  std::size_t now = 1;
  int olds = 0, news = 0, leftovers = 0;
  for (int i = 0; i < kills; ++i) {
    const std::size_t next = 1 - now;
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      try {
        write(next);
      } catch (...) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    const double share = (i + static_cast<double>(random()) / std::mt19937::max()) / kills;  // of every moment some
    std::this_thread::sleep_for(std::chrono::duration_cast<Clock::duration>(1.3 * share * whole));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    const std::string text = test::text_of(folder / "manifest.json");
    ASSERT_TRUE(text == texts[0] || text == texts[1]) << "kill " << i;
    if (text == texts[next]) now = next;
    ++(now == next ? news : olds);
    const GoldenSet set(folder, GoldenSet::Access::read);
    for (const auto& [name, golden] : set.manifest().scenes) {
      const Fingerprint drawn = set.load(name, FrameFormat{});  // throws unless every byte is what the manifest says
      ASSERT_EQ(drawn.color(0, 0).r, static_cast<float>(now)) << name;
    }
    ASSERT_EQ(set.strays().others, std::vector<std::string>{});
    leftovers += set.strays().leftovers.empty() ? 0 : 1;
  }
  fmt::print("{} kills of an update of {:.1f} ms: {} left the old set, {} the new one, {} something beside it\n", kills,
             std::chrono::duration<double, std::milli>(whole).count(), olds, news, leftovers);
  EXPECT_GT(olds, 0);
  write(1 - now);  // one that is left alone tidies up
  const GoldenSet set(folder, GoldenSet::Access::read);
  EXPECT_EQ(set.strays().leftovers, std::vector<std::string>{});
  EXPECT_EQ(test::text_of(folder / "manifest.json"), texts[1 - now]);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace plumbline::check
