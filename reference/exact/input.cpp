#include "reference/exact/input.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "reference/arithmetic/draw_ranges.h"

namespace plumbline::exact {

void require_size(std::string_view what, std::size_t is, std::size_t expected) {
  if (is != expected)
    throw std::invalid_argument(fmt::format("exact: {}: {} entries, expected {}", what, is, expected));
}

void require_index(std::string_view what, std::size_t is, std::size_t end) {
  if (is >= end) throw std::invalid_argument(fmt::format("exact: {} is {}, expected less than {}", what, is, end));
}

DrawOf::DrawOf(const Scene& scene) : scene_(scene), ranges_(math::ranges_of_draws(scene)) {}

std::size_t DrawOf::index(std::uint32_t primitive) const {
  const std::size_t end = ranges_.empty() ? 0 : ranges_.back().first_primitive + ranges_.back().primitive_count;
  require_index("a primitive's number", primitive, end);
  return math::draw_with(ranges_, primitive).value();
}

std::vector<FragmentRun> runs_by_triangle(const Scene& scene, const Records<double>& records) {
  std::vector<FragmentRun> runs;
  for (std::size_t i = 0; i < records.covered.size(); ++i) {
    const auto [triangle, x, y] = records.covered[i];
    if (triangle >= records.triangles.size() || x >= scene.frame.width || y >= scene.frame.height)
      throw std::invalid_argument(fmt::format(
          "exact: covered[{}] is pixel {}, {} of triangle {}, expected one of {} x {} pixels and {} triangles", i, x, y,
          triangle, scene.frame.width, scene.frame.height, records.triangles.size()));
    if (!runs.empty() && runs.back().triangle > triangle)
      throw std::invalid_argument(fmt::format("exact: covered[{}] is of triangle {}, expected none before {}", i,
                                              triangle, runs.back().triangle));
    if (runs.empty() || runs.back().triangle < triangle) runs.push_back({triangle, i, i});
    runs.back().last = i + 1;
  }
  return runs;
}

}  // namespace plumbline::exact
