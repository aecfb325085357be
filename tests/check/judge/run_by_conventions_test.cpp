// Stages of renderers whose conventions are others than OpenGL's.
#include "check/judge/run_by_conventions.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "check/compare/compare_records.h"
#include "reference/exact/exact.h"
#include "tests/check/fixtures.h"
#include "tests/check/judge/row_of.h"

namespace plumbline::check {
namespace {

using C = Conventions;

C by_rule(C::TieRule rule) {
  C out;
  out.tie_rule = rule;
  return out;
}

struct ByConventions : testing::Test {
  ByConventions() {
    scene.name = "test/by_conventions";
    scene.frame.width = 8, scene.frame.height = 6;
    scene.meshes.push_back(make_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 2}}, {}));
    scene.draws.emplace_back();
    candidate.width = 8, candidate.height = 6;
  }
  // Two halves of the square of pixels' centres (2, 1) to (5, 4).
  void add_square() {
    const glm::dvec3 a(2.5, 1.5, 0), b(5.5, 1.5, 0), c(5.5, 4.5, 0), d(2.5, 4.5, 0);
    candidate.records.triangles = {triangle_of({a, b, c}, {1, 1, 1}, 0), triangle_of({a, c, d}, {1, 1, 1}, 1)};
  }
  // A clip polygon of these corners in the window, of the only triangle.
  void add_polygon(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    scene.meshes[0].triangles.resize(1);
    Records<double>& r = candidate.records;
    r.matrices.resize(1);
    r.matrices[0].win_scale = {4, 3, 0.5}, r.matrices[0].win_translate = {4, 3, 0.5};
    for (const glm::dvec2 p : {a, b, c})
      r.polygons.vertices.push_back({{(p.x - 4) / 4, (p.y - 3) / 3, 0, 1}, glm::dvec4(1), false});
    r.polygons.polygons = {{0, 0, 3}};
  }
  Capture covered_by(C::TieRule rule) {
    return run_by_conventions(*exact, scene, Stage::coverage, candidate, by_rule(rule));
  }

  Scene scene;
  Capture candidate;
  std::unique_ptr<Renderer> exact = exact::make_exact();
};

// Each rule gives the square 3 x 3 of its 4 x 4 centres, which lie on its sides or within.
TEST_F(ByConventions, SamplesOnSidesAreOwnedByTheRule) {
  add_square();
  using enum C::TieRule;
  for (const auto& [rule, x0, y0] : {std::tuple(left_bottom, 2, 1), std::tuple(left_top, 2, 2),
                                     std::tuple(right_bottom, 3, 1), std::tuple(right_top, 3, 2)}) {
    const Capture made = covered_by(rule);
    ASSERT_EQ(made.records.covered.size(), 9u);
    EXPECT_TRUE(std::ranges::is_sorted(made.records.covered, {},
                                       [](const Covered& c) { return std::tuple(c.triangle, c.y, c.x); }));
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 8; ++x) {
        const bool is_in = x >= x0 && x < x0 + 3 && y >= y0 && y < y0 + 3;
        EXPECT_EQ(made.planes.count(x, y), is_in ? 1u : 0u) << x << ',' << y << ", rule " << static_cast<int>(rule);
      }
    }
    EXPECT_TRUE(are_sums_of(
        [&] {
          Records<double> all = candidate.records;
          all.covered = made.records.covered;
          return all;
        }(),
        made.planes));
  }
}

TEST_F(ByConventions, AScissorBoxStaysWhereItIs) {
  add_square();
  scene.draws[0].scissor = Scissor{3, 2, 2, 9};
  for (const auto rule : {C::TieRule::left_bottom, C::TieRule::right_top}) {
    const Capture made = covered_by(rule);
    EXPECT_EQ(made.planes.count(2, 2) + made.planes.count(5, 3) + made.planes.count(3, 1), 0u);
    EXPECT_EQ(made.planes.count(3, 2), 1u);
    EXPECT_EQ(made.planes.count(4, 3), 1u);
  }
}

