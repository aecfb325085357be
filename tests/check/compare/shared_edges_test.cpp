// Samples on an edge that two triangles share: in one of the two, by records of a renderer in float.
#include "check/compare/shared_edges.h"

#include "check/compare/compare_records.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

using TieRule = Conventions::TieRule;

// Two halves of a square from (2, 2) to (10, 10), by its diagonal; (5.5, 5.5) lies on it.
struct SharedEdgesTest : testing::Test {
  SharedEdgesTest() {
    conventions.subpixel_bits = Conventions::kFloat;
    conventions.tie_rule = TieRule::any;
    triangles = {triangle_of({{{2, 2, 0.5}, {10, 2, 0.5}, {10, 10, 0.5}}}, {1, 1, 1}, 0),
                 triangle_of({{{2, 2, 0.5}, {10, 10, 0.5}, {2, 10, 0.5}}}, {1, 1, 1}, 1)};
  }
  // Pixel (5, 5) of the candidate in triangles `own`; the reference gives it to triangle 1.
  Measurement in(std::vector<std::uint32_t> own) const {
    Records<double> candidate, reference;
    candidate.triangles = reference.triangles = triangles;
    for (const std::uint32_t t : own) candidate.covered.push_back({t, 5, 5});
    reference.covered = {{1, 5, 5}};
    return compare_covered_except_edges(candidate, reference, conventions);
  }
  // One triangle, whose only fragment is the candidate's (extra), or the reference's.
  Measurement of_first(std::uint16_t x, std::uint16_t y, bool extra = true) const {
    Records<double> candidate, reference;
    candidate.triangles = reference.triangles = triangles;
    (extra ? candidate : reference).covered = {{0, x, y}};
    return compare_covered_except_edges(candidate, reference, conventions);
  }
  std::vector<WindowTriangle<double>> triangles;
  Conventions conventions;
};

TEST_F(SharedEdgesTest, ASampleIsInOneOfTheTwo) {
  EXPECT_TRUE(passes(in({0})));
  EXPECT_TRUE(passes(in({1})));
  EXPECT_TRUE(fails(in({}))) << "a crack";
  EXPECT_TRUE(fails(in({0, 1}))) << "painted twice";
}

TEST_F(SharedEdgesTest, ADeclaredRuleMayGiveItToBothOrToNone) {
  conventions.tie_rule = TieRule::inclusive;
  EXPECT_TRUE(passes(in({0, 1})));
  EXPECT_TRUE(fails(in({})));
  conventions.tie_rule = TieRule::exclusive;
  EXPECT_TRUE(passes(in({})));
  EXPECT_TRUE(fails(in({0, 1})));
}

TEST_F(SharedEdgesTest, ATriangleHasAPixelOnce) {
  Records<double> candidate, reference;
  candidate.triangles = reference.triangles = {triangles[0]};
  candidate.covered = {{0, 5, 5}};  // on its side, which no other shares
  EXPECT_TRUE(passes(compare_covered_except_edges(candidate, reference, conventions)));
  candidate.covered.push_back({0, 5, 5});
  EXPECT_TRUE(fails(compare_covered_except_edges(candidate, reference, conventions)));
}

TEST_F(SharedEdgesTest, ASampleBesideItMayBeInBothOrInNone) {
  triangles[0].v[2].p_win.x = triangles[1].v[1].p_win.x = 10 + 0x1p-20;
  EXPECT_TRUE(passes(in({0, 1})));
  EXPECT_TRUE(passes(in({})));
}

