// Outlines whose facing snapping decides: what both sides may make of them, and what they leave open.
#include "check/bounds/open_pixels.h"
#include "check/compare/compare_records.h"
#include "check/compare/legal_window.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// A triangle of a 96 x 64 frame, its base 20 pixels, its tip so many steps of 1/256 pixel higher: front faces are drawn
// as lines, back faces as points.
struct OutlineScene {
  explicit OutlineScene(double steps = 0.501) {
    scene.frame.width = 96;
    scene.frame.height = 64;
    scene.meshes.resize(1);
    scene.meshes[0].triangles.resize(1);
    scene.draws.resize(1);
    scene.draws[0].front_mode = PolygonMode::line;
    scene.draws[0].back_mode = PolygonMode::point;
    records.matrices.resize(1);
    records.matrices[0].win_scale = {48, 32, 0.5};
    records.matrices[0].win_translate = {48, 32, 0.5};
    const WindowTriangle<double> t =
        triangle_of({{{30, 40, 0.5}, {50, 40, 0.5}, {40, 40 + steps / 256, 0.5}}}, {1, 1, 1}, 0);
    corners = t.v;
    records.polygons.polygons.push_back({0, 0, 3});
    for (const auto& v : corners) {
      const glm::dvec3 p_ndc = (v.p_win - records.matrices[0].win_translate) / records.matrices[0].win_scale;
      records.polygons.vertices.push_back({glm::dvec4(p_ndc, 1), v.color, false});
    }
  }
  // The records with the outline of a face.
  Records<double> as(bool front, PolygonMode mode) const {
    Records<double> out = records;
    for (std::size_t i = 0; i < 3; ++i) {
      WindowTriangle<double> t{};
      t.front = front;
      t.corners = mode == PolygonMode::line ? 2 : 1;
      const auto& from = mode == PolygonMode::line ? corners[(i + 2) % 3] : corners[i];
      t.v = {from, corners[i], corners[i]};
      out.triangles.push_back(t);
    }
    return out;
  }
  Records<double> front() const { return as(true, PolygonMode::line); }
  Records<double> back() const { return as(false, PolygonMode::point); }
  Measurement compare(const Records<double>& a, const Records<double>& b) const {
    return compare_window(scene, a, b, {4});
  }
  std::vector<std::uint32_t> turned(const Records<double>& a, const Records<double>& b) const {
    return turned_outlines(scene, a, b);
  }

  Scene scene;
  Records<double> records;
  std::array<WindowVertex<double>, 3> corners;
};
struct Outline : testing::Test, OutlineScene {};

TEST_F(Outline, MayBeAnyFaceThatRoundingMakesOfIt) {
  // Half a step rounds to none or one; a quarter to none: no area, a back face; a whole one is a front face.
  for (const auto& [steps, may_front, may_back] :
       {std::tuple(0.25, false, true), std::tuple(0.501, true, true), std::tuple(1.0, true, false)}) {
    const OutlineScene o(steps);
    EXPECT_EQ(passes(o.compare(o.front(), o.back())), may_front && may_back) << steps;
    EXPECT_EQ(passes(o.compare(o.back(), o.front())), may_front && may_back) << steps;
    EXPECT_TRUE(passes(o.compare(o.front(), o.front())));
  }
  EXPECT_EQ(compare(front(), back()).ambiguous, 3u);
  EXPECT_EQ(compare(front(), front()).ambiguous, 0u);
}

TEST_F(Outline, IsHeldToOneOfItsFaces) {
  EXPECT_FALSE(passes(compare(as(true, PolygonMode::point), front()))) << "the back's mode on a front face";
  EXPECT_FALSE(passes(compare(as(false, PolygonMode::line), back())));
  EXPECT_FALSE(passes(compare(records, front()))) << "not there: nothing is culled";
  scene.draws[0].cull = Cull::back;
  EXPECT_TRUE(passes(compare(records, front())));
  EXPECT_TRUE(passes(compare(front(), records)));
  EXPECT_FALSE(passes(compare(back(), front()))) << "culled";
  scene.draws[0].cull = Cull::none;
  Records<double> bad = back();
  bad.triangles[1].v[0].inv_w = 2;
  EXPECT_FALSE(passes(compare(bad, front()))) << "compared with the polygon's corners";
  bad = back();
  bad.triangles[1].v[2].color.g += kU;
  EXPECT_FALSE(passes(compare(bad, front())));
}