// A box that reaches beyond the frame ends with it.
TEST_F(ByConventions, AScissorBoxMayReachBeyondTheFrame) {
  add_square();
  scene.draws[0].scissor = Scissor{3, 2, 100000, 100000};
  EXPECT_EQ(std::ranges::count(covered_by(C::TieRule::left_bottom).planes.count.values(), 1u), 4);
  EXPECT_EQ(std::ranges::count(covered_by(C::TieRule::right_top).planes.count.values(), 1u), 9);
}

// A triangle that the grid turns over is drawn where its unsnapped corners decide its face.
TEST_F(ByConventions, TrianglesThatTheGridTurnsOverAreCoveredByEitherFace) {
  add_square();
  WindowTriangle<double>& t = candidate.records.triangles[0];
  const auto fragments = [&] {
    return std::ranges::count(covered_by(C::TieRule::left_bottom).records.covered, 0u, &Covered::triangle);
  };
  const auto all = fragments();
  t.front = !t.front;
  std::swap(t.v[1].p_win, t.v[2].p_win);  // faced as the unsnapped corners
  EXPECT_EQ(fragments(), 0) << "not drawn";
  candidate.records.covered = {{0, 3, 2}};
  EXPECT_EQ(fragments(), all) << "drawn";
}

TEST_F(ByConventions, ARuleIsKnownWhereItsGridIs) {
  C c = by_rule(C::TieRule::left_top);
  EXPECT_TRUE(knows_ties(scene, c));
  c.subpixel_bits = 9;
  EXPECT_FALSE(knows_ties(scene, c)) << "window.snapped does not hold it";
  c.subpixel_bits = C::kFloat;
  EXPECT_FALSE(knows_ties(scene, c));
  for (const auto rule : {C::TieRule::any, C::TieRule::inclusive, C::TieRule::exclusive})
    EXPECT_FALSE(knows_ties(scene, by_rule(rule)));
  scene.frame.pass.sample = 1;
  EXPECT_FALSE(knows_ties(scene, by_rule(C::TieRule::left_top)));
}

// A quarter of red over 34.53 codes of blue, which are stored as 35 or, truncated, as 34.
TEST_F(ByConventions, StoredColorsAreRoundedAsDeclaredBeforeTheNextBlends) {
  add_square();
  constexpr BlendTerm kOver{BlendFactor::source_alpha, BlendFactor::one_minus_source_alpha, BlendEquation::add};
  scene.draws[0].merge.blend = Blend{kOver, kOver, glm::vec4(0)};
  scene.draws[0].depth_func = DepthFunc::always;
  Records<double>& r = candidate.records;
  r.covered = {{0, 4, 2}, {1, 4, 2}};
  r.depth = {0.5, 0.5};
  r.shaded = {{glm::dvec4(0, 0, 0.1354, 1)}, {glm::dvec4(1, 0, 0, 0.25)}};
  r.drawn = {{true}, {true}};
  const auto blue = [&](C::Rounding rounding, Capture& made) {
    C c;
    c.color_rounding = rounding;
    made = run_by_conventions(*exact, scene, Stage::merge, candidate, c);
    return 255.0 * static_cast<double>(made.planes.color(4, 2).b);
  };
  Capture made;
  EXPECT_NEAR(blue(C::Rounding::nearest, made), 0.75 * 35, 1e-4);
  EXPECT_NEAR(blue(C::Rounding::down, made), 0.75 * 34, 1e-4);
  EXPECT_NEAR(255.0 * static_cast<double>(made.legal.color_hi(4, 2).b), 0.75 * 34, 1e-4);
  EXPECT_EQ(made.planes.color(0, 0), scene.frame.clear_color);
  r.drawn = {{true}, {false}};
  EXPECT_NEAR(blue(C::Rounding::down, made), 34.527, 1e-3) << "what is written last is not rounded";
}

