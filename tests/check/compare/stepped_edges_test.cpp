// Fragments beside edges whose x is added up from row to row in float.
#include "check/compare/compare_records.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// A side rises over 1,800 rows at x = 1,900 pixels; the centre of (1900, 900) lies `outside` pixels beyond it.
Measurement extra_fragment(double outside, Conventions::DepthArithmetic arithmetic) {
  const double x = 1900.5 - outside;
  Records<double> reference;
  WindowTriangle<double> t{};
  t.corners = 3, t.front = true;
  t.v[0].p_win = {x, 100, 0.5}, t.v[1].p_win = {x, 1900, 0.5}, t.v[2].p_win = {100, 1000, 0.5};
  for (auto& v : t.v) v.inv_w = 1;
  reference.triangles = {t};
  reference.covered = {{0, 1000, 900}};
  Records<double> candidate = reference;
  candidate.covered.push_back({0, 1900, 900});
  Conventions conventions;
  conventions.subpixel_bits = Conventions::kFloat;
  conventions.tie_rule = Conventions::TieRule::left_top;
  conventions.depth_arithmetic = arithmetic;
  return compare_covered_except_edges(candidate, reference, conventions);
}

TEST(SteppedEdges, MayCoverAsFarAsTheirRoundingsReach) {
  using enum Conventions::DepthArithmetic;
  const double reach = 2 * kU * 1802 * 1900, by_grid = std::sqrt(2.0) / 512 + 8 * kU * 3800;  // 0.41, 0.0046
  EXPECT_EQ(extra_fragment(0.95 * reach, in_float_stepped).differing, 0u);
  EXPECT_EQ(extra_fragment(0.95 * reach, in_float_stepped).ambiguous, 1u);
  EXPECT_TRUE(fails(extra_fragment(1.05 * reach, in_float_stepped)));
  for (const Conventions::DepthArithmetic other : {in_double, in_float, in_float_from_origin}) {
    EXPECT_EQ(extra_fragment(0.95 * by_grid, other).differing, 0u);
    EXPECT_TRUE(fails(extra_fragment(1.05 * by_grid, other)));
  }
}

}  // namespace
}  // namespace plumbline::check
