#include "check/polygons/cut_at_sides.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "check/polygons/legal_polygon.h"

namespace plumbline::check {

namespace {

using Polygon = std::vector<ClipVertex<double>>;

constexpr std::size_t kSides = 4;  // the first of distances()

bool reaches_beyond(const Polygon& polygon, std::size_t side) {
  double scale = 0;
  for (const ClipVertex<double>& v : polygon) {
    for (int c = 0; c < 4; ++c) scale = std::max(scale, std::abs(v.p_clip[c]));
  }
  return std::ranges::any_of(polygon, [&](const auto& v) { return distances(v.p_clip)[side] < -0x1p-16 * scale; });
}

}  // namespace

Records<double> cut_at_sides(Records<double> records) {
  ClipPolygons<double> out;
  for (const ClipPolygon& of : records.polygons.polygons) {
    const auto first = records.polygons.vertices.begin() + static_cast<std::ptrdiff_t>(of.first);
    Polygon polygon(first, first + static_cast<std::ptrdiff_t>(of.count));
    for (std::size_t side = 0; side < kSides && of.count > 2; ++side) {
      if (reaches_beyond(polygon, side)) polygon = cut_by(polygon, side, 0);
    }
    if (polygon.empty()) continue;
    out.polygons.push_back(
        {of.primitive, static_cast<std::uint32_t>(out.vertices.size()), static_cast<std::uint32_t>(polygon.size())});
    out.vertices.insert(out.vertices.end(), polygon.begin(), polygon.end());
  }
  records.polygons = std::move(out);
  return records;
}

}  // namespace plumbline::check