// Half of 21 codes, 10.5 and some 1e-7 in floats, is stored as 10 or as 11 by a stranger, and is read again.
TEST_F(ByConventions, AStrangersSumHalfWayBetweenTwoCodesMayBeEither) {
  add_square();
  constexpr BlendTerm kHalf{BlendFactor::source_alpha, BlendFactor::one, BlendEquation::add};
  scene.draws[0].merge.blend = Blend{kHalf, kHalf, glm::vec4(0)};
  scene.draws[0].depth_func = DepthFunc::always;
  scene.frame.clear_color = glm::vec4(0, 0, 0, 1);
  Records<double>& r = candidate.records;
  r.covered = {{0, 4, 2}, {1, 4, 2}};
  r.depth = {0.5, 0.5};
  r.shaded = {{glm::dvec4(21 / 255.0 + 1e-9, 0, 0, 0.5)}, {glm::dvec4(0, 0, 0, 1)}};
  r.drawn = {{true}, {true}};
  candidate.planes = exact->run_stage(scene, Stage::merge, candidate).planes;
  const auto outcome = [&](float code, bool foreign) {
    candidate.planes.color(4, 2).r = code / 255;
    return row_of_stage(scene, candidate, Stage::merge, {}, foreign).outcome;
  };
  EXPECT_NE(outcome(11, false), Outcome::different);
  EXPECT_EQ(outcome(10, false), Outcome::different) << "ours blends in double";
  EXPECT_NE(outcome(11, true), Outcome::different);
  EXPECT_NE(outcome(10, true), Outcome::different);
  EXPECT_EQ(outcome(9, true), Outcome::different);
  EXPECT_EQ(outcome(12, true), Outcome::different);
}

// A fragment that is wrong by the rule is found, unless rounding decides where a corner is snapped to.
TEST_F(ByConventions, AWrongRuleIsFound) {
  add_square();
  const C c = by_rule(C::TieRule::left_top);
  Records<double> mine = candidate.records;
  mine.covered = covered_by(C::TieRule::left_bottom).records.covered;
  SnappedBy by = SnappedBy::conventions;
  const auto compared = [&] {
    Capture in = candidate;
    in.records = mine;
    return compare_covered_by_rule(mine, run_by_conventions(*exact, scene, Stage::coverage, in, c).records, c, by);
  };
  EXPECT_EQ(compared().differing, 6u) << "3 at the bottom, 3 at the top";
  mine.covered = covered_by(C::TieRule::left_top).records.covered;
  EXPECT_EQ(compared().differing, 0u);
  mine.covered = covered_by(C::TieRule::left_bottom).records.covered;
  for (WindowTriangle<double>& t : mine.triangles) t.v[0].p_win.y += 0.5 / 256;
  EXPECT_EQ(compared().differing, 0u);
  EXPECT_EQ(compared().ambiguous, 6u);
  by = SnappedBy::renderer;
  EXPECT_EQ(compared().differing, 6u) << "it hands out where it snapped the corner to";
}

// Corners on lines of a grid that is rounded down: places that the renderer hands out settle the rule, others do not.
TEST_F(ByConventions, AWrongRuleIsFoundOnGridsThatAreRoundedDown) {
  add_square();
  C c = by_rule(C::TieRule::left_top);
  c.subpixel_bits = 4;
  c.subpixel_rounding = C::Rounding::down;
  EXPECT_TRUE(knows_ties(scene, c));
  const auto compared = [&](C::TieRule rule, SnappedBy snapped_by) {
    Capture in = candidate;
    in.records.covered = covered_by(rule).records.covered;
    const Capture made = run_by_conventions(*exact, scene, Stage::coverage, in, c);
    return compare_covered_by_rule(in.records, made.records, c, snapped_by);
  };
  EXPECT_EQ(compared(C::TieRule::left_top, SnappedBy::renderer).differing, 0u);
  EXPECT_EQ(compared(C::TieRule::left_top, SnappedBy::renderer).ambiguous, 0u);
  EXPECT_EQ(compared(C::TieRule::left_bottom, SnappedBy::renderer).differing, 6u);
  EXPECT_EQ(compared(C::TieRule::left_bottom, SnappedBy::conventions).differing, 0u);
  EXPECT_EQ(compared(C::TieRule::left_bottom, SnappedBy::conventions).ambiguous, 6u);
  c.rows = C::Rows::from_top;
  EXPECT_FALSE(knows_ties(scene, c)) << "the rounding is the rows' own";
}

