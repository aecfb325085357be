// Small records, planes and scenes whose comparisons are known beforehand.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture/capture.h"
#include "check/bounds/bounds.h"
#include "check/verdict/ledger.h"
#include "check/verdict/measure.h"
#include "reference/exact/exact.h"
#include "scene/mesh/mesh_shapes.h"
#include "scene/scene.h"

namespace plumbline::check {

inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kU = kFloatRounding;

inline double above(double value) { return std::nextafter(value, kInf); }
/// The next float, as a double.
inline double float_above(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

/// NaN and infinity, of both signs.
inline const std::vector<double>& not_numbers() {
  static const std::vector<double> kValues = {kNaN, -kNaN, kInf, -kInf};
  return kValues;
}

inline testing::AssertionResult passes(const Measurement& m) {
  if (m.differing == 0 && m.max_ratio <= 1) return testing::AssertionSuccess();
  return testing::AssertionFailure() << m.differing << " of " << m.items << " differ, worst "
                                     << to_string(m.worst.place) << ": " << m.worst.candidate << " against "
                                     << m.worst.reference << ", " << m.worst.difference << " " << m.unit
                                     << ", tolerance " << m.worst.tolerance << (m.mismatch.empty() ? "" : ": ")
                                     << m.mismatch;
}
/// True: exactly `items` differ, and ratio (> 1) and differences (> 0) agree.
inline testing::AssertionResult fails(const Measurement& m, std::uint64_t items = 1) {
  if (m.differing != items) {
    return testing::AssertionFailure() << m.differing << " of " << m.items << " differ, " << items
                                       << " should; largest difference " << m.max_difference << " " << m.unit;
  }
  if (!(m.max_ratio > 1) || !(m.max_difference > 0) || !(m.worst.difference > 0)) {
    return testing::AssertionFailure() << "differs, yet ratio " << m.max_ratio << ", difference " << m.max_difference
                                       << ", worst " << m.worst.difference;
  }
  return testing::AssertionSuccess();
}
inline std::uint64_t histogram_sum(const Measurement& m) {
  return std::accumulate(m.histogram.begin(), m.histogram.end(), std::uint64_t{0});
}

/// Two draws into a frame that is not square: two lit triangles, the second of them cut by the near plane; and an unlit
/// square of flat shading, turned and far larger, which the view volume cuts at its sides.
inline Scene two_draws(int width = 24, int height = 16) {
  Scene scene;
  scene.name = "test/two_draws";
  scene.frame.width = width;
  scene.frame.height = height;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  scene.projection = Perspective{45, 1, 100};
  scene.light_model.ambient = glm::vec3(0.1f);
  Light light;
  light.vector = {0.3, 0.2, 1};
  light.specular = glm::vec3(0);
  scene.lights.push_back(light);
  scene.meshes.push_back(make_triangles(
      {{-1, -1, 0}, {1, -0.5f, 0.25f}, {-0.25f, 1, 0.5f}, {0.5f, -1, 0}, {1.5f, 1, -1}, {0.25f, 0.5f, 6}},
      {{0, 1, 2}, {3, 4, 5}}, {}));
  scene.meshes.push_back(make_grid(1, 1));
  for (glm::vec3& p : scene.meshes[1].positions)
    scene.meshes[1].colors.emplace_back(p.x / 4 + 0.5f, p.y / 4 + 0.5f, 0.25f, 1);
  Draw lit;
  scene.draws.push_back(lit);
  Draw flat;
  flat.mesh = 1;
  flat.lit = false;
  flat.shading = Shading::flat;
  flat.transforms = {Translate{{0, 0, -20}}, Rotate{30, {1, 1, 1}}, Scale{{40, 40, 40}}};
  scene.draws.push_back(flat);
  return scene;
}

// Change that a test makes to records before they are compared.
using Change = std::function<void(Records<double>&)>;
inline constexpr auto kUnchanged = [](Records<double>&) {};

/// Exact's capture of the scene, with the records of all stages.
inline Capture exact_capture(const Scene& scene) {
  return exact::make_exact()->capture(scene, {.records = StageSet::all()});
}

/// A window triangle of corners p_win (x, y [pixels], z [0, 1]) in red, green and blue, snapped to 1/256 pixel and
/// faced by its snapped area.
inline WindowTriangle<double> triangle_of(const std::array<glm::dvec3, 3>& p_win, const glm::dvec3& inv_w = {1, 1, 1},
                                          std::uint32_t primitive = 0) {
  WindowTriangle<double> t{};
  for (std::size_t i = 0; i < 3; ++i) {
    t.v[i].p_win = p_win[i];
    t.v[i].inv_w = inv_w[static_cast<int>(i)];
    t.v[i].snapped = glm::ivec2(glm::round((glm::dvec2(p_win[i]) - 0.5) * 256.0));
    t.v[i].color = glm::dvec4(i == 0, i == 1, i == 2, 1);
  }
  t.primitive = primitive;
  const glm::dvec2 a(t.v[0].snapped), b(t.v[1].snapped), c(t.v[2].snapped);
  t.front = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  return t;
}

}  // namespace plumbline::check
