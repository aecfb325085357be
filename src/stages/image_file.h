// Planes as image files. A plane's row 0 is its bottom, a file's first row its top: rows are flipped on the way. Alpha
// stays straight, colours are numbers: nothing is multiplied, no colour space converted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <glm/glm.hpp>

#include "stages/plane.h"

namespace plumbline {

/// The message names the file.
struct ImageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// 8-bit RGBA: value * 255 rounded to nearest, values clamped to [0,1], NaN 0. The file appears whole or not at all.
/// Throws ImageError, as all below do.
void write_png(const std::filesystem::path& file, const Plane<glm::vec4>& plane);
/// The same, in memory.
std::vector<std::uint8_t> encode_png(const Plane<glm::vec4>& plane);

/// 32-bit float RGBA, bit for bit, lossless compression.
void write_exr(const std::filesystem::path& file, const Plane<glm::vec4>& plane);
/// One channel "Z": window z rounded to 32-bit float.
void write_depth_exr(const std::filesystem::path& file, const Plane<double>& plane);

/// write_png or write_exr, by the ending .png or .exr.
void write_image(const std::filesystem::path& file, const Plane<glm::vec4>& plane);

/// A PNG, EXR, or another format that OpenImageIO knows, of up to 16384 x 16384: 8- and 16-bit codes as
/// code / (2^n - 1), float as it is. One channel comes as red, green and blue, a missing alpha as 1.
Plane<glm::vec4> read_image(const std::filesystem::path& file);

}  // namespace plumbline
