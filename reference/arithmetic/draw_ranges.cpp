#include "reference/arithmetic/draw_ranges.h"

namespace plumbline::math {

std::vector<DrawRange> ranges_of_draws(const Scene& scene) {
  std::vector<DrawRange> ranges;
  DrawRange next{0, 0, 0, 0};
  for (const Draw& draw : scene.draws) {
    const Mesh& mesh = scene.meshes.at(draw.mesh);
    next.first_vertex += next.vertex_count;
    next.first_primitive += next.primitive_count;
    next.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
    next.primitive_count = static_cast<std::uint32_t>(mesh.triangles.size());
    ranges.push_back(next);
  }
  return ranges;
}

std::optional<std::size_t> draw_with(std::span<const DrawRange> ranges, std::uint32_t primitive) {
  std::size_t first = 0, end = ranges.size();  // the draw, if any, is in [first, end)
  while (first < end) {
    const std::size_t middle = first + (end - first) / 2;
    const DrawRange& range = ranges[middle];
    if (primitive < range.first_primitive) {
      end = middle;
    } else if (primitive - range.first_primitive < range.primitive_count) {
      return middle;
    } else {
      first = middle + 1;
    }
  }
  return std::nullopt;
}

}  // namespace plumbline::math
