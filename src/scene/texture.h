// Textures in OpenGL's terms: format, sampler parameters, and the texels of each level.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline {

/// OpenGL's base internal formats: which components a texture has (OpenGL 2.1 spec, table 3.15).
enum class TextureFormat { alpha, luminance, luminance_alpha, intensity, rgb, rgba };
/// Storage of a texture's components: codes of 8 bits, value = code / 255, or floats.
enum class TexelType { unorm8, float32 };

enum class MinFilter {
  nearest,
  linear,
  nearest_mipmap_nearest,
  linear_mipmap_nearest,
  nearest_mipmap_linear,
  linear_mipmap_linear
};
enum class MagFilter { nearest, linear };
enum class Wrap { repeat, mirrored_repeat, clamp_to_edge, clamp_to_border };

constexpr bool mipmaps(MinFilter filter) { return filter >= MinFilter::nearest_mipmap_nearest; }

/// A texture object's parameters, with OpenGL's initial values (OpenGL 2.1 spec, 3.8.4 and table 6.17).
struct Sampler {
  MinFilter min = MinFilter::nearest_mipmap_linear;
  MagFilter mag = MagFilter::linear;
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  glm::vec4 border{0};  ///< rgba in [0,1]; components that the format lacks are ignored
  float lod_bias = 0;   ///< [-16, 16]
  float min_lod = -1000, max_lod = 1000;
  int base_level = 0, max_level = 1000;  ///< base_level is an existing level, max_level >= base_level
};

/// A level's texels, row by row from t = 0, as texture source components (Cs, As) of OpenGL 2.1's table 3.21:
/// components that the format lacks are filled in, so that one filter serves all formats.
struct TextureLevel {
  int width = 0, height = 0;
  std::vector<glm::vec4> texels;
  const glm::vec4& at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

struct Texture {
  std::string name;
  TextureFormat format = TextureFormat::rgb;
  TexelType type = TexelType::unorm8;
  Sampler sampler;
  std::vector<TextureLevel> levels;  ///< 0: the image; each next half as wide and high, rounded down; the last 1 x 1
};

/// Texture source components (Cs, As) of `rgba` in that format: `alpha` has colour 0, `luminance` and `rgb` have
/// alpha 1 (OpenGL 2.1 spec, tables 3.15 and 3.21).
glm::vec4 source_components(TextureFormat format, const glm::vec4& rgba);

/// Sets texture.levels: the rgba image in the texture's format and type, and the mipmap levels down to 1 x 1. A texel
/// is the mean of its area in the next finer level (of an odd side, with fractions of texels), computed in double and
/// rounded to the type. OpenGL leaves that filter open (3.8.8, automatic mipmap generation): all renderers get these
/// levels.
void set_levels(Texture& texture, TextureLevel image);

/// Number of the coarsest level that may be sampled: `q` of OpenGL 2.1 spec 3.8.8.
int last_level(const Texture& texture);

enum class TextureEnvironment { replace, modulate, decal, blend, add };

/// A draw's texture (glTexEnv).
struct DrawTexture {
  std::uint32_t texture = 0;  ///< index into Scene::textures
  TextureEnvironment environment = TextureEnvironment::modulate;
  glm::vec4 color{0};  ///< blend's constant colour, [0,1]
};

}  // namespace plumbline
