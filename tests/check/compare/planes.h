// Planes of two renderers that agree, for tests to change.
#pragma once

#include <functional>

#include "check/compare/compare_planes.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {

using PlaneChange = std::function<void(Planes&)>;
inline constexpr auto kUnchangedPlanes = [](Planes&) {};

// Capture of a 7 x 4 frame: primitive 3 at pixel (3, 1), primitive 5 at (2, 2), else the background. No pixel has legal
// answers until allow().
struct PlanePairs : testing::Test {
  PlanePairs() {
    scene.frame.width = kWidth;
    scene.frame.height = kHeight;
    scene.meshes.resize(1);  // eight triangles, each of three vertices of its own
    scene.draws.resize(1);
    for (unsigned i = 0; i < 8; ++i) scene.meshes[0].triangles.push_back(glm::uvec3(0, 1, 2) + 3u * i);
    scene.meshes[0].positions.resize(24);
    capture.records.lit.resize(24, {Vec4<double>(0.5)});
    capture.planes = planes_of(kWidth, kHeight);
    capture.records.triangles = {triangle_of({{{1, 0.5, 0.25}, {6.5, 1, 0.5}, {2, 3.75, 0.75}}}, {1, 0.5, 0.25}, 3),
                                 triangle_of({{{1, 0.5, 0.25}, {6.5, 1, 0.5}, {2, 3.75, 0.75}}}, {1, 1, 1}, 5)};
    Planes& p = capture.planes;
    p.id(3, 1) = 3;
    p.id(2, 2) = 5;
    p.depth(3, 1) = p.depth(2, 2) = 0.5;
    p.shaded(3, 1) = p.shaded(2, 2) = p.color(3, 1) = p.color(2, 2) = glm::vec4(code(100), code(50), code(0), 1);
  }
  static float code(int c) { return static_cast<float>(c) / 255.0f; }
  static Planes planes_of(int width, int height) {
    Planes p;
    p.count = Plane<std::uint32_t>(width, height, 1);
    p.id_sum = Plane<std::uint64_t>(width, height, 7);
    p.id = Plane<std::int32_t>(width, height, kBackground);
    p.shaded = p.color = Plane<glm::vec4>(width, height, glm::vec4(0, 0, 0, 1));
    p.depth = Plane<double>(width, height, 1);
    return p;
  }
  using Compare = std::function<Measurement(const Capture&, const Capture&)>;
  // Compares two copies of the capture, each with its change.
  Measurement run(const Compare& compare, const PlaneChange& candidate,
                  const PlaneChange& reference = kUnchangedPlanes) const {
    Capture a = capture, b = capture;
    candidate(a.planes);
    reference(b.planes);
    return compare(a, b);
  }
  Compare coverage() const {
    return [](const auto& a, const auto& b) { return compare_coverage(a.planes, b.planes); };
  }
  Compare winners() const {
    return [this](const auto& a, const auto& b) { return compare_winners(a.planes, b.planes, legal); };
  }
  Compare depth() const {
    return [this](const auto& a, const auto& b) { return compare_depth_planes(scene, a, b, 64); };
  }
  Compare shaded() const {
    return [this](const auto& a, const auto& b) { return compare_shaded_planes(scene, a, b, 64); };
  }
  Compare codes() const {
    return [this](const auto& a, const auto& b) { return compare_codes(scene, a, b, 1, 64); };
  }
  Compare merge() const {
    return [this](const auto& a, const auto& b) { return compare_merge(scene, a.planes, b.planes, 1); };
  }
  std::vector<Compare> all() const { return {coverage(), winners(), depth(), shaded(), codes(), merge()}; }

  // Makes `answers` the legal ones at (x, y), and the background the only one at every other pixel.
  void allow(int x, int y, const std::vector<std::int32_t>& answers) {
    legal.certain = legal.possible = Plane<std::uint32_t>(kWidth, kHeight);
    legal.first = {0};
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const bool here = column == x && row == y;
        for (std::int32_t id : here ? answers : std::vector{kBackground}) legal.answers.push_back({id, 0, 0, 1, {}});
        legal.first.push_back(static_cast<std::uint32_t>(legal.answers.size()));
      }
    }
  }
  static constexpr int kWidth = 7, kHeight = 4;
  Scene scene;
  Capture capture;
  Legal legal;
};

}  // namespace plumbline::check
