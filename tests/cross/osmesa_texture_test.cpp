// Textures drawn by OSMesa, against exact's filter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "osmesa_scenes.h"
#include "reference/exact/texture.h"
#include "reference/osmesa/osmesa.h"
#include "scene/texture_images.h"

namespace plumbline {
namespace {

// A frame that the mesh's square fills; s and t go from 0 to `turns`.
Scene textured_square(const Sampler& sampler, TextureFormat format, TexelType type, int size, glm::vec2 turns) {
  Scene scene;
  scene.name = "test/texture";
  scene.frame = {64, 64, ColorFormat::rgba32f, DepthFormat::z24, glm::vec4(0), 1};
  scene.camera = {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}};
  scene.projection = Orthographic{-1, 1, -1, 1, 0, 2};
  Texture texture;
  texture.format = format;
  texture.type = type;
  texture.sampler = sampler;
  set_levels(texture, make_noise(size, size, 3));
  scene.textures.push_back(std::move(texture));
  Mesh mesh = make_grid(1, 1);
  for (glm::vec2& st : mesh.texcoords) st = (st - 0.3f) * turns;
  scene.meshes.push_back(mesh);
  Draw draw;
  draw.lit = false;
  draw.texture = DrawTexture{0, TextureEnvironment::replace, glm::vec4(0)};
  scene.draws.push_back(draw);
  return scene;
}

TEST(OsmesaTexture, Probe) {
  const auto osmesa = make_osmesa();
  for (int min = 0; min < 6; ++min) {
    for (const float turns : {0.5f, 0.77f, 1.0f, 1.5f, 2.0f, 3.3f, 4.0f, 6.1f}) {
      Sampler sampler;
      sampler.min = static_cast<MinFilter>(min);
      sampler.wrap_s = Wrap::mirrored_repeat;
      const Scene scene =
          textured_square(sampler, TextureFormat::rgba, TexelType::float32, 64, {turns, turns * 0.5f});
      const Capture c = osmesa->capture(scene, {});
      double worst = 0, sum = 0, worst_lod = 0;
      const double lod = std::log2(static_cast<double>(turns));
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          const double s = ((x + 0.5) / 64 - static_cast<double>(0.3f)) * turns, t = ((y + 0.5) / 64 - static_cast<double>(0.3f)) * turns * 0.5;
          const auto at = [&](double level) {
            const glm::dvec4 e = glm::abs(exact::filtered_texel(scene.textures[0], {s, t}, level) - glm::dvec4(c.planes.texel(x, y)));
            return std::max({e.r, e.g, e.b, e.a});
          };
          worst = std::max(worst, at(lod));
          sum += at(lod) > 1e-4;
          double best = 9, best_at = 0;
          for (double d = -0.2; d <= 0.2; d += 0.001) if (at(lod + d) < best) { best = at(lod + d); best_at = d; }
          if (std::abs(best_at) > std::abs(worst_lod)) worst_lod = best_at;
        }
      }
      fmt::print("min {} turns {} lod {:.4f}: worst {:.3g}, {} pixels beyond 1e-4, best lod shift {:.3f}\n", min, turns, lod, worst, sum, worst_lod);
    }
  }
}

}  // namespace
}  // namespace plumbline
