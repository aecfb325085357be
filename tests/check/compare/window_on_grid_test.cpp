// The comparator of stage 4 on declared grids, and of triangles without area.
#include <algorithm>

#include "tests/check/compare/window.h"

namespace plumbline::check {
namespace {

Records<double> on_grid(Records<double> r, const Conventions& grid, bool has_last) {
  r.triangles.back().front = true;
  if (!has_last) r.triangles.pop_back();
  for (WindowTriangle<double>& t : r.triangles) {
    for (WindowVertex<double>& v : t.v) snap(v, grid);
  }
  return r;
}

// A triangle between two places of the grid of 1/256 pixel has an area on a finer one, and without any. One without
// area may be there.
TEST_F(Window, TrianglesHaveAnAreaOnTheDeclaredGrid) {
  const double low = 50 + 0.3 / 256, high = 50 + 0.45 / 256;
  records.triangles.back() = triangle_of({{{1, low, 0.25}, {90, low, 0.5}, {45, high, 0.75}}}, {1, 1, 1}, 3);
  const auto& t = records.triangles.back();
  records.polygons.polygons.pop_back();
  records.polygons.vertices.resize(records.polygons.vertices.size() - 3);
  add_polygon(records, 3, {t.v[2], t.v[0], t.v[1]});
  Conventions grid;
  for (const auto& [bits, has_area] : {std::pair(4, false), {8, false}, {10, true}, {Conventions::kFloat, true}}) {
    grid.subpixel_bits = bits;
    for (const bool is_there : {false, true}) {
      auto mine = on_grid(records, grid, is_there);
      const auto exact = on_grid(records, grid, has_area);
      if (is_there && !has_area) mine.triangles.back().v[0].color.r = 0.125f;  // of nothing that is drawn
      EXPECT_EQ(passes(compare_window(scene, mine, exact, {kFactor, grid})), is_there || !has_area) << bits << " bits";
    }
    // A reference on the grid of 1/256 pixel has none.
    const bool passes_beside_256 =
        passes(compare_window(scene, on_grid(records, grid, true), on_grid(records, grid, false), {kFactor, grid}));
    EXPECT_EQ(passes_beside_256, bits == Conventions::kFloat || !has_area) << bits << " bits";
  }
}

// Rounded down at once, the triangle has no area. Rounded to 2^-11 pixel before, it may have one where its highest
// corner lies just below a place of the grid: then its colours count.
TEST_F(Window, AStrangersTriangleMayHaveAnAreaByRoundingTwice) {
  Conventions grid;
  grid.subpixel_bits = 4;
  grid.subpixel_rounding = Conventions::Rounding::down;
  for (const auto& [steps, may_have_area] : {std::pair(15.97, true), {15.9, false}}) {
    const double low = 50.5 + 0.25 / 256, high = 50.5 + steps / 256;
    records.triangles.back() = triangle_of({{{1, low, 0.25}, {90, low, 0.5}, {45, high, 0.75}}}, {1, 1, 1}, 3);
    const auto& t = records.triangles.back();
    records.polygons.polygons.pop_back();
    records.polygons.vertices.resize(records.polygons.vertices.size() - 3);
    add_polygon(records, 3, {t.v[2], t.v[0], t.v[1]});
    const Records<double> exact = on_grid(records, grid, false);
    Records<double> mine = on_grid(records, grid, true);
    for (WindowVertex<double>& v : mine.triangles.back().v) v.snapped.y += v.p_win.y == high && may_have_area ? 16 : 0;
    const auto passes_now = [&] {
      return passes(compare_window(scene, mine, exact, {kFactor, grid, 0, FacingArea::either}));
    };
    EXPECT_TRUE(passes_now()) << steps;
    mine.triangles.back().v[0].color.r += 0.125;
    EXPECT_EQ(passes_now(), !may_have_area) << steps;
  }
}

// Rounded twice, the triangle has an area or none. Without an area it faces neither way: front or back are legal.
TEST_F(Window, AStrangersTriangleThatMayHaveNoAreaFacesEitherWay) {
  Conventions grid;
  grid.subpixel_bits = 4;
  grid.subpixel_rounding = Conventions::Rounding::down;
  const double low = 50.5 + 0.25 / 256, high = 50.5 + 15.97 / 256;
  records.triangles.back() = triangle_of({{{1.3, low, 0.25}, {90.3, low, 0.5}, {45.3, high, 0.75}}}, {1, 1, 1}, 3);
  const auto& t = records.triangles.back();
  records.polygons.polygons.pop_back();
  records.polygons.vertices.resize(records.polygons.vertices.size() - 3);
  add_polygon(records, 3, {t.v[2], t.v[0], t.v[1]});
  Records<double> mine = on_grid(records, grid, true);
  for (const bool front : {false, true}) {
    mine.triangles.back().front = front;
    const auto m = compare_window(scene, mine, on_grid(records, grid, false), {kFactor, grid, 0, FacingArea::either});
    EXPECT_TRUE(passes(m)) << front;
  }
}

// The last triangle is there or not by rounding on a grid of 1/256 pixel, and has no area on the others.
TEST_F(Window, ATriangleThatMayHaveNoAreaMayBeThereOrNot) {
  Conventions grid;
  for (const int bits : {4, 8, 12}) {
    grid.subpixel_bits = bits;
    const auto with = on_grid(records, grid, true), without = on_grid(records, grid, false);
    EXPECT_TRUE(passes(compare_window(scene, with, without, {kFactor, grid}))) << bits << " bits";
    EXPECT_TRUE(passes(compare_window(scene, without, with, {kFactor, grid}))) << bits << " bits";
  }
}

// Half way between whole pixels, counted from the frame's side, a corner may be snapped to either.
TEST_F(Window, ACornerIsBetweenPlacesOfTheRenderersOwnGrid) {
  Conventions grid;
  grid.subpixel_bits = 0;
  const auto is_between = [&](double x) {
    WindowTriangle<double> t = records.triangles[0];
    for (WindowVertex<double>& v : t.v) v.p_win.x = x, v.p_win.y = 2.5 - grid.sample.y;
    return has_corner_between_places(t, grid, SnappedBy::conventions);
  };
  EXPECT_TRUE(is_between(3.5));
  EXPECT_FALSE(is_between(3));
  grid.sample = {0, 0.5};
  EXPECT_TRUE(is_between(4)) << "3.5 before it was moved by 1/2";
  EXPECT_FALSE(is_between(3.5));
}

// Half way between two places of a coarse grid there is a second nearest place; elsewhere, and off the grid, none.
TEST_F(Window, AStrangersSecondNearestPlaceIsOnItsGrid) {
  Conventions grid;
  grid.subpixel_bits = 4;  // places 16/256 pixel apart
  const auto passes_at = [&](double place, int snapped) {
    Records<double> a = on_grid(records, grid, true);
    a.triangles[0].v[0].p_win.x = 10.5 + place / 256;
    a.triangles[0].v[0].snapped.x = 10 * 256 + snapped;
    return passes(compare_window(scene, a, a, {kFactor, grid, 0, FacingArea::either}));
  };
  EXPECT_TRUE(passes_at(3, 0));
  EXPECT_FALSE(passes_at(3, 6)) << "as near, and off the grid";
  EXPECT_FALSE(passes_at(3, 16));
  EXPECT_FALSE(passes_at(7, 16));
  EXPECT_TRUE(passes_at(8, 0));
  EXPECT_TRUE(passes_at(8, 16));
}

// Fixed point of 11 bits, before the rounding down or up, may carry a position to a place of the grid or across it.
TEST_F(Window, AStrangersPlaceMayBeRoundedOnTheWayToItsGrid) {
  Conventions grid;
  grid.subpixel_bits = 4;  // places 16/256 pixel apart; 2^-12 pixel is 1/16 of 1/256
  const auto passes_at = [&](double place, int snapped, FacingArea area = FacingArea::either) {
    Records<double> a = on_grid(records, grid, true);
    a.triangles[0].v[0].p_win.x = 10.5 + place / 256;
    a.triangles[0].v[0].snapped.x = 10 * 256 + snapped;
    return passes(compare_window(scene, a, a, {kFactor, grid, 0, area}));
  };
  grid.subpixel_rounding = Conventions::Rounding::down;
  EXPECT_TRUE(passes_at(15.95, 0));
  EXPECT_TRUE(passes_at(15.95, 16)) << "1/20 below";
  EXPECT_FALSE(passes_at(15.9, 16)) << "1/10 below";
  EXPECT_FALSE(passes_at(15.95, 32));
  EXPECT_FALSE(passes_at(15.95, 8)) << "off the grid";
  EXPECT_FALSE(passes_at(15.95, 16, FacingArea::snapped)) << "ours rounds once";
  EXPECT_TRUE(passes_at(16.05, 0));
  EXPECT_FALSE(passes_at(16.1, 0));
  grid.subpixel_rounding = Conventions::Rounding::up;
  EXPECT_TRUE(passes_at(16.05, 16));
  EXPECT_TRUE(passes_at(16.05, 32));
  EXPECT_FALSE(passes_at(16.1, 16));
}

// Corners in one place: the colours tell where the triangle begins.
TEST_F(Window, ATriangleOfNoAreaMayBeginAtAnyCorner) {
  auto& p = records.polygons;
  p.polygons.pop_back();
  p.vertices.resize(p.vertices.size() - 3);
  WindowTriangle<double>& t = records.triangles.back();
  t = triangle_of({{{1, 50, 0.25}, {1, 50, 0.25}, {45, 50, 0.75}}}, {1, 1, 1}, 3);
  t.v[0].color = Vec4<double>(1, 0, 0, 1), t.v[1].color = Vec4<double>(0, 1, 0, 1);
  add_polygon(records, 3, {t.v[0], t.v[1], t.v[2]});
  Records<double> reference = records;
  reference.triangles.pop_back();
  Conventions none;
  none.subpixel_bits = Conventions::kFloat;
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_TRUE(passes(compare_window(scene, records, reference, {kFactor, none}))) << turn;
    Records<double> wrong = records;
    wrong.triangles.back().v[0].color.b = 0.5;
    EXPECT_EQ(passes(compare_window(scene, wrong, reference, {kFactor, none})), false) << turn;
    std::rotate(t.v.begin(), t.v.begin() + 1, t.v.end());
  }
}

// A clipper may leave triangles: each of primitive 2's, the last of which snapping may empty, is a polygon.
TEST_F(Window, PolygonsOfOnePrimitiveAreJudgedTogether) {
  const Change split = [](Records<double>& r) {
    const ClipPolygon whole = r.polygons.polygons[1];
    std::vector<ClipPolygon> made;
    for (std::uint32_t i = 2; i < whole.count; ++i) {
      made.push_back({whole.primitive, static_cast<std::uint32_t>(r.polygons.vertices.size()), 3});
      for (const std::uint32_t k : {0u, i - 1, i})
        r.polygons.vertices.push_back(ClipVertex<double>(r.polygons.vertices[whole.first + k]));
    }
    r.polygons.polygons.erase(r.polygons.polygons.begin() + 1);
    r.polygons.polygons.insert(r.polygons.polygons.begin() + 1, made.begin(), made.end());
  };
  const auto with = [&](const Change& change) { return compare([&](auto& r) { split(r), change(r); }); };
  EXPECT_TRUE(passes(with(kUnchanged)));
  EXPECT_TRUE(passes(with([&](auto& r) { r.triangles.insert(r.triangles.begin() + 3, thin); })));
  EXPECT_FALSE(passes(with(erase(1))));
  EXPECT_FALSE(passes(with(erase(2))));
  EXPECT_FALSE(passes(with([&](auto& r) { r.triangles.insert(r.triangles.begin() + 1, thin); }))) << "in another order";
}

}  // namespace
}  // namespace plumbline::check
