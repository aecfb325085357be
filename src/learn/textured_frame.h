// Frames and textures of the probes of textures.
#pragma once

#include <string>
#include <utility>

#include "learn/probe_scene.h"

namespace plumbline::learn {

inline constexpr int kTexturedSize = 64;  ///< side of a textured frame [pixels]

/// A frame filled by a textured rectangle; s and t from `least` to `most`.
inline Scene textured_frame(const std::string& name, Texture texture, float most, float least = 0) {
  Scene scene = probe_frame(name, kTexturedSize, kTexturedSize);
  scene.textures.push_back(std::move(texture));
  const auto at = [&](double x, double y) {
    const glm::dvec2 share = glm::dvec2(x, y) / static_cast<double>(kTexturedSize);
    return ProbeCorner{{x, y, kFlatDepth}, glm::vec4(1), glm::vec2(least) + (most - least) * glm::vec2(share)};
  };
  add_triangles(scene, quad({at(0, 0), at(kTexturedSize, 0), at(kTexturedSize, kTexturedSize), at(0, kTexturedSize)}))
      .texture = DrawTexture{0, TextureEnvironment::replace, glm::vec4(0)};
  return scene;
}

/// Level 0 has the grey codes of code(x, y); each level n above 0 is one grey, of 40 n codes.
Texture texture_of(int size, auto code) {
  Texture out;
  out.format = TextureFormat::rgb;
  out.sampler.wrap_s = out.sampler.wrap_t = Wrap::clamp_to_edge;
  for (int level = 0; size > 0; size /= 2, ++level) {
    TextureLevel& to = out.levels.emplace_back(TextureLevel{size, size, {}});
    for (int i = 0; i < size * size; ++i) {
      const int grey = level == 0 ? code(i % size, i / size) : 40 * level;
      to.texels.emplace_back(glm::vec3(static_cast<float>(grey) / 255), 1);
    }
  }
  return out;
}

/// True: a tie rule may leave the pixel uncovered, for its sample lies on a textured frame's diagonal or border.
inline bool may_be_nobodys(int x, int y, const glm::dvec2& sample) {
  const auto is_on_side = [](int at, double offset) {
    return (at == 0 && offset == 0) || (at == kTexturedSize - 1 && offset == 1);
  };
  return x == y || is_on_side(x, sample.x) || is_on_side(y, sample.y);
}

}  // namespace plumbline::learn