// A corner that lies 0.4 steps to the right of its place on the grid: depth and attributes go by either.
TEST_F(ByConventions, DeclaredCornersAreInterpolatedBetween) {
  for (const int bits : {4, 8, 10}) {
    add_square();
    Records<double>& r = candidate.records;
    r.covered = covered_by(C::TieRule::left_bottom).records.covered;
    for (WindowTriangle<double>& t : r.triangles) t.v[1].color = glm::dvec4(1, 0, 0.5, 1), t.v[1].p_win.z = 1;
    const Capture on_grid = candidate;
    for (WindowTriangle<double>& t : r.triangles) t.v[1].p_win.x += std::ldexp(0.4, -bits);
    C c;
    c.subpixel_bits = bits;
    const auto made_by = [&](C::Corners corners, Stage stage) {
      c.attribute_corners = corners;
      c.depth_corners = corners == C::Corners::snapped ? C::DepthCorners::snapped : C::DepthCorners::either;
      return run_by_conventions(*exact, scene, stage, candidate, c).records;
    };
    const auto plain = exact->run_stage(scene, Stage::attributes, candidate).records.attributes;
    const auto expected = exact->run_stage(scene, Stage::attributes, on_grid).records.attributes;
    const auto as_they_are = made_by(C::Corners::as_they_are, Stage::attributes).attributes,
               snapped = made_by(C::Corners::snapped, Stage::attributes).attributes;
    ASSERT_EQ(snapped.size(), 9u);
    bool moves = false;
    for (std::size_t i = 0; i < snapped.size(); ++i) {
      EXPECT_EQ(as_they_are[i].color, plain[i].color);
      EXPECT_EQ(snapped[i].color, expected[i].color);
      moves |= plain[i].color != expected[i].color;
    }
    EXPECT_TRUE(moves);
    EXPECT_EQ(made_by(C::Corners::snapped, Stage::depth).depth,
              exact->run_stage(scene, Stage::depth, on_grid).records.depth);
    c.subpixel_bits = C::kFloat;
    EXPECT_EQ(made_by(C::Corners::snapped, Stage::attributes).attributes[0].color, plain[0].color) << "no grid";
  }
}

// Without perspective, the colour half way along the first side is the mean of its ends' whatever their distances are.
TEST_F(ByConventions, AffineColoursAreThoseOfOneDistance) {
  add_square();
  Records<double>& r = candidate.records;
  r.covered = covered_by(C::TieRule::left_bottom).records.covered;
  r.triangles[0].v[1].color = glm::dvec4(0, 0, 0, 1), r.triangles[0].v[1].inv_w = 0.25;
  const auto equal_ones = [&] {
    Capture flat = candidate;
    for (WindowTriangle<double>& t : flat.records.triangles) {
      for (WindowVertex<double>& v : t.v) v.inv_w = 1;
    }
    return exact->run_stage(scene, Stage::attributes, flat).records.attributes[1].color;
  }();
  C c;
  const auto color = [&] {
    return run_by_conventions(*exact, scene, Stage::attributes, candidate, c).records.attributes[1].color;
  };
  const auto with_perspective = color();
  c.interpolation = C::Interpolation::affine;
  EXPECT_EQ(color(), equal_ones);
  EXPECT_NE(with_perspective, equal_ones);
  candidate.records.depth = run_by_conventions(*exact, scene, Stage::depth, candidate, c).records.depth;
  EXPECT_EQ(r.depth, exact->run_stage(scene, Stage::depth, candidate).records.depth) << "depths are affine anyway";
}

