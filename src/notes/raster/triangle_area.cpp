#include "notes/raster/triangle_area.h"

#include <cmath>
#include <cstdint>

namespace plumbline::raster {

namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// The part of a convex polygon where distance(p) >= 0, distance being linear.
template <class Distance>
std::vector<glm::dvec2> cut(const std::vector<glm::dvec2>& polygon, Distance distance) {
  std::vector<glm::dvec2> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = distance(a), db = distance(b);
    if (da >= 0) out.push_back(a);
    if ((da >= 0) != (db >= 0)) out.push_back(a + da / (da - db) * (b - a));
  }
  return out;
}

}  // namespace

double area_in_pixel(const Corners& corners, int x, int y) {
  std::vector<glm::dvec2> polygon;  // relative to the pixel's centre: the square's sides are at +-1/2
  for (const glm::ivec2& p : corners) polygon.push_back(glm::dvec2(p) / 256.0 - glm::dvec2(x, y));
  for (const int axis : {0, 1}) {
    polygon = cut(polygon, [=](glm::dvec2 p) { return 0.5 + p[axis]; });
    polygon = cut(polygon, [=](glm::dvec2 p) { return 0.5 - p[axis]; });
  }
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return std::abs(twice) / 2;
}

double area(const Corners& corners) {
  const glm::i64vec2 a = corners[0], b = corners[1], c = corners[2];
  const std::int64_t twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return std::abs(static_cast<double>(twice)) / (2 * 65536.0);
}

}  // namespace plumbline::raster
