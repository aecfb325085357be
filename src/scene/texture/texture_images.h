// Images for textures made by formula: the same numbers on every machine.
#pragma once

#include <array>
#include <cstdint>

#include "scene/texture.h"

namespace plumbline {

/// columns x rows cells of two colours, the first at the lower left; a cell's border falls between texels or within
/// one, which then is of the cell that its centre lies in.
TextureLevel make_checker(int width, int height, int columns, int rows, const std::array<glm::vec4, 2>& colors);

/// From four colours at the corner texels' centres (lower left, lower right, upper right, upper left), bilinear.
TextureLevel make_gradient(int width, int height, const std::array<glm::vec4, 4>& corners);

/// Rows of bricks, every other row half a brick to the side, mortar one texel thick below and left of each.
TextureLevel make_bricks(int width, int height, int columns, int rows, const glm::vec4& brick, const glm::vec4& mortar);

/// r = s, g = t at the texel's centre, b = 1 on the lines between columns x rows cells, each one texel thick, else 0;
/// a = 1: a picture on which every texel tells where it is.
TextureLevel make_uv_grid(int width, int height, int columns, int rows);

/// Each component of each texel any multiple of 1/255, by a hash of its place, channel and seed.
TextureLevel make_noise(int width, int height, std::uint32_t seed);

}  // namespace plumbline