// A triangle 0.3 steps of 1/256 pixel high, and of 0.45: on finer grids it has an area, which exact's does not have.
TEST_F(ByConventions, WindowTrianglesHaveAnAreaOnTheDeclaredGrid) {
  add_polygon({1, 2.5 + 0.3 / 256}, {7, 2.5 + 0.3 / 256}, {4, 2.5 + 0.45 / 256});
  Records<double>& r = candidate.records;
  C c;
  const auto triangles = [&] {
    return run_by_conventions(*exact, scene, Stage::window, candidate, c).records.triangles;
  };
  for (const auto& [bits, rounding, has_area] :
       {std::tuple(8, C::Rounding::nearest, false), std::tuple(4, C::Rounding::nearest, false),
        std::tuple(10, C::Rounding::nearest, true), std::tuple(10, C::Rounding::down, false),
        std::tuple(11, C::Rounding::up, true), std::tuple(C::kFloat, C::Rounding::nearest, true)}) {
    c.subpixel_bits = bits, c.subpixel_rounding = rounding;
    const auto made = triangles();
    ASSERT_EQ(made.size(), has_area ? 1u : 0u) << bits << " bits";
    if (made.empty()) continue;
    EXPECT_TRUE(made[0].front);
    for (const WindowVertex<double>& v : made[0].v) {
      EXPECT_NEAR(v.p_win.y, 2.5 + (v.p_win.x == 4 ? 0.45 : 0.3) / 256, 1e-12);
      EXPECT_EQ(v.snapped.y, static_cast<int>(snapped(c, 1, (v.p_win.y - 0.5) * kSubpixel)));
    }
  }
  c.sample = {0, 0.25};
  const auto moved = triangles();
  ASSERT_EQ(moved.size(), 1u);
  for (const WindowVertex<double>& v : moved[0].v)
    EXPECT_NEAR(v.p_win.y, 2.75 + (v.p_win.x == 4.5 ? 0.45 : 0.3) / 256, 1e-12) << "the sample is moved to the centre";
  c.sample = {0.5, 0.5}, c.subpixel_bits = 4, c.subpixel_rounding = C::Rounding::up;
  r.polygons.vertices[2].p_clip.y -= 0.3 / 256 / 3;  // on either side of a place of the grid
  EXPECT_EQ(triangles().size(), 0u);
  r.polygons.vertices[2].p_clip.y += 0.3 / 256 / 3 - 0.6 / 256 / 3;
  EXPECT_EQ(triangles().size(), 1u);
}

// Whole pixels are counted from the frame's side, wherever the sample lies.
TEST_F(ByConventions, WindowTrianglesLieOnWholePixels) {
  add_polygon({1.25, 1.25}, {6.75, 1.25}, {6.75, 3.75});
  C c;
  c.subpixel_bits = 0;
  for (const double sample : {0.5, 0.0, 0.25}) {
    c.sample = glm::dvec2(sample);
    const auto made = run_by_conventions(*exact, scene, Stage::window, candidate, c).records.triangles;
    ASSERT_EQ(made.size(), 1u);
    for (const WindowVertex<double>& v : made[0].v) {
      const glm::dvec2 own = glm::dvec2(v.snapped) / 256.0 + sample, p = glm::dvec2(v.p_win) - 0.5 + sample;
      EXPECT_EQ(own, glm::dvec2(p.x < 4 ? 1 : 7, p.y < 2 ? 1 : 4)) << sample;
    }
  }
}

