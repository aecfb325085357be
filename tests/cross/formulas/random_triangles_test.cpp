// Random triangles, 10,000 of each kind (in a run, a tenth of them): from our records, our coverage is exact's bit for
// bit, and every stage is within its tolerance.
#include <gtest/gtest.h>

#include "check/judge/judge.h"
#include "check/judge/judge_records.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "tests/cross/random_scenes.h"
#include "tests/extent.h"

namespace plumbline {
namespace {

constexpr int kScenesPerKind = 20;
constexpr int kTrianglesPerScene = 500;

class RandomTriangles : public testing::TestWithParam<std::size_t> {};

TEST_P(RandomTriangles, EveryStageEqualsExactFromOurRecords) {
  const SceneKind kind = kinds()[GetParam()];
  const auto ours = pipeline::make_pipeline();
  const auto exact = exact::make_exact();
  std::uint64_t fragments = 0;
  for (int i = 0; i < kScenesPerKind / static_cast<int>(one_of(8)); ++i) {
    const Scene scene = scene_of_triangles(kind, kTrianglesPerScene, static_cast<std::uint64_t>(i) * 31 + GetParam());
    const Capture capture = ours->capture(scene, {.records = StageSet::all()});
    for (const check::Comparison& c : check::judge_records(scene, capture, *exact)) {
      EXPECT_FALSE(check::is_failure(c.outcome))
          << scene.name << ": " << name_of(c.stage) << ": " << c.measurement.differing << " of " << c.measurement.items
          << " differ, worst " << to_string(c.measurement.worst.place) << ": " << c.measurement.worst.difference << " "
          << c.measurement.unit << ", tolerance " << c.measurement.worst.tolerance << " " << c.note;
      if (c.stage == Stage::coverage) {
        EXPECT_EQ(c.outcome, check::Outcome::equal) << scene.name;
      }
      if (c.stage == Stage::depth) fragments += c.measurement.items;
    }
  }
  EXPECT_GT(fragments, 100u / one_of(8)) << "the kind draws nothing";
}

INSTANTIATE_TEST_SUITE_P(kinds, RandomTriangles, testing::Range<std::size_t>(0, kinds().size()), [](const auto& kind) {
  std::string name = kinds()[kind.param].name;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
});

}  // namespace
}  // namespace plumbline
