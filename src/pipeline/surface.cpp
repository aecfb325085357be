#include "pipeline/surface.h"

#include "pipeline/matrices.h"

namespace plumbline::pipeline {

Surface surface_of(const Scene& scene, const Draw& draw, const Records<float>& records) {
  Surface surface;
  if (is_plain(scene, draw)) return surface;
  surface.scene = &scene;
  surface.draw = &draw;
  if (draw.texture) {
    const Texture& texture = scene.textures.at(draw.texture->texture);
    surface.texture = texture_setup(texture, texture.sampler);
  }
  if (is_lit_per_fragment(draw)) {
    surface.light = records.lights.empty() ? fragment_light(scene, draw, light_sources(scene))
                                           : fragment_light(scene, draw, records.lights);
  }
  for (const Varying v : kAllVaryings) {
    if (is_back(v) || !carries(scene, draw, v)) continue;
    surface.carried.push_back(v);
    surface.columns[static_cast<std::size_t>(v)] = records.varyings[v].triangles;
  }
  return surface;
}

std::vector<Surface> surfaces_of(const Scene& scene, const Records<float>& records) {
  std::vector<Surface> out;
  for (const Draw& draw : scene.draws) out.push_back(surface_of(scene, draw, records));
  return out;
}

}  // namespace plumbline::pipeline
