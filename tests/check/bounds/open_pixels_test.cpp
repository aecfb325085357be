// Scenes of which a frame without any triangle is legal.
#include "check/bounds/open_pixels.h"

#include <vector>

#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// A frame of one row; each pixel's legal winners.
Legal legal_of(const std::vector<std::vector<std::int32_t>>& winners) {
  Legal out;
  out.certain = out.possible = Plane<std::uint32_t>(static_cast<int>(winners.size()), 1, 0);
  out.first = {0};
  for (const std::vector<std::int32_t>& of_pixel : winners) {
    for (const std::int32_t id : of_pixel) out.answers.push_back({id, 0, 0, 1, {}});
    out.first.push_back(static_cast<std::uint32_t>(out.answers.size()));
  }
  return out;
}

TEST(MayBeEmpty, WhereEachPixelMayBeBackgroundAndSomeMayBeAnother) {
  EXPECT_TRUE(may_be_empty(legal_of({{kBackground, 3}, {kBackground}})));
  EXPECT_FALSE(may_be_empty(legal_of({{kBackground, 3}, {3}}))) << "one pixel must be drawn";
  EXPECT_FALSE(may_be_empty(legal_of({{kBackground}, {kBackground}}))) << "none may be drawn";
  EXPECT_FALSE(may_be_empty(Legal{})) << "nobody says what is legal";
  Legal blended = legal_of({{kBackground, 3}});
  blended.color_lo = blended.color_hi = Plane<glm::vec4>(1, 1);
  EXPECT_FALSE(may_be_empty(blended));
}

}  // namespace
}  // namespace plumbline::check
