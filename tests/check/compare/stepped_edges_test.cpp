// Fragments beside edges whose x is added up from row to row in float.
#include "check/compare/compare_records.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// A side rises over 1,800 rows at x = 1,900 pixels; the centre of (1900, 900) lies `outside` pixels beyond it.
Measurement extra_fragment(double outside, Conventions::DepthArithmetic arithmetic, glm::dvec2 frame = kNoSides,
                           int edge_bits = Conventions::kFloat) {
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
  conventions.edge_bits = edge_bits;
  return compare_covered_except_edges(candidate, reference, conventions, glm::dvec2(0.5), frame);
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

// A rounded slope moves an edge by the rows from its end, in the frame or beyond it.
TEST(SteppedEdges, InFixedPointMayCoverAsFarAsTheirBitsReach) {
  using enum Conventions::DepthArithmetic;
  for (const int bits : {12, 14}) {
    const double reach = std::ldexp(1804, -bits);
    for (const glm::dvec2 frame : {kNoSides, glm::dvec2(2000, 100)}) {
      EXPECT_EQ(extra_fragment(0.95 * reach, in_double, frame, bits).ambiguous, 1u) << bits;
      EXPECT_TRUE(fails(extra_fragment(1.05 * reach, in_double, frame, bits))) << bits;
    }
  }
}

TEST(SteppedEdges, AreSteppedInTheRowsOfTheFrame) {
  const double reach = 2 * kU * 102 * 1900;  // of 100 rows: 0.023
  using enum Conventions::DepthArithmetic;
  EXPECT_EQ(extra_fragment(0.95 * reach, in_float_stepped, {2000, 100}).differing, 0u);
  EXPECT_TRUE(fails(extra_fragment(1.4 * reach, in_float_stepped, {2000, 100}))) << "the grid reaches a fifth of that";
}

// Edge functions that are added up over the triangle's box: its steps times its diagonal, and in any direction, which
// the factor of sqrt(2) allows for.
TEST(SteppedEdges, AreDisplacedByTheStepsOfTheirEdgeFunctions) {
  using enum Conventions::DepthArithmetic;
  const glm::dvec2 box(1802.5, 1802);
  const double steps = 1805 + 1804, reach = std::sqrt(2.0) * kU * (steps + 6) * glm::length(box);  // 0.78
  EXPECT_EQ(extra_fragment(0.95 * reach, in_float_stepped_edges).differing, 0u);
  EXPECT_TRUE(fails(extra_fragment(1.1 * reach, in_float_stepped_edges)));
  EXPECT_TRUE(fails(extra_fragment(0.5 * reach, in_float_stepped_edges, {2000, 100}))) << "fewer steps in the frame";
}

// A triangle with a corner 4,000 rows below the frame, and a fragment in it.
struct FarCorner {
  FarCorner() {
    scene.frame.width = scene.frame.height = 100;
    scene.frame.depth = DepthFormat::z32f;
    WindowTriangle<double> t{};
    t.corners = 3, t.front = true;
    t.v[0].p_win = {-50, -4000, 0.25}, t.v[1].p_win = {150, -4000, 0.5}, t.v[2].p_win = {50, 100, 0.75};
    for (auto& v : t.v) v.inv_w = 1, v.color = Vec4<double>(1);
    corners = {t.v[0].p_win, t.v[1].p_win, t.v[2].p_win};
    records.triangles = {t};
    records.covered = {{0, 50, 50}};
    records.depth = {0.7};
    records.attributes.resize(1);
    records.attributes[0].color = Vec4<double>(0.5);
    conventions.depth_arithmetic = Conventions::DepthArithmetic::in_float_stepped;
  }
  Scene scene;
  Records<double> records;
  WindowCorners corners;
  Conventions conventions;
  static constexpr double kStranger = 8;
  const glm::dvec2 p{50.5, 50.5}, frame{100, 100};
};

TEST(SteppedDepths, OfRecordsAreSteppedInTheFrame) {
  const FarCorner of;
  const auto arithmetic = Conventions::DepthArithmetic::in_float_stepped;
  const double bound = depth_error(arithmetic, of.corners, of.p, of.frame),
               of_all_rows = depth_error(arithmetic, of.corners, of.p, kNoSides);
  ASSERT_GT(of_all_rows, 4 * bound);
  const auto compared = [&](double off) {
    Records<double> mine = of.records;
    mine.depth[0] += off;
    return compare_depth(of.scene, mine, of.records, 0.501, of.conventions, FarCorner::kStranger);
  };
  EXPECT_TRUE(passes(compared(0.9 * bound)));
  EXPECT_TRUE(fails(compared(0.5 * of_all_rows)));
}

TEST(SteppedDepths, OfRecordsAttributesAreSteppedInTheFrame) {
  const FarCorner of;
  const auto arithmetic = Conventions::DepthArithmetic::in_float_stepped;
  const double bound = attribute_error(shares_error(arithmetic, of.corners, of.p, of.frame), 1),
               of_all_rows = attribute_error(shares_error(arithmetic, of.corners, of.p, kNoSides), 1);
  ASSERT_GT(of_all_rows, 4 * bound);
  const auto compared = [&](double off, glm::dvec2 frame) {
    Records<double> mine = of.records;
    mine.attributes[0].color.r += off;
    return compare_attributes(mine, of.records, 10, FarCorner::kStranger, of.conventions, frame);
  };
  EXPECT_TRUE(passes(compared(0.9 * bound, of.frame)));
  EXPECT_TRUE(fails(compared(0.5 * of_all_rows, of.frame)));
  EXPECT_TRUE(passes(compared(0.5 * of_all_rows, kNoSides)));
}

}  // namespace
}  // namespace plumbline::check
