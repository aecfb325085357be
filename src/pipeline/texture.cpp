#include "pipeline/texture.h"

#include <algorithm>

namespace plumbline::pipeline {

GradientSetup gradient_setup(const WindowTriangle<float>& triangle, const std::array<Vec4<float>, 3>& texcoords,
                             const BarycentricPlanes& planes) {
  const std::size_t third = triangle.corners == 3 ? 2 : 0;  // of a line, as depth_setup() has it
  const auto plane = [&](auto value) {
    const auto over_w = [&](std::size_t i) { return to_wide(value(texcoords[i])) * to_wide(triangle.v[i].inv_w); };
    const double at_0 = over_w(0);
    return planes.through(at_0, over_w(1) - at_0, over_w(third) - at_0);
  };
  return {planes.x0, planes.y0, plane([](const Vec4<float>& v) { return v.s; }),
          plane([](const Vec4<float>& v) { return v.t; }), plane([](const Vec4<float>&) { return 1.0f; })};
}

TextureSetup texture_setup(const Texture& texture, const Sampler& sampler) {
  // Where nearest texels of mipmaps take over from a linear magnification, they do so half a level later (3.8.9).
  const bool later = sampler.mag == MagFilter::linear && (sampler.min == MinFilter::nearest_mipmap_nearest ||
                                                          sampler.min == MinFilter::nearest_mipmap_linear);
  const TextureLevel& base = texture.levels[static_cast<std::size_t>(sampler.base_level)];
  return {&texture,
          sampler,
          std::min(static_cast<int>(texture.levels.size()) - 1, sampler.max_level),
          later ? 0.5 : 0.0,
          static_cast<double>(base.width),
          static_cast<double>(base.height)};
}

}  // namespace plumbline::pipeline
