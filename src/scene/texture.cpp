#include "scene/texture.h"

#include <algorithm>
#include <cmath>

namespace plumbline {
namespace {

glm::vec4 rounded(TexelType type, glm::dvec4 value) {
  if (type == TexelType::float32) return glm::vec4(value);
  glm::vec4 out;
  for (int c = 0; c < 4; ++c) {
    out[c] = static_cast<float>(std::floor(std::clamp(value[c], 0.0, 1.0) * 255.0 + 0.5)) / 255.0f;
  }
  return out;
}

/// Calls add(i, share) for each of `from` texels in a row that texel `to_i` of `to` covers; shares sum to 1.
template <class Add>
void shares(int from, int to, int to_i, Add add) {
  const double size = static_cast<double>(from) / to, first = to_i * size, last = (to_i + 1) * size;
  for (int i = static_cast<int>(first); i < from && i < last; ++i) {
    const double share = (std::min(last, i + 1.0) - std::max(first, static_cast<double>(i))) / size;
    if (share > 0) add(i, share);
  }
}

TextureLevel halved(const TextureLevel& above, TexelType type) {
  TextureLevel out{std::max(1, above.width / 2), std::max(1, above.height / 2), {}};
  out.texels.reserve(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      glm::dvec4 mean(0);
      shares(above.height, out.height, y, [&](int j, double share_y) {
        shares(above.width, out.width, x,
               [&](int i, double share_x) { mean += share_x * share_y * glm::dvec4(above.at(i, j)); });
      });
      out.texels.push_back(rounded(type, mean));
    }
  }
  return out;
}

}  // namespace

glm::vec4 source_components(TextureFormat format, const glm::vec4& rgba) {
  switch (format) {
    case TextureFormat::alpha: return {0, 0, 0, rgba.a};
    case TextureFormat::luminance: return {rgba.r, rgba.r, rgba.r, 1};
    case TextureFormat::luminance_alpha: return {rgba.r, rgba.r, rgba.r, rgba.a};
    case TextureFormat::intensity: return glm::vec4(rgba.r);
    case TextureFormat::rgb: return {rgba.r, rgba.g, rgba.b, 1};
    case TextureFormat::rgba: return rgba;
  }
  return rgba;
}

void set_levels(Texture& texture, TextureLevel image) {
  for (glm::vec4& texel : image.texels) {
    texel = source_components(texture.format, rounded(texture.type, glm::dvec4(texel)));
  }
  texture.levels.assign(1, std::move(image));
  while (texture.levels.back().width > 1 || texture.levels.back().height > 1) {
    texture.levels.push_back(halved(texture.levels.back(), texture.type));
  }
}

int last_level(const Texture& texture) {
  return std::min(static_cast<int>(texture.levels.size()) - 1, texture.sampler.max_level);
}

}  // namespace plumbline