// Facing of a stranger, who may decide before snapping: a quarter of a step above the base is a front face.
TEST_F(Outline, OfAStrangerIsFacedByEitherArea) {
  const auto by_either = [](const OutlineScene& o, const Records<double>& a, const Records<double>& b) {
    return passes(compare_window(o.scene, a, b, {4, {}, 0, FacingArea::either}));
  };
  const OutlineScene low(0.25), high(1);
  EXPECT_TRUE(by_either(low, low.front(), low.back()));
  EXPECT_FALSE(by_either(high, high.back(), high.front())) << "both areas are a front face's";
  OutlineScene filled(0.25);
  filled.scene.draws[0].front_mode = filled.scene.draws[0].back_mode = PolygonMode::fill;
  filled.scene.draws[0].cull = Cull::back;
  Records<double> drawn = filled.records;
  drawn.triangles.push_back(
      triangle_of({filled.corners[0].p_win, filled.corners[1].p_win, filled.corners[2].p_win}, {1, 1, 1}, 0));
  drawn.triangles[0].front = true;
  EXPECT_TRUE(by_either(filled, drawn, filled.records));
}

// A triangle whose corners lie at one place, at w of 1, 2 and 4: a stranger may begin it at any of them.
TEST_F(Outline, CornersAtOnePlaceAreToldApartByTheirW) {
  scene.draws[0].front_mode = scene.draws[0].back_mode = PolygonMode::fill;
  const Vec3<double> place(30, 40, 0.5);
  const Matrices<double>& m = records.matrices[0];
  WindowTriangle<double> t = triangle_of({place, place, place}, {1, 1, 1}, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    const double w = k == 0 ? 1 : k == 1 ? 2 : 4;
    records.polygons.vertices[k].p_clip = glm::dvec4((place - m.win_translate) / m.win_scale * w, w);
    t.v[k].inv_w = 1 / w;
    t.v[k].color = records.polygons.vertices[k].color = Vec4<double>(1);
  }
  Conventions in_float;
  in_float.subpixel_bits = Conventions::kFloat;
  const auto passes_with = [&](double factor) {
    Records<double> drawn = records;
    drawn.triangles.push_back(t);
    drawn.triangles[0].v[1].inv_w *= factor;
    return passes(compare_window(scene, drawn, records, {4, in_float, 0, FacingArea::either}));
  };
  EXPECT_TRUE(passes_with(1));
  EXPECT_FALSE(passes_with(1 + 8 * kU));
}

// Equation 3.6 in float is off by 0.0034 pixel^2 there: 6 u of products that sum to 9,600.
TEST_F(Outline, OfAStrangerIsFacedByTheEquationInFloat) {
  Conventions in_float;
  in_float.subpixel_bits = Conventions::kFloat;
  const auto may_be_back = [&](double twice_the_area, FacingArea area) {
    const OutlineScene o(twice_the_area / 20 * 256);
    return passes(compare_window(o.scene, o.back(), o.front(), {4, in_float, 0, area}));
  };
  EXPECT_TRUE(may_be_back(0.002, FacingArea::either));
  EXPECT_FALSE(may_be_back(0.006, FacingArea::either));
  EXPECT_FALSE(may_be_back(0.002, FacingArea::snapped)) << "by differences of positions";
}

// The last corner of a polygon dents it by two steps of the grid, so that the last triangle of its fan is a back face.
TEST_F(Outline, OfAStrangerIsFacedTriangleByTriangleOrAsAPolygon) {
  OutlineScene dented;
  dented.scene.draws[0].front_mode = dented.scene.draws[0].back_mode = PolygonMode::fill;
  const std::array<Vec3<double>, 4> places = {
      Vec3<double>(30, 40, 0.5), {50, 40, 0.5}, {50, 50, 0.5}, {40, 45 - 2.0 / 256, 0.5}};
  Records<double> base = dented.records;
  base.polygons = {};
  base.polygons.polygons.push_back({0, 0, 4});
  for (const Vec3<double>& p : places) {
    const glm::dvec3 p_ndc = (p - base.matrices[0].win_translate) / base.matrices[0].win_scale;
    base.polygons.vertices.push_back({glm::dvec4(p_ndc, 1), Vec4<double>(1), false});
  }
  const auto drawn = [&](bool first, bool second) {
    Records<double> out = base;
    out.triangles.push_back(triangle_of({places[1], places[2], places[0]}, {1, 1, 1}, 0));
    out.triangles.push_back(triangle_of({places[2], places[3], places[0]}, {1, 1, 1}, 0));
    out.triangles[0].front = first, out.triangles[1].front = second;
    for (WindowTriangle<double>& t : out.triangles) {
      for (WindowVertex<double>& v : t.v) v.color = Vec4<double>(1);
    }
    return out;
  };
  const auto by = [&](FacingArea area, bool first, bool second) {
    return passes(compare_window(dented.scene, drawn(first, second), drawn(true, false), {4, {}, 0, area}));
  };
  EXPECT_TRUE(by(FacingArea::either, true, false));
  EXPECT_TRUE(by(FacingArea::either, true, true));
  EXPECT_FALSE(by(FacingArea::either, false, false));
  EXPECT_TRUE(by(FacingArea::snapped, true, false));
  EXPECT_FALSE(by(FacingArea::snapped, true, true));
}

