// Window triangles and the polygons that they are made of, for tests to change.
#pragma once

#include <functional>

#include "check/compare/compare_records.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {

// Snapped again from its own position, as stage 4 does.
inline void snap(WindowVertex<double>& v, const Conventions& grid = {}) {
  for (int c = 0; c < 2; ++c) v.snapped[c] = static_cast<int>(snapped(grid, c, (v.p_win[c] - 0.5) * kSubpixel));
}

// A 96 x 64 frame. Of primitive 0 a triangle; of 2, which was cut, two of a fan of three, whose third has no snapped
// area; of 3 a triangle that snapping may turn or empty: heights of 0.499 and 0.501 steps round to 0 or 1, and their
// error is 0.003 steps. All are what stage 4 makes of the polygons.
struct Window : testing::Test {
  Window() {
    scene.meshes.resize(1);
    scene.meshes[0].triangles.resize(5);
    scene.draws.resize(1);
    records.matrices.resize(1);
    records.matrices[0].win_scale = {48, 32, 0.5};
    records.matrices[0].win_translate = {48, 32, 0.5};
    const double low = 50 + 0.499 / 256, high = 50 + 0.501 / 256;
    records.triangles = {triangle_of({{{10, 10, 0.25}, {40, 12, 0.5}, {20, 30, 0.75}}}, {1, 0.5, 0.25}, 0),
                         triangle_of({{{50, 10, 0.25}, {80, 12, 0.5}, {60, 30, 0.75}}}, {1, 0.5, 0.25}, 2),
                         triangle_of({{{80, 12, 0.5}, {85, 40, 0.5}, {60, 30, 0.75}}}, {0.5, 0.5, 0.25}, 2),
                         triangle_of({{{1, low, 0.25}, {90, low, 0.5}, {45, high, 0.75}}}, {1, 1, 1}, 3)};
    thin = triangle_of({{{85, 40, 0.5}, {85, 40 + 0.501 / 256, 0.5}, {60, 30, 0.75}}}, {0.5, 0.5, 0.25}, 2);
    const auto& t = records.triangles;
    thin.v[0] = t[2].v[1];
    thin.v[2] = t[1].v[2];
    add_polygon(records, 0, {t[0].v[2], t[0].v[0], t[0].v[1]});
    add_polygon(records, 2, {t[1].v[2], t[1].v[0], t[1].v[1], t[2].v[1], thin.v[1]});
    add_polygon(records, 3, {t[3].v[2], t[3].v[0], t[3].v[1]});
  }
  static void add_polygon(Records<double>& records, std::uint32_t primitive,
                          const std::vector<WindowVertex<double>>& corners) {
    const Matrices<double>& m = records.matrices[0];
    records.polygons.polygons.push_back({primitive, static_cast<std::uint32_t>(records.polygons.vertices.size()),
                                         static_cast<std::uint32_t>(corners.size())});
    for (const WindowVertex<double>& v : corners) {
      const double w = 1 / v.inv_w;
      records.polygons.vertices.push_back(
          {glm::dvec4((v.p_win - m.win_translate) / m.win_scale * w, w), v.color, false});
    }
  }
  Measurement compare(const Change& candidate, const Change& reference = kUnchanged) const {
    Records<double> a = records, b = records;
    candidate(a);
    reference(b);
    return compare_window(scene, a, b, {kFactor});
  }
  Measurement equal(const Change& candidate, const Change& reference = kUnchanged) const {
    Records<double> a = records, b = records;
    candidate(a);
    reference(b);
    return compare_window_equal(a, b, 1);
  }
  static Change erase(std::size_t i) {
    return [i](auto& r) { r.triangles.erase(r.triangles.begin() + static_cast<std::ptrdiff_t>(i)); };
  }
  static constexpr double kFactor = 4;
  Scene scene;
  Records<double> records;
  WindowTriangle<double> thin;
};

}  // namespace plumbline::check
