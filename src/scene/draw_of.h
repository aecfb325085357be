// Which draw a primitive is of.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "scene/scene.h"

namespace plumbline {

/// The number, in Scene::draws, of the draw that has the primitive: the last that begins no later; nothing where there
/// is no draw. `ranges`: draw_ranges().
inline std::optional<std::size_t> draw_of(std::span<const DrawRange> ranges, std::uint32_t primitive) {
  const auto after = std::ranges::upper_bound(ranges, primitive, {}, &DrawRange::first_primitive);
  if (after == ranges.begin()) return std::nullopt;
  return static_cast<std::size_t>(after - 1 - ranges.begin());
}

}  // namespace plumbline