// Alpha 0.5 + 0.0001 is the code of 0.5, and greater in float.
TEST_F(ByConventions, AlphasAreComparedAsTheyAreInFloat) {
  add_square();
  scene.draws[0].alpha_test = AlphaTest{CompareFunc::greater, 0.5};
  Records<double>& r = candidate.records;
  r.covered = covered_by(C::TieRule::left_bottom).records.covered;
  r.depth.assign(r.covered.size(), 0.5);
  r.shaded.assign(r.covered.size(), {{1, 1, 1, 0.5001}});
  r.shaded[2].color.a = 0.5;
  C c;
  const auto drawn = [&] {
    const Capture made = run_by_conventions(*exact, scene, Stage::visibility, candidate, c);
    EXPECT_EQ(made.records.drawn.size(), r.covered.size());
    return std::ranges::count(made.records.drawn, true, &plumbline::Drawn::drawn);
  };
  EXPECT_EQ(drawn(), 0);
  c.alpha_test = C::AlphaTest::in_float;
  EXPECT_EQ(drawn(), 8);
}

// A polygon offset's unit of one depth format says nothing of frames of another.
TEST_F(ByConventions, OffsetsAreOtherwiseInFramesOfTheUnitsFormat) {
  scene.draws[0].polygon_offset.units = 1;
  C of_floats, of_24_bits, of_16_bits;
  of_floats.float_offset_unit = 0x1p-23, of_24_bits.offset_unit.x = 1, of_16_bits.offset_unit.y = 1;
  using enum DepthFormat;
  for (const DepthFormat format : {z16, z24, z32f}) {
    scene.frame.depth = format;
    EXPECT_EQ(differs_from_opengl(scene, of_floats, Stage::depth), format == z32f);
    EXPECT_EQ(differs_from_opengl(scene, of_24_bits, Stage::depth), format == z24);
    EXPECT_EQ(differs_from_opengl(scene, of_16_bits, Stage::depth), format == z16);
    EXPECT_FALSE(differs_from_opengl(scene, of_24_bits, Stage::coverage));
  }
}

TEST_F(ByConventions, ColorsAreOtherwiseInFogOfVerticesAndInCodes) {
  C by_vertices, radial, in_codes, of_vertices, affine;
  by_vertices.fog_factor = C::FogFactor::per_vertex, in_codes.fragment_colors = C::ColorNumbers::in_codes;
  radial.fog_distance = C::FogDistance::eye_radial;
  EXPECT_FALSE(differs_from_opengl(scene, by_vertices, Stage::shade)) << "no fog";
  scene.draws[0].fog.emplace();
  for (const Stage stage : {Stage::shade, Stage::merge})
    EXPECT_TRUE(differs_from_opengl(scene, by_vertices, stage) && differs_from_opengl(scene, radial, stage));
  EXPECT_TRUE(differs_from_opengl(scene, in_codes, Stage::attributes));
  of_vertices.vertex_colors = C::ColorNumbers::in_codes;
  affine.color_interpolation = C::ColorInterpolation::affine;
  for (const Stage stage : {Stage::light, Stage::clip, Stage::attributes, Stage::merge})
    EXPECT_TRUE(differs_from_opengl(scene, of_vertices, stage));
  for (const Stage stage : {Stage::vertex, Stage::window, Stage::coverage, Stage::depth, Stage::visibility})
    EXPECT_FALSE(differs_from_opengl(scene, of_vertices, stage)) << name_of(stage);
  EXPECT_TRUE(differs_from_opengl(scene, affine, Stage::attributes));
  EXPECT_FALSE(differs_from_opengl(scene, affine, Stage::light));
  for (const C& c : {by_vertices, in_codes}) {
    EXPECT_FALSE(differs_from_opengl(scene, c, Stage::depth));
    EXPECT_FALSE(differs_from_opengl(scene, c, Stage::visibility));
  }
  scene.draws[0].alpha_test = AlphaTest{CompareFunc::greater, 0.5};
  EXPECT_TRUE(differs_from_opengl(scene, in_codes, Stage::visibility));
  EXPECT_FALSE(differs_from_opengl(scene, by_vertices, Stage::visibility)) << "fog leaves alpha alone";
  scene.frame.color = ColorFormat::rgba32f;
  EXPECT_FALSE(differs_from_opengl(scene, in_codes, Stage::merge)) << "a frame without codes";
}

}  // namespace
}  // namespace plumbline::check
