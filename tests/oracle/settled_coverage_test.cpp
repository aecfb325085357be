// Coverage that a renderer's grid, rounding and tie rule settle.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/oracle/window_answers.h"

namespace plumbline::math {
namespace {

using C = Conventions;

C declared(C::TieRule rule, int bits = 8) {
  C out;
  out.tie_rule = rule;
  out.subpixel_bits = bits;
  return out;
}

const std::vector<std::array<glm::vec3, 3>> kSquare = {
    {glm::vec3(4.5f, 4.5f, 0.5f), {28.5f, 4.5f, 0.5f}, {28.5f, 28.5f, 0.5f}},
    {glm::vec3(4.5f, 4.5f, 0.5f), {28.5f, 28.5f, 0.5f}, {4.5f, 28.5f, 0.5f}}};

// A square whose borders run through samples: a declared tie rule says which of them are in, and in which triangle.
TEST(SettledCoverage, ADeclaredTieRuleSettlesSamplesOnEdges) {
  using enum C::TieRule;
  const Scene scene = window_scene(kSquare);
  EXPECT_EQ(open_pixels(legal(scene, {})), 4u * 24) << "by any rule, the border is open";
  struct Case {
    C::TieRule rule;
    std::uint32_t left, right, bottom, top, inner;
    std::int32_t owner;  // of the diagonal, whose lower triangle is the first
  };
  for (const Case& c : {Case{left_bottom, 1, 0, 1, 0, 1, 0}, Case{left_top, 1, 0, 0, 1, 1, 0},
                        Case{right_bottom, 0, 1, 1, 0, 1, 1}, Case{right_top, 0, 1, 0, 1, 1, 1},
                        Case{inclusive, 1, 1, 1, 1, 2, 0}, Case{exclusive, 0, 0, 0, 0, 0, kBackground}}) {
    for (const int bits : {8, C::kFloat}) {
      const std::string name = std::string(name_of(c.rule)) + ", bits " + bits_text(bits);
      const Legal by = legal(scene, declared(c.rule, bits));
      EXPECT_EQ(open_pixels(by), 0u) << name;
      EXPECT_EQ(by.certain(4, 16), c.left) << name;
      EXPECT_EQ(by.certain(28, 16), c.right) << name;
      EXPECT_EQ(by.certain(16, 4), c.bottom) << name;
      EXPECT_EQ(by.certain(16, 28), c.top) << name;
      EXPECT_EQ(by.certain(16, 16), c.inner) << name;
      const std::size_t winners = c.rule == inclusive ? 2 : 1;  // depths of one plane may compare either way
      ASSERT_EQ(by.at(16, 16).size(), winners) << name;
      EXPECT_EQ(by.at(16, 16)[0].primitive, c.owner) << name;
    }
  }
}

// An edge of slope 3/2 through samples, and straight ones: by differences, float rounds the slanted edge's function
// alone; by edge equations, all.
TEST(SettledCoverage, FloatDecidesTiesByTheSignOfAnEdgeFunction) {
  const Scene scene = window_scene({{glm::vec3(4.5f, 4.5f, 0.5f), {20.5f, 28.5f, 0.5f}, {4.5f, 28.5f, 0.5f}}});
  using enum C::TieRule;
  for (const C::TieRule rule : {inclusive, exclusive, left_bottom}) {
    C in_float = declared(rule);
    in_float.depth_arithmetic = C::DepthArithmetic::in_float;
    const Legal by = legal(scene, in_float), by_double = legal(scene, declared(rule));
    EXPECT_EQ(open_pixels(by_double), 0u) << name_of(rule);
    EXPECT_EQ(by.certain(4, 16), by_double.certain(4, 16)) << name_of(rule) << ": upright";
    EXPECT_EQ(by.certain(8, 28), by_double.certain(8, 28)) << name_of(rule) << ": level";
    EXPECT_EQ(by.certain(6, 7) != by.possible(6, 7), rule != left_bottom) << name_of(rule);
    EXPECT_EQ(by.certain(2, 1), by.possible(2, 1)) << name_of(rule) << ": beyond the edge's end";
    EXPECT_EQ(by.certain(20, 28) != by.possible(20, 28), rule == inclusive) << "a level edge leaves out the corner";
    in_float.depth_arithmetic = C::DepthArithmetic::in_float_from_origin;
    const Legal by_equations = legal(scene, in_float);
    EXPECT_EQ(by_equations.certain(4, 16) != by_equations.possible(4, 16), rule != left_bottom) << name_of(rule);
    EXPECT_EQ(by_equations.certain(8, 20), 1u) << "inside";
  }
}

// Positions that are floats: edge functions are, too, and any rule goes by their signs.
TEST(SettledCoverage, FloatsSettleTiesBetweenCornersThatNoArithmeticRounds) {
  const std::vector<std::array<glm::vec3, 3>> triangle = {
      {glm::vec3(4.5f, 4.5f, 0.5f), {20.5f, 28.5f, 0.5f}, {4.5f, 28.5f, 0.5f}}};
  using enum C::TieRule;
  for (const C::TieRule rule : {inclusive, left_bottom, left_top}) {
    C floats = declared(rule, C::kFloat);
    EXPECT_EQ(open_pixels(legal(window_scene(triangle), floats)), 0u) << name_of(rule) << ": in double";
    EXPECT_GT(open_pixels(legal(window_scene(triangle, 33), floats)), 40u) << name_of(rule) << ": 1/33 is no float";
    floats.depth_arithmetic = C::DepthArithmetic::in_float;
    const Legal by = legal(window_scene(triangle), floats);
    EXPECT_EQ(by.certain(4, 16), 1u) << name_of(rule) << ": upright";
    EXPECT_EQ(by.certain(8, 28), rule == left_bottom ? 0u : 1u) << name_of(rule) << ": level";
    EXPECT_EQ(by.possible(8, 28), by.certain(8, 28)) << name_of(rule);
    EXPECT_NE(by.certain(6, 7), by.possible(6, 7)) << name_of(rule) << ": slanted";
    floats.depth_arithmetic = C::DepthArithmetic::in_float_from_origin;
    const Legal by_equations = legal(window_scene(triangle), floats);
    EXPECT_NE(by_equations.certain(4, 16), by_equations.possible(4, 16)) << name_of(rule);
    EXPECT_EQ(by_equations.certain(8, 20), 1u) << "inside";
  }
  // Floats hold all sums that lead to 20.5 + 2^-18 pixels; 1 + 2 / 32 (20.5 + 2^-19) takes 25 bits.
  for (const auto& [beside, is_known] : {std::pair(0x1p-18f, true), {0x1p-19f, false}}) {
    std::vector<std::array<glm::vec3, 3>> moved = triangle;
    moved[0][1].x += beside;
    const Legal by = legal(window_scene(moved), declared(left_bottom, C::kFloat));
    EXPECT_EQ(by.certain(8, 28) == by.possible(8, 28), is_known) << beside;
  }
}

// A side of 200 rows at 1/256 pixel beside a sample: 204 steps of 2^-15 pixel reach it, of 2^-16 pixel do not.
TEST(SettledCoverage, StepsInFixedPointLeaveOpenAsMuchAsTheyAddUpTo) {
  constexpr float at = 100.5f + 1.0f / 256;
  const Scene scene = window_scene({{glm::vec3(10, 3, 0.5f), {at, 3, 0.5f}, {at, 203, 0.5f}}}, 256);
  C fixed = declared(C::TieRule::left_bottom);
  fixed.edge_bits = 15;
  const Legal by_15 = legal(scene, fixed);
  EXPECT_NE(by_15.certain(100, 40), by_15.possible(100, 40));
  EXPECT_EQ(by_15.certain(99, 40), 1u);
  EXPECT_EQ(by_15.possible(101, 40), 0u);
  fixed.edge_bits = 16;
  const Legal by_16 = legal(scene, fixed);
  EXPECT_EQ(by_16.certain(100, 40), 1u);
}

// Samples on edges stay open where the grid is unknown, or float arithmetic decides to which grid point a corner
// snaps.
TEST(SettledCoverage, ATieRuleSettlesNothingWithoutPlaces) {
  const Scene scene = window_scene(kSquare);
  const std::size_t any = open_pixels(legal(scene, {}));
  C floats = declared(C::TieRule::left_bottom, C::kFloat), open_rule = floats,
    open_bits = declared(C::TieRule::left_bottom), from_top = open_bits, off_grid = open_bits;
  floats.sample = {0.501, 0.5}, open_rule.open = {"tie_rule"};
  open_bits.open = {"subpixel_bits"};
  from_top.subpixel_rounding = C::Rounding::down, from_top.rows = C::Rows::from_top;
  EXPECT_EQ(open_pixels(legal(scene, open_rule)), any);
  EXPECT_EQ(open_pixels(legal(scene, open_bits)), any);
  EXPECT_GE(open_pixels(legal(scene, from_top)), any);
  off_grid.sample = {0.501, 0.5};
  for (const C& beside : {off_grid, floats}) {
    C of_any = beside;
    of_any.tie_rule = C::TieRule::any;
    EXPECT_EQ(open_pixels(legal(scene, beside)), open_pixels(legal(scene, of_any)));
  }
  // Corners in the middle between two places of the grid.
  std::vector<std::array<glm::vec3, 3>> between = kSquare;
  for (auto& t : between)
    for (glm::vec3& p : t) p += glm::vec3(1.0f / 512, 1.0f / 512, 0);
  EXPECT_GT(open_pixels(legal(window_scene(between), declared(C::TieRule::left_bottom))), 90u);
  // A coarser grid takes them to places for certain.
  EXPECT_EQ(open_pixels(legal(window_scene(between), declared(C::TieRule::left_bottom, 4))), 0u);
}

// The diagonal's neighbours: one has a corner in the middle between two places. What the other leaves is still its.
TEST(SettledCoverage, AnUnknownCornerLeavesSharedEdgesCoveredOnce) {
  std::vector<std::array<glm::vec3, 3>> half = kSquare;
  half[1][2].x += 1.0f / 512;
  const Legal by = legal(window_scene(half), declared(C::TieRule::right_top));  // the diagonal is the second's
  for (int i = 6; i < 27; ++i) {
    EXPECT_EQ(by.certain(i, i), 1u) << i;
    EXPECT_EQ(by.possible(i, i), 1u) << i;
    ASSERT_EQ(by.at(i, i).size(), 1u) << i;
    EXPECT_EQ(by.at(i, i)[0].primitive, 1) << i;
  }
}

// A position of a triangle's corner, snapped [steps of 1/16 pixel].
glm::dvec2 snapped(glm::vec3 p, C::Rounding rounding) {
  return {rounded(rounding, 16 * static_cast<double>(p.x)), rounded(rounding, 16 * static_cast<double>(p.y))};
}
// Whether the centre of a pixel is inside of a counter-clockwise triangle. No centre lies on an edge.
bool is_inside(const std::array<glm::vec3, 3>& triangle, glm::ivec2 pixel, C::Rounding rounding) {
  const glm::dvec2 centre = 16.0 * (glm::dvec2(pixel) + 0.5);
  bool out = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 from = snapped(triangle[i], rounding), along = snapped(triangle[(i + 1) % 3], rounding) - from,
                     to = centre - from;
    out &= along.x * to.y - along.y * to.x > 0;
  }
  return out;
}

TEST(SettledCoverage, GoesByTheDeclaredRoundingOfPositions) {
  const std::vector<std::array<glm::vec3, 3>> slanted = {
      {glm::vec3(3.23f, 2.11f, 0.5f), {29.77f, 5.36f, 0.5f}, {9.96f, 27.83f, 0.5f}}};
  std::size_t apart = 0;
  for (const auto rounding : {C::Rounding::nearest, C::Rounding::down, C::Rounding::up}) {
    C grid = declared(C::TieRule::left_bottom, 4);
    grid.subpixel_rounding = rounding;
    const Legal by = legal(window_scene(slanted), grid);
    EXPECT_EQ(open_pixels(by), 0u) << name_of(rounding);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const bool is_covered = is_inside(slanted[0], {x, y}, rounding);
        EXPECT_EQ(by.certain(x, y), is_covered ? 1u : 0u) << x << "," << y << " " << name_of(rounding);
        apart += is_covered != is_inside(slanted[0], {x, y}, C::Rounding::nearest) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(apart, 4u) << "the roundings differ";
}

// Corners half a step above places, or below them: rounded to places that samples lie on.
TEST(SettledCoverage, TieRulesHoldWhateverTheRounding) {
  for (const auto rounding : {C::Rounding::down, C::Rounding::up}) {
    std::vector<std::array<glm::vec3, 3>> square = kSquare;
    for (auto& t : square) {
      for (glm::vec3& p : t) p += (rounding == C::Rounding::down ? 1.0f : -1.0f) / 32 * glm::vec3(1, 1, 0);
    }
    for (const auto rule : {C::TieRule::left_bottom, C::TieRule::right_top}) {
      C grid = declared(rule, 4);
      grid.subpixel_rounding = rounding;
      const Legal by = legal(window_scene(square), grid);
      const std::uint32_t left = rule == C::TieRule::left_bottom ? 1 : 0;
      EXPECT_EQ(open_pixels(by), 0u) << name_of(rounding) << " " << name_of(rule);
      EXPECT_EQ(by.certain(4, 16), left) << name_of(rounding) << " " << name_of(rule);
      EXPECT_EQ(by.certain(28, 16), 1 - left) << name_of(rounding) << " " << name_of(rule);
    }
  }
}

// Fixed point of 11 bits may take a position to the next place before it is rounded down.
TEST(SettledCoverage, IsOpenBesideWhereTheRoundingChanges) {
  C down = declared(C::TieRule::left_bottom, 4);
  down.subpixel_rounding = C::Rounding::down;
  const auto open_at = [&](float below) {
    std::vector<std::array<glm::vec3, 3>> square = kSquare;
    for (auto& t : square) {
      for (glm::vec3& p : t) p -= glm::vec3(below, below, 0);
    }
    return open_pixels(legal(window_scene(square), down));
  };
  EXPECT_GT(open_at(0x1p-13f), 0u);
  EXPECT_EQ(open_at(0x1p-11f), 0u);
  down.rows = C::Rows::from_top;
  EXPECT_GT(open_at(0x1p-11f), 0u) << "down and up swap in y";
}

// Legal answers of a frame that lies within a triangle.
Legal within(const C& conventions) {
  const Scene scene = window_scene({{glm::vec3(-16, -16, 0.5f), {128, -16, 0.5f}, {-16, 128, 0.5f}}});
  return legal(scene, conventions);
}
std::size_t open_within(const C& conventions) { return open_pixels(within(conventions)); }
std::size_t certain_within(const C& conventions) {
  return static_cast<std::size_t>(
      std::ranges::count_if(within(conventions).certain.values(), [](auto n) { return n > 0; }));
}

// Samples on a side of the frame, where a renderer may cut: a rule gives them to the cut triangle, or takes them.
TEST(SettledCoverage, IsOpenOnSidesThatCut) {
  EXPECT_EQ(open_within(declared(C::TieRule::left_bottom)), 0u);
  EXPECT_EQ(open_within(declared(C::TieRule::left_bottom, 0)), 0u) << "the sides are whole pixels";
  for (const auto& [rule, open] : {std::pair(C::TieRule::left_bottom, 0), std::pair(C::TieRule::right_bottom, kSize),
                                   std::pair(C::TieRule::right_top, 2 * kSize - 1)}) {
    C at_corner = declared(rule);
    at_corner.sample = {0, 0};
    EXPECT_EQ(open_within(at_corner), static_cast<std::size_t>(open)) << name_of(rule);
    at_corner.subpixel_bits = C::kFloat;
    EXPECT_EQ(open_within(at_corner), 2u * kSize - 1) << "floats may lie beside the first column and row";
  }
  C at_corner = declared(C::TieRule::left_bottom);
  at_corner.sample = {0.5, 1};
  EXPECT_EQ(open_within(at_corner), 1u * kSize) << "the last row";
  at_corner.sample = {0.25, 0.75};
  EXPECT_EQ(open_within(at_corner), 0u);
  C inclusive = declared(C::TieRule::inclusive);
  inclusive.sample = {0, 0};
  EXPECT_EQ(certain_within(inclusive), 1u * kSize * kSize) << "the frame's side is the triangle's, cut or not";
}

// Samples on the diagonals of the square that the sides leave of a triangle: in neither piece by an exclusive rule.
TEST(SettledCoverage, IsOpenOnDiagonalsOfCutPolygonsByAnExclusiveRule) {
  EXPECT_EQ(open_within(declared(C::TieRule::exclusive)), 2u * kSize);
  EXPECT_EQ(open_within(declared(C::TieRule::exclusive, C::kFloat)), 2u * kSize);
}

}  // namespace
}  // namespace plumbline::math
