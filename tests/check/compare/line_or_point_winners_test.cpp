// The comparator of winners in scenes with lines or points, both ways.
#include "check/compare/compare_lines.h"
#include "tests/check/compare/lines.h"

namespace plumbline::check {
namespace {

// At (4, 3), the pixel above a line's middle: the line's fragment (1), whose depth of 0.55 moves by 0.05 where it goes
// by the major axis, and over it that of a point (9).
struct LineOrPointWinners : testing::Test {
  LineOrPointWinners() {
    scene.frame.width = 16;
    scene.frame.height = 12;
    scene.frame.depth = DepthFormat::z32f;
    scene.meshes.resize(1);
    scene.meshes[0].topology = Topology::lines;
    scene.meshes[0].triangles.resize(10);
    scene.draws.resize(1);
  }
  Capture with(double z, std::int32_t winner) const {
    WindowTriangle<double> point = line_of({4.5, 3.5}, {4.5, 3.5}, 9);
    point.corners = 1;
    for (auto& v : point.v) v.p_win.z = z;
    Capture c = drawn({line_of({2.5, 1.5}, {6.5, 3.5}, 1), point}, {{{4, 3}}, {{4, 3}}});
    c.records.depth = {0.55, z};
    c.planes.id(4, 3) = winner;
    return c;
  }
  Measurement compare(double z, std::int32_t mine, std::int32_t theirs) const {
    return compare_line_or_point_winners(scene, with(z, mine), with(z, theirs));
  }
  Scene scene;
};

TEST_F(LineOrPointWinners, OfNearlyOneDepthAreAmbiguous) {
  for (const double z : {0.5, 0.55, 0.6}) {
    EXPECT_TRUE(passes(compare(z, 1, 9))) << z;
    EXPECT_TRUE(passes(compare(z, 9, 1))) << z;
    EXPECT_EQ(compare(z, 1, 9).ambiguous, 1u);
    EXPECT_EQ(compare(z, 1, 1).ambiguous, 0u) << "of one winner nothing is asked";
  }
  for (const double z : {0.4999, 0.6001}) {
    EXPECT_TRUE(fails(compare(z, 1, 9))) << z;
    EXPECT_TRUE(fails(compare(z, 9, 1))) << z;
  }
  EXPECT_TRUE(fails(compare(0.5, kBackground, 9))) << "one of them is there";
  EXPECT_TRUE(fails(compare(0.5, 9, 2)));
}

TEST_F(LineOrPointWinners, DepthsThatStayInTheFrameExcuseNothing) {
  scene.draws[0].merge.depth_mask = false;  // both sides hold the cleared depth, and what is drawn last wins
  EXPECT_TRUE(fails(compare(0.5, 1, 9)));
  EXPECT_TRUE(fails(compare(0.5, 9, 1)));
  scene.draws[0].depth_func = DepthFunc::equal;
  EXPECT_TRUE(fails(compare(0.5, 1, kBackground)));
  EXPECT_TRUE(passes(compare(1 - 0x1p-25, 9, kBackground))) << "the cleared depth, or nearly";
}

TEST_F(LineOrPointWinners, StencilValuesAreThoseOfOpenTests) {
  scene.frame.stencil = StencilFormat::s8;
  Stencil test;
  test.front.pass = test.back.pass = StencilOp::increment;
  scene.draws[0].stencil = test;
  const auto against = [&](double z, int mine, int theirs) {
    Capture a = with(z, 1), b = with(z, 1);
    a.planes.stencil = b.planes.stencil = Plane<std::uint8_t>(16, 12, 0);
    a.planes.stencil(4, 3) = static_cast<std::uint8_t>(mine);
    b.planes.stencil(4, 3) = static_cast<std::uint8_t>(theirs);
    return compare_line_or_point_winners(scene, a, b);
  };
  EXPECT_TRUE(fails(against(0.55, 1, 2))) << "the line wins where the point is not counted";
  EXPECT_TRUE(fails(against(0.8, 1, 2)));
  EXPECT_TRUE(fails(against(0.8, 2, 1)));
  EXPECT_TRUE(passes(against(0.8, 1, 1)));
}

// A line drawn twice has one depth both times: less keeps the first, whatever error depths may have.
TEST_F(LineOrPointWinners, OfALineDrawnAgainAreNotOpen) {
  const auto drawn_again = [&](double right, std::int32_t winner) {
    Capture c = drawn({line_of({2.5, 1.5}, {6.5, 3.5}, 1), line_of({2.5, 1.5}, {right, 3.5}, 9)}, {{{4, 3}}, {{4, 3}}});
    c.records.depth = {0.55, 0.55};
    c.planes.id(4, 3) = winner;
    return c;
  };
  for (const double right : {6.5, 6.25}) {
    const Measurement m = compare_line_or_point_winners(scene, drawn_again(right, 9), drawn_again(right, 1));
    EXPECT_EQ(passes(m), right != 6.5) << "another line's depth may be less";
  }
}

TEST_F(LineOrPointWinners, AlphasThatFailAreNotDrawn) {
  scene.draws[0].alpha_test = AlphaTest{.func = CompareFunc::greater, .reference = 0.5f};
  Capture mine = with(0.5, 1), theirs = with(0.5, 9);
  mine.records.shaded = {{Vec4<double>(1)}, {Vec4<double>(0.25)}};
  EXPECT_TRUE(fails(compare_line_or_point_winners(scene, mine, theirs)));
  mine.records.shaded[1].color.a = 0.75;
  EXPECT_TRUE(passes(compare_line_or_point_winners(scene, mine, theirs)));
  mine.records.depth.pop_back();
  EXPECT_NE(compare_line_or_point_winners(scene, mine, theirs).mismatch, "");
}

}  // namespace
}  // namespace plumbline::check
