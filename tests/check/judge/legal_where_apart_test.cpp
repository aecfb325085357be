// Legal answers at the pixels where references and the candidate are apart.
#include <array>

#include <gtest/gtest.h>

#include "check/judge/captures.h"
#include "pipeline/stages.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "tests/oracle/window_answers.h"

namespace plumbline::check {
namespace {

// A triangle before another one, a side of which lies on pixels' centres: winners do not show whose those pixels are.
TEST(LegalWhereApart, IsThatOfCountsToo) {
  const Scene scene = math::window_scene({{{{-70, 1, 0.25f}, {140, 1, 0.25f}, {32, 130, 0.25f}}},
                                          {{{32.5f, 8, 0.75f}, {60, 30, 0.75f}, {32.5f, 60, 0.75f}}}},
                                         64);
  const auto ours = pipeline::make_pipeline(), exact = exact::make_exact();
  const Capture theirs = ours->capture(scene, {});
  Capture mine = theirs;
  const auto where_apart = [&] { return legal_where_apart(scene, mine, std::span(&theirs, 1), *exact, {}); };
  EXPECT_TRUE(where_apart().certain.empty());
  for (int y = 20; y < 30; ++y) {
    const bool has_it = mine.planes.count(32, y) == 2;
    mine.planes.count(32, y) = has_it ? 1 : 2;
  }
  const Legal counts = where_apart();
  ASSERT_FALSE(counts.certain.empty());
  for (int y = 20; y < 30; ++y) {
    EXPECT_EQ(counts.certain(32, y), 1u) << y;
    EXPECT_EQ(counts.possible(32, y), 2u) << y;
  }
  mine = theirs;
  mine.planes.id_sum(32, 20) += 1;
  EXPECT_FALSE(where_apart().certain.empty());
  mine.planes = {};
  EXPECT_TRUE(where_apart().certain.empty()) << "nothing to compare";
}

}  // namespace
}  // namespace plumbline::check
