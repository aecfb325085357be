#include "pipeline/texture.h"

#include <algorithm>

namespace plumbline::pipeline {

GradientSetup gradient_setup(const WindowTriangle<float>& triangle, const std::array<Vec4<float>, 3>& texcoords,
                             const BarycentricPlanes& planes) {
  // A plane through the corners' values over w, which are sums of two products at most: exact enough in double.
  const auto over_w = [&](int i, double value) {
    return value * static_cast<double>(triangle.v[static_cast<std::size_t>(i)].inv_w);
  };
  const auto plane = [&](double f0, double f1, double f2, double& at, double& d_dx, double& d_dy) {
    d_dx = planes.l1_x * (f1 - f0) + planes.l2_x * (f2 - f0);
    d_dy = planes.l1_y * (f1 - f0) + planes.l2_y * (f2 - f0);
    at = f0 + planes.l1_0 * (f1 - f0) + planes.l2_0 * (f2 - f0);
  };
  GradientSetup g{};
  g.x0 = planes.x0;
  g.y0 = planes.y0;
  plane(over_w(0, texcoords[0].s), over_w(1, texcoords[1].s), over_w(2, texcoords[2].s), g.s_0, g.s_x, g.s_y);
  plane(over_w(0, texcoords[0].t), over_w(1, texcoords[1].t), over_w(2, texcoords[2].t), g.t_0, g.t_x, g.t_y);
  plane(over_w(0, 1), over_w(1, 1), over_w(2, 1), g.q_0, g.q_x, g.q_y);
  return g;
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
