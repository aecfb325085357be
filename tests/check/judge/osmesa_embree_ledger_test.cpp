// The whole suite, by what the scenes' tests left: every scene is there, and the 4x rule: each tolerance is used,
// holds, and is at most four times what was seen, or says why.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#include "check/verdict/ledger.h"
#include "report/runs/run_merge.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

class Suite : public testing::Test {
 protected:
  static report::CheckRun all() {
    std::vector<report::CheckRun> runs;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(PLUMBLINE_SUITE)) {
      if (entry.path().extension() == ".json") runs.push_back(report::read_run(entry.path()));
    }
    if (runs.empty()) throw std::runtime_error("no scene's test has been run: ctest -R scene/");
    return report::merge(std::move(runs)).run;
  }
};

TEST_F(Suite, HoldsEverySceneAndMoreThanAThousandComparisons) {
  const report::CheckRun run = all();
  std::set<std::filesystem::path> judged;
  std::size_t comparisons = 0;
  for (const check::SceneVerdict& verdict : run.verdicts) {
    judged.insert(verdict.path);
    comparisons += verdict.comparisons.size();
    EXPECT_EQ(verdict.failure, "") << verdict.scene;
  }
  std::ifstream in(PLUMBLINE_SUITE "/../slow_scenes.txt");  // judged by scripts/test all
  std::set<std::filesystem::path> slow;
  for (std::string name; std::getline(in, name);) slow.insert(suite_folder() / (name + ".json"));
  EXPECT_LE(slow.size(), 13u);
  for (const auto& file : suite_files()) EXPECT_TRUE(judged.contains(file) || slow.contains(file)) << file;
  for (const char* reference : {"embree", "exact"}) EXPECT_TRUE(run.head.versions.contains(reference));
  EXPECT_TRUE(run.head.versions.contains("osmesa") || run.head.versions.contains("egl"));
  EXPECT_GE(comparisons, 10'000u);
}

TEST_F(Suite, UsesEveryRowOfTheLedgerAndNoneIsLoose) {
  const report::CheckRun run = all();
  for (const check::LedgerUse& use : check::ledger_use(run.verdicts)) {
    ASSERT_GE(use.largest_ratio, 0) << name_of(*use.row) << ": no comparison uses the row";
    EXPECT_LE(use.largest_ratio, 1) << name_of(*use.row) << ": " << use.where;
    if (use.row->loose_because.empty()) {
      EXPECT_GE(use.largest_ratio, 0.25) << name_of(*use.row) << ": looser than four times what was seen, "
                                         << use.where;
    } else {
      EXPECT_LT(use.largest_ratio, 0.5) << name_of(*use.row) << ": it is not loose, the excuse can go";
    }
  }
}

}  // namespace
}  // namespace plumbline
