// Random lines and points, for the tests of them.
#pragma once

#include <random>

#include "tests/cross/osmesa_scenes.h"

namespace plumbline::test {

/// Points, one for each position, or lines, one for each pair (0 to 1, 2 to 3, ...). Normals are +z.
inline Mesh thin_mesh(Topology topology, std::vector<glm::vec3> positions, std::vector<glm::vec4> colors = {}) {
  Mesh mesh;
  mesh.normals.assign(positions.size(), glm::vec3(0, 0, 1));
  const auto count = static_cast<std::uint32_t>(positions.size());
  if (topology == Topology::points) {
    for (std::uint32_t i = 0; i < count; ++i) mesh.triangles.emplace_back(i);
  } else {
    for (std::uint32_t i = 0; i + 1 < count; i += 2) mesh.triangles.emplace_back(i, i + 1, i + 1);
  }
  mesh.positions = std::move(positions);
  mesh.colors = std::move(colors);
  mesh.topology = topology;
  return mesh;
}

class RandomThings {
 public:
  explicit RandomThings(unsigned seed) : engine_(seed) {}
  float number(double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(engine_()) / 4294967296.0);
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  glm::vec4 color() { return {number(0, 1), number(0, 1), number(0, 1), number(0, 1)}; }

 private:
  std::mt19937 engine_;
};

/// `count` random lines, or 2 * count points, around the eye, in perspective: many are clipped, or behind the eye.
inline Scene thin_cloud(Topology topology, int count, unsigned seed) {
  RandomThings random(seed);
  Scene scene;
  scene.name = "test/cloud";
  scene.frame = {90, 70, ColorFormat::rgba8, seed % 2 == 0 ? DepthFormat::z24 : DepthFormat::z16};
  scene.camera = {{0.1, 0.2, 0.3}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Perspective{60, 0.5, 12};
  std::vector<glm::vec3> positions;
  std::vector<glm::vec4> colors;
  for (int i = 0; i < 2 * count; ++i) {
    positions.emplace_back(random.number(-5, 5), random.number(-4, 4), random.number(-14, 2));
    colors.push_back(random.color());
  }
  add(scene, thin_mesh(topology, positions, colors)).shading = seed % 3 == 0 ? Shading::flat : Shading::gouraud;
  return scene;
}

}  // namespace plumbline::test
