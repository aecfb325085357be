// Scenes for the tests of the oracle: soups, closed meshes, triangles across the eye's plane, duplicates, slivers.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double in(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(engine_()) / 4294967296.0); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  glm::vec3 place(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }

 private:
  std::mt19937 engine_;
};

inline void add_vertex(Mesh& mesh, glm::vec3 p, glm::vec3 normal, glm::vec4 color) {
  mesh.positions.push_back(p);
  mesh.normals.push_back(normal);
  mesh.colors.push_back(color);
}

inline Mesh soup(Random& random, int triangles, double size, double extent) {
  Mesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const glm::vec3 centre = random.place(extent);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const glm::vec4 color(random.in(0, 1), random.in(0, 1), random.in(0, 1), 1);
      add_vertex(mesh, centre + random.place(size), {0, 0, 1}, color);
    }
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A closed unit sphere of rings and segments, counter-clockwise outside; every triangle has its own vertices, so that
/// only their positions tell who shares an edge.
inline Mesh sphere(int rings, int segments) {
  constexpr double kPi = 3.14159265358979323846;
  const auto at = [&](int ring, int segment) {
    if (ring == 0) return glm::vec3(0, 1, 0);
    if (ring == rings) return glm::vec3(0, -1, 0);
    const double polar = kPi * ring / rings, around = 2 * kPi * (segment % segments) / segments;
    return glm::vec3(std::sin(polar) * std::cos(around), std::cos(polar), -std::sin(polar) * std::sin(around));
  };
  Mesh mesh;
  const auto add = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    if (a == b || b == c || c == a) return;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : {a, b, c}) add_vertex(mesh, p, glm::normalize(p), {0.5f + 0.5f * p, 1});
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      add(at(r, s), at(r + 1, s), at(r + 1, s + 1));
      add(at(r, s), at(r + 1, s + 1), at(r, s + 1));
    }
  }
  return mesh;
}

inline Draw unlit(std::uint32_t mesh, Cull cull = Cull::none, DepthFunc func = DepthFunc::less) {
  Draw draw;
  draw.mesh = mesh;
  draw.lit = false;
  draw.cull = cull;
  draw.depth_func = func;
  return draw;
}

inline Scene frame_of(int width, int height) {
  Scene scene;
  scene.name = "made for a test";
  scene.frame.width = width;
  scene.frame.height = height;
  return scene;
}

inline Scene sphere_scene(int width, int height, int rings, int segments, Cull cull) {
  Scene scene = frame_of(width, height);
  scene.meshes.push_back(sphere(rings, segments));
  scene.draws.push_back(unlit(0, cull));
  scene.draws[0].transforms = {Rotate{17, {0.3, 1, 0.2}}};
  scene.camera.eye = {0.1, 0.4, 3.1};
  return scene;
}

inline constexpr int kSceneKinds = 8;

/// Small scene, 24 to 113 pixels wide and high, a function of kind [0, kSceneKinds) and seed.
inline Scene small_scene(int kind, unsigned seed) {
  Random random(seed * 977u + static_cast<unsigned>(kind));
  Scene scene = frame_of(24 + random.below(90), 24 + random.below(90));
  scene.frame.depth = std::array{DepthFormat::z8, DepthFormat::z16, DepthFormat::z24,
                                 DepthFormat::z32f}[static_cast<std::size_t>(random.below(4))];
  scene.frame.color = ColorFormat::rgba32f;
  scene.camera.eye = {random.in(-1, 1), random.in(-1, 1), random.in(3, 6)};
  scene.name = "kind " + std::to_string(kind) + ", seed " + std::to_string(seed);
  const auto any_cull = [&] {
    return std::array{Cull::none, Cull::back, Cull::front}[static_cast<std::size_t>(random.below(3))];
  };
  switch (kind) {
    case 0:  // a soup of all sizes
      scene.meshes = {soup(random, 30, 1, 1.5), soup(random, 60, 0.1, 1.5)};
      scene.draws = {unlit(0, any_cull()), unlit(1, any_cull())};
      break;
    case 1:  // a closed mesh, its own vertices for each triangle
      scene.meshes = {sphere(4 + random.below(20), 5 + random.below(30))};
      scene.draws = {unlit(0, any_cull())};
      scene.draws[0].transforms = {Rotate{random.in(0, 360), {random.in(-1, 1), 1, random.in(-1, 1)}},
                                   Scale{{random.in(0.3, 2), random.in(0.3, 2), random.in(0.3, 2)}}};
      break;
    case 2:  // across the eye's plane and the near plane
      scene.meshes = {soup(random, 12, 8, 4)};
      scene.draws = {unlit(0, any_cull())};
      scene.projection = Perspective{random.in(20, 120), random.in(0.05, 2), 30};
      break;
    case 3:  // parallel rays, cut at all planes
      scene.meshes = {soup(random, 30, 2, 2), sphere(6, 9)};
      scene.draws = {unlit(0, any_cull()), unlit(1, any_cull())};
      scene.projection = Orthographic{-1.5, 1.3, -1.2, 1.6, 2, 7};
      break;
    case 4: {  // the same mesh twice, and other depth functions
      scene.meshes = {sphere(5, 7), soup(random, 20, 1, 1)};
      for (int i = 0; i < 4; ++i) {
        scene.draws.push_back(
            unlit(static_cast<std::uint32_t>(random.below(2)), Cull::none, static_cast<DepthFunc>(random.below(8))));
      }
      scene.frame.clear_depth = random.in(0, 1);
      break;
    }
    case 5: {  // slivers and triangles smaller than a pixel
      scene.meshes = {soup(random, 200, 0.04, 1.2), soup(random, 300, 1, 1)};
      Mesh& slivers = scene.meshes[1];
      for (std::size_t i = 0; i < slivers.positions.size(); i += 3) {
        slivers.positions[i + 2] =
            slivers.positions[i] +
            static_cast<float>(random.in(0.1, 0.9)) * (slivers.positions[i + 1] - slivers.positions[i]) +
            random.place(std::pow(10.0, random.in(-6, -1.5)));
      }
      scene.draws = {unlit(0, any_cull()), unlit(1, any_cull())};
      break;
    }
    case 6:  // far from the origin
      scene.meshes = {sphere(6, 8), soup(random, 20, 0.5, 1)};
      scene.draws = {unlit(0), unlit(1)};
      for (Mesh& mesh : scene.meshes) {
        for (glm::vec3& p : mesh.positions) p += glm::vec3(1000, -500, 200);
      }
      scene.camera.eye = {1000.5, -500.2, 204};
      scene.camera.center = {1000, -500, 200};
      break;
    default:  // touching, grazing and edge-on: coordinates on a coarse grid, seen squarely
      scene.meshes = {soup(random, 60, 1, 1)};
      for (glm::vec3& p : scene.meshes[0].positions) p = glm::round(p * 4.0f) / 4.0f;
      scene.draws = {unlit(0, any_cull())};
      scene.camera.eye = {0, 0, 4};
      scene.projection = Orthographic{-2, 2, -2, 2, 1, 8};
      break;
  }
  if (random.below(3) == 0) scene.draws[0].shading = Shading::flat;
  return scene;
}

}  // namespace plumbline::test
