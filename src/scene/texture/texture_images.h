// Images for textures made by formula: the same numbers on every machine. Sides and cells are 1 or more, no more cells
// than texels along a side.
#pragma once

#include <array>
#include <cstdint>

#include "scene/texture.h"

namespace plumbline {

/// Checkerboard of columns x rows cells of two colours, the first at the lower left. A texel has the colour of the cell
/// in which its centre lies.
TextureLevel make_checker(int width, int height, int columns, int rows, const std::array<glm::vec4, 2>& colors);

/// Bilinear gradient between four colours at the corner texels' centres: lower left, lower right, upper right, upper
/// left.
TextureLevel make_gradient(int width, int height, const std::array<glm::vec4, 4>& corners);

/// Rows of bricks, every other row half a brick to the side, mortar one texel thick below and left of each.
TextureLevel make_bricks(int width, int height, int columns, int rows, const glm::vec4& brick, const glm::vec4& mortar);

/// Texture coordinates as colours: r = s, g = t at the texel's centre, b = 1 on lines, one texel thick, at the left and
/// lower borders of columns x rows cells, else 0; a = 1.
TextureLevel make_uv_grid(int width, int height, int columns, int rows);

/// Noise: each of the four components of a texel is a multiple of 1/255, hashed from position, channel and seed.
TextureLevel make_noise(int width, int height, std::uint32_t seed);

}  // namespace plumbline
