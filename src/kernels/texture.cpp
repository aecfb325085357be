#include "kernels/texture.h"

#include <algorithm>

namespace plumbline::pipeline {

GradientSetup gradient_setup(const WindowTriangle& triangle, const std::array<Vec4<float>, 3>& texcoords,
                             const BarycentricPlanes& planes) {
  const std::size_t third = triangle.corners == 3 ? 2 : 0;  // of a line, as depth_setup() has it
  double of_s[3], of_t[3], inv_w[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = k == 2 ? third : k;
    of_s[k] = to_wide(texcoords[i].s), of_t[k] = to_wide(texcoords[i].t), inv_w[k] = to_wide(triangle.v[i].inv_w);
  }
  return gradient_setup<double>(planes, of_s, of_t, inv_w);
}

TextureSetup texture_setup(const Texture& texture, const Sampler& sampler) {
  // c is 1/2 where a linear magnification meets nearest texels of mipmaps (3.8.9).
  const bool later = sampler.mag == MagFilter::linear && (sampler.min == MinFilter::nearest_mipmap_nearest ||
                                                          sampler.min == MinFilter::nearest_mipmap_linear);
  const double c = later ? 0.5 : 0.0;
  const TextureLevel& base = texture.levels[static_cast<std::size_t>(sampler.base_level)];
  TextureSetup out{
      &texture,
      sampler,
      std::min(static_cast<int>(texture.levels.size()) - 1, sampler.max_level),
      c,
      // A little less than 4^(c - bias), so that log2's rounding cannot put lambda above c.
      to_wide(sampler.min_lod) > c ? 0 : 0.999 * exp2_of(lesser_of(2 * (c - to_wide(sampler.lod_bias)), 1000.0)),
      static_cast<double>(base.width),
      static_cast<double>(base.height),
      {},
      source_components(texture.format, sampler.border),
      sampler.wrap_s == Wrap::clamp_to_border || sampler.wrap_t == Wrap::clamp_to_border};
  std::transform(texture.levels.begin(), texture.levels.end(), out.texels.begin(),
                 [](const TextureLevel& level) { return level.texels.data(); });
  return out;
}

}  // namespace plumbline::pipeline