TEST_F(Outline, ItsOwnRecordsExcuseNothing) {
  // Edges that begin where they end have no area by themselves.
  const OutlineScene o(20 * 256);
  Records<double> broken = o.front();
  for (auto& edge : broken.triangles) edge.v[0] = edge.v[1];
  EXPECT_TRUE(fails(o.compare(broken, o.front()), 3));
  EXPECT_TRUE(o.turned(broken, o.front()).empty());
  EXPECT_TRUE(o.turned(broken, o.records).empty());
}

TEST_F(Outline, FacesByAnAreaBeforeSnappingAreLegalToAReference) {
  using Numbers = std::vector<std::uint32_t>;
  for (const auto& [steps, open] : {std::pair(0.25, true), std::pair(0.501, true), std::pair(1.0, false)}) {
    const OutlineScene o(steps);
    EXPECT_EQ(o.turned(o.back(), o.front()), open ? Numbers{0} : Numbers{}) << steps;
    EXPECT_EQ(o.turned(o.front(), o.back()), open ? Numbers{0} : Numbers{}) << steps;
    EXPECT_TRUE(o.turned(o.front(), o.front()).empty());
  }
  const Measurement m = compare_window_equal(back(), front(), 1, Numbers{0});
  EXPECT_TRUE(passes(m));
  EXPECT_EQ(m.ambiguous, 1u);
  EXPECT_EQ(m.items, 1u);
  EXPECT_FALSE(passes(compare_window_equal(back(), front(), 1)));
  EXPECT_TRUE(turned(as(true, PolygonMode::point), front()).empty()) << "no legal outline";
  scene.draws[0].back_mode = PolygonMode::fill;
  EXPECT_EQ(turned(records, front()), Numbers{0}) << "a filled triangle of no area covers nothing";
  scene.draws[0].front_mode = PolygonMode::fill;
  EXPECT_TRUE(turned(records, front()).empty()) << "no outline at all";
}

TEST_F(Outline, WhatTurnedOutlinesCoverIsTakenOutOfCoverage) {
  const auto exact = exact::make_exact();
  const auto capture_of = [&](const Records<double>& r) {
    Capture in;
    in.records = r;
    Capture out = exact->run_stage(scene, Stage::coverage, in);
    out.records.triangles = r.triangles;
    return out;
  };
  const Capture mine = capture_of(back()), theirs = capture_of(front());
  ASSERT_NE(mine.planes.count.values(), theirs.planes.count.values());
  const std::vector<std::uint32_t> numbers = {0};
  const WithoutTurned beside = without_turned(scene, mine, theirs, numbers, *exact);
  EXPECT_EQ(beside.candidate.planes.count.values(), beside.reference.planes.count.values());
  EXPECT_EQ(beside.candidate.planes.id_sum.values(), beside.reference.planes.id_sum.values());
  std::size_t open = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      EXPECT_EQ(beside.open(x, y) != 0, mine.planes.count(x, y) != 0 || theirs.planes.count(x, y) != 0);
      open += beside.open(x, y);
    }
  }
  EXPECT_GE(open, 20u);
  Capture more = mine;
  more.planes.count(3, 3) += 1;
  EXPECT_NE(without_turned(scene, more, theirs, numbers, *exact).candidate.planes.count(3, 3), 0u)
      << "what is no outline's stays";
}

}  // namespace
}  // namespace plumbline::check
