// Images for textures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>

#include "scene/texture.h"

namespace plumbline {

/// The message names the file, what was expected and what was found.
struct TextureError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The longest side of an image [texels].
inline constexpr int kLargestTexture = 16384;
/// Most texels of all images of a scene together: 256 MiB of vec4, and a third more for the coarser levels.
inline constexpr std::size_t kMostTexels = std::size_t{1} << 24;

struct TextureImage {
  TextureLevel rgba;
  int channels = 4;  ///< of the file: 1 grey, 2 with alpha, 3 rgb, 4 rgba
};

/// The image of a PNG, JPEG, TGA or EXR file, the lowest row first. Numbers are as stored: codes of 8 or 16 bits
/// divided by the largest code, floats as they are; no colour space is converted, no alpha multiplied or divided. Grey
/// is repeated in r, g and b; a missing alpha is 1.
///
/// Throws TextureError: another ending, not readable, truncated; several images in one; more than four channels,
/// kLargestTexture texels a side or `most_texels`; numbers of another type, not finite or beyond +-65504, half's
/// largest.
TextureImage load_texture_image(const std::filesystem::path& file, std::size_t most_texels);

}  // namespace plumbline
