// The error bound of a shaded colour, against the equations at the ends of what is unknown.
#include <gtest/gtest.h>

#include "check/bounds/shade_bounds.h"

namespace plumbline::check {
namespace {

// One draw, lit at its fragments, of a texture of one texel, in linear fog over 0.002 units.
Scene fogged(float texel) {
  Scene scene;
  scene.lights.clear();
  scene.meshes.resize(1);
  Texture texture;
  texture.levels = {{1, 1, {glm::vec4(texel, texel, texel, 1)}}};
  scene.textures = {texture};
  Draw draw;
  draw.shading = Shading::phong;
  draw.texture = DrawTexture{};
  draw.fog = Fog{Fog::Mode::linear, glm::vec3(0.25f), 1, 4.999f, 5.001f};
  scene.draws = {draw};
  return scene;
}

double error_in(const Scene& scene, float texel) {
  ShadeInputs of, errors;
  of[Varying::position] = {0, 0, -5, 1};
  of[Varying::normal] = {0, 0, 1, 0};
  of.texel = {texel, texel, texel, 1};
  errors[Varying::position] = {0, 0, 1e-6, 0};
  return shade_error(scene, scene.draws[0], of, errors, {1}).x;
}

// Fog's factor is off by 1e-6 / 0.002, of a colour that light leaves anywhere between 0 and the texel.
TEST(ShadeError, InFogGrowsWithTheTexel) {
  constexpr double kFactor = 1e-6 / 0.002;
  for (const float texel : {1.0f, 4.0f, 60000.0f}) {
    const double error = error_in(fogged(texel), texel), farthest = std::abs(texel - 0.25);
    EXPECT_GE(error, kFactor * farthest) << texel;
    EXPECT_LE(error, 2 * kFactor * farthest) << texel;
  }
  EXPECT_GE(error_in(fogged(0.125f), 0.125f), kFactor * 0.25) << "black is the farthest";
}

}  // namespace
}  // namespace plumbline::check
