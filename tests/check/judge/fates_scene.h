// A scene in whose lower left pixels each fate of a fragment happens, with numbers that are known beforehand.
#pragma once

#include "scene/mesh/mesh_shapes.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Window depth 3/4, as a code of 24 bits: 0.75 * 16777215 = 12582911.25.
inline constexpr int kFar = 12582911;
/// 15/16: 15728639.06; 1/4: 4194303.75.
inline constexpr int kFarther = 15728639, kNear = 4194304;

/// A triangle over the lower left half of 8 x 8 pixels for each draw, in its own colour, at window depth z: the eye at
/// 5, near plane 1 and far plane 5 before it, so that z is (4 - z_world) / 4, exactly.
///   0 depth 3/4, drawn           1 alpha 1/4 > 1/2         2 stencil 1 == 0; increments
///   3 depth 15/16; replaces the stencil value by 7          4 its box begins at 4,4
///   5 faces the front, which is culled                      6 depth 1/4, drawn last
inline Scene fates_scene() {
  Scene scene;
  scene.name = "test/fates";
  scene.frame.width = scene.frame.height = 8;
  scene.frame.stencil = StencilFormat::s8;
  scene.projection = Orthographic{-1, 1, -1, 1, 1, 5};
  const auto add = [&](double depth, glm::vec4 color) -> Draw& {
    const auto z = static_cast<float>(4 - 4 * depth);
    scene.meshes.push_back(make_triangles({{-1, -1, z}, {1, -1, z}, {-1, 1, z}}, {{0, 1, 2}}, {}));
    Draw& draw = scene.draws.emplace_back();
    draw.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    draw.lit = false;
    draw.material.diffuse = color;
    return draw;
  };
  scene.draws.reserve(7);
  add(0.75, {0, 1, 0, 1});
  add(0.5, {1, 0, 0, 0.25f}).alpha_test = AlphaTest{CompareFunc::greater, 0.5f};
  StencilFace face{CompareFunc::equal, 1, 0xff, StencilOp::increment};
  add(0.5, {1, 1, 0, 1}).stencil = Stencil{face, face};
  face = {CompareFunc::always, 7, 0xff, StencilOp::keep, StencilOp::replace};
  add(0.9375, {1, 0, 1, 1}).stencil = Stencil{face, face};
  add(0.5, {0, 1, 1, 1}).scissor = Scissor{4, 4, 4, 4};
  add(0.5, {1, 1, 1, 1}).cull = Cull::front;
  add(0.25, {0, 0, 1, 1});
  return scene;
}

}  // namespace plumbline::check
