#include "scene/mesh/polygon.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace plumbline {
namespace {

/// Largest distance of a corner from the polygon's plane, in extents (an extent: the diagonal of the bounding box).
/// Any cut of a polygon stays within that distance of the plane: two cuts differ by at most 2 kFlat extents, at most a
/// pixel where the polygon is 64 pixels long. The triangles of a square quad lean by at most 4 kFlat, 1.8 degrees: all
/// face one way, unless the quad is that close to edge-on.
constexpr double kFlat = 1.0 / 128;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Side of the line from a to b on which c lies: 1 left, -1 right, 0 on the line.
int side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const double area = cross(b - a, c - a);
  return (area > 0) - (area < 0);
}

bool within(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return c.x >= std::min(a.x, b.x) && c.x <= std::max(a.x, b.x) && c.y >= std::min(a.y, b.y) &&
         c.y <= std::max(a.y, b.y);
}

bool touch(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const int abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) || (cda == 0 && within(c, d, a)) ||
         (cdb == 0 && within(c, d, b));
}

}  // namespace

std::string polygon_fault(std::span<const glm::dvec3> corners) {
  const std::size_t n = corners.size();
  if (n <= 3) return "";

  glm::dvec3 normal(0), lo = corners[0], hi = corners[0], middle(0);  // the normal: Newell's
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3& corner = corners[i];
    normal += glm::cross(corner - corners[0], corners[(i + 1) % n] - corners[0]);
    lo = glm::min(lo, corner);
    hi = glm::max(hi, corner);
    middle += corner / static_cast<double>(n);
  }
  const double extent = glm::length(hi - lo), length = glm::length(normal);
  if (!(length > 1e-9 * extent * extent)) return "a polygon without an area, or one that crosses itself";
  normal /= length;
  for (std::size_t i = 0; i < n; ++i) {
    const double off = std::abs(glm::dot(corners[i] - middle, normal));
    if (off > kFlat * extent) {
      return fmt::format("a polygon that is not flat: corner {} is {:.3g} off the plane, of an extent of {:.3g}", i,
                         off, extent);
    }
  }

  const glm::dvec3 a = glm::abs(normal);
  const int drop = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  std::vector<glm::dvec2> flat;
  flat.reserve(n);
  for (const glm::dvec3& corner : corners) flat.emplace_back(corner[(drop + 1) % 3], corner[(drop + 2) % 3]);
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 &p = flat[i], &q = flat[(i + 1) % n];
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      if (touch(p, q, flat[j], flat[(j + 1) % n])) {
        return fmt::format("a polygon that crosses or touches itself, at its edges {} and {}", i, j);
      }
    }
  }
  return "";
}

}  // namespace plumbline