TEST_F(SharedEdgesTest, OfADeclaredGridOnlySamplesOnSnappedEdgesAreOpen) {
  triangles.pop_back();
  triangles[0].v[2].p_win.y +=
      0x1p-10;  // snapped to (10, 10): the sample lies on the edge, and beside it without a grid
  for (const int bits : {8, Conventions::kFloat}) {
    conventions.subpixel_bits = bits;
    EXPECT_TRUE(passes(of_first(5, 5)));
    EXPECT_TRUE(passes(of_first(5, 5, false)));
  }
  triangles[0].v[2].snapped.y += 1;  // the sample lies 0.001 pixel beside the edge
  EXPECT_TRUE(passes(of_first(5, 5)));
  conventions.subpixel_bits = 8;
  EXPECT_TRUE(fails(of_first(5, 5)));
  triangles[0].v[2].p_win.y = 10 + 0.5 / 256;  // half way between two positions
  EXPECT_TRUE(passes(of_first(5, 5)));
  conventions.subpixel_rounding = Conventions::Rounding::down;
  triangles[0].v[2].p_win.y = 10.001;
  EXPECT_TRUE(passes(of_first(5, 5))) << "snapped elsewhere than the reference's";
}

TEST_F(SharedEdgesTest, OnAGridTwoTrianglesShareTheirSnappedEdge) {
  conventions.subpixel_bits = 8;
  triangles[0].v[2].p_win.x += 0x1p-20;  // the unsnapped edge is shared by none
  EXPECT_TRUE(passes(in({0})));
  EXPECT_TRUE(fails(in({0, 1})));
  EXPECT_TRUE(fails(in({})));
}

// Float moves an edge by up to 5e-6 pixel here.
TEST_F(SharedEdgesTest, OtherEdgesNearByLeaveItOpen) {
  const auto with = [&](double off, glm::dvec3& p_win, glm::dvec3 from) {
    const glm::dvec3 was = p_win;
    p_win = from - glm::dvec3(off, off, 0);
    const bool open = passes(in({}));
    p_win = was;
    return open;
  };
  for (const double off : {0x1p-19, 0x1p-10}) {
    const bool open = off < 1e-4;
    EXPECT_EQ(with(off, triangles[0].v[1].p_win, {10 + off, 10, 0.5}), open) << "a sliver beyond the edge";
    EXPECT_EQ(with(off, triangles[1].v[2].p_win, {10, 10 + off, 0.5}), open) << "a sliver before it";
    for (auto* end : {&triangles[0].v[2], &triangles[1].v[1]}) end->p_win = {5.5 + off, 5.5 + off, 0.5};
    EXPECT_EQ(passes(in({})), open) << "beside the edge's end";
    for (auto* end : {&triangles[0].v[2], &triangles[1].v[1]}) end->p_win = {10, 10, 0.5};
  }
}

TEST_F(SharedEdgesTest, NoOtherTriangleIsFoundUnlessExactlyOneLiesBeyond) {
  const auto beyond = [&](std::uint32_t t, glm::dvec2 p) { return SharedEdges(triangles, false).beyond(t, p); };
  EXPECT_EQ(beyond(0, {5.5, 5.5}), 1u);
  EXPECT_EQ(beyond(1, {5.5, 5.5}), 0u);
  EXPECT_EQ(beyond(0, {2, 2}), std::nullopt) << "an end";
  EXPECT_EQ(beyond(0, {11, 11}), std::nullopt) << "beyond an end";
  EXPECT_EQ(beyond(0, {5.5, 2}), std::nullopt) << "on a side that no other has";
  EXPECT_EQ(beyond(0, {6.5, 5.5}), std::nullopt) << "within";
  triangles.push_back(triangles[1]);
  EXPECT_EQ(beyond(0, {5.5, 5.5}), std::nullopt) << "one of three";
  triangles.pop_back();
  triangles[1].v[2].p_win = {10, 4, 0.5};
  EXPECT_EQ(beyond(0, {5.5, 5.5}), std::nullopt) << "on the same side";
  triangles[1].v[2].p_win = {6, 6, 0.5};
  EXPECT_EQ(beyond(0, {5.5, 5.5}), std::nullopt) << "without area";
  triangles[1].corners = 2;
  EXPECT_EQ(beyond(0, {5.5, 5.5}), std::nullopt) << "a line";
}

}  // namespace
}  // namespace plumbline::check
