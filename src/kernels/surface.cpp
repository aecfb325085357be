#include "kernels/surface.h"

namespace plumbline::pipeline {

Surface surface_of(const Scene& scene, const Draw& draw, Lights lights) {
  Surface surface{&scene, &draw, {}, {}, {}};
  if (draw.texture) {
    const Texture& texture = scene.textures.at(draw.texture->texture);
    surface.texture = texture_setup(texture, texture.sampler);
  }
  if (is_lit_per_fragment(draw)) surface.light = fragment_light(scene, draw, lights);
  for (const Varying v : kAllVaryings) {
    if (!is_back(v) && carries(scene, draw, v)) surface.carried.push_back(v);
  }
  return surface;
}

}  // namespace plumbline::pipeline
