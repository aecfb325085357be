// Frames bit for bit, and a scene, for the painter's tests.
#pragma once

#include <cstring>

#include "pipeline/frame.h"
#include "scene/mesh/mesh_shapes.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

template <class T>
bool same_bits(const Plane<T>& a, const Plane<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(T)) == 0);
}

inline bool same_bits(const Frame& a, const Frame& b) {
  return same_bits(a.color_rgba8, b.color_rgba8) && same_bits(a.color_rgba16, b.color_rgba16) &&
         same_bits(a.color_rgba32f, b.color_rgba32f) && same_bits(a.depth_code, b.depth_code) &&
         same_bits(a.depth_z32f, b.depth_z32f) && same_bits(a.stencil, b.stencil);
}

/// Four of them, lit, one behind the other.
inline Scene spheres(int slices, Cull cull) {
  Scene scene;
  scene.frame.width = 200;
  scene.frame.height = 136;
  scene.camera.eye = {0, 0, 3};
  scene.meshes.push_back(make_uv_sphere(slices, slices / 2));
  scene.lights.emplace_back();
  for (int i = 0; i < 4; ++i) {
    Draw draw;
    draw.cull = cull;
    draw.transforms = {Translate{{0.3 * i - 0.4, 0, -0.4 * i}}, Rotate{20.0 * i, {1, 0.3, 0}}};
    scene.draws.push_back(draw);
  }
  return scene;
}

}  // namespace plumbline::pipeline
