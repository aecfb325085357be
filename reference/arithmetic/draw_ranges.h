// Numbering of vertices and primitives over all draws, as references count them; the renderer's count is in
// src/scene/scene.h.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace plumbline::math {

/// One range per draw, in draw order, each beginning where the one before ends.
std::vector<DrawRange> ranges_of_draws(const Scene& scene);

/// Index of the draw whose range holds the primitive; nullopt: no draw.
std::optional<std::size_t> draw_with(std::span<const DrawRange> ranges, std::uint32_t primitive);

}  // namespace plumbline::math
