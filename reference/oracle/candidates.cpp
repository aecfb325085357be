#include "reference/oracle/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "capture/renderer.h"

namespace plumbline::math {

namespace {

/// Pixels [first, last] of [0, size) whose centres are in [lo, hi]; first > last: none.
struct Range {
  int first, last;
};
Range centres(double lo, double hi, int size) {
  return {static_cast<int>(std::clamp(std::ceil(lo - 0.5), 0.0, static_cast<double>(size))),
          static_cast<int>(std::clamp(std::floor(hi - 0.5), -1.0, static_cast<double>(size - 1)))};
}

/// Calls visit(x, y) for all pixels whose centres are within `reach` of the window segment a-b, and some a little
/// farther.
template <class Visit>
void walk(const Projected& projected, glm::dvec2 a, glm::dvec2 b, double reach, Visit visit) {
  const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
  const int along = steep ? 1 : 0, across = 1 - along;
  const std::array<int, 2> size{projected.width, projected.height};
  if (a[along] > b[along]) std::swap(a, b);
  const double length = b[along] - a[along], slope = length > 0 ? (b[across] - a[across]) / length : 0;
  const Range major = centres(a[along] - reach, b[along] + reach, size[static_cast<std::size_t>(along)]);
  for (int i = major.first; i <= major.last; ++i) {
    const double middle = a[across] + slope * std::clamp(i + 0.5 - a[along], 0.0, length);
    const Range minor = centres(middle - 2 * reach, middle + 2 * reach, size[static_cast<std::size_t>(across)]);
    for (int j = minor.first; j <= minor.last; ++j) steep ? visit(j, i) : visit(i, j);
  }
}

}  // namespace

void Candidates::require_complete() const {
  if (!dropped_) return;
  throw OverBudget(
      fmt::format("more than {} triangle-and-pixel pairs to look at, over the memory budget: "
                  "draw fewer triangles, fewer pixels, or nearer the origin",
                  most_));
}

void add_by_boxes(const Projected& projected, Candidates& out) {
  for (std::uint32_t primitive = 0; primitive < projected.triangles.size(); ++primitive) {
    const Triangle& t = projected.triangles[primitive];
    if (!t.drawn || t.flat) continue;
    glm::dvec2 lo(0), hi(projected.width, projected.height);
    if (t.ahead) {  // else it may be anywhere
      lo = hi;
      hi = glm::dvec2(0);
      for (const std::uint32_t c : t.corner) {
        const glm::dvec3& v = projected.corners[c].v;
        const glm::dvec2 p = glm::dvec2(v) / v.z + 0.5 * glm::dvec2(projected.width, projected.height);
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
      }
    }
    const Range x = centres(lo.x, hi.x, projected.width), y = centres(lo.y, hi.y, projected.height);
    for (int py = y.first; py <= y.last; ++py) {
      for (int px = x.first; px <= x.last; ++px) {
        const glm::dvec3 d = projected.ray(px, py);
        bool inside = true;
        for (const glm::dvec3& n : t.n) inside &= t.sign * glm::dot(n, d) >= 0;
        if (inside) out.add(static_cast<std::uint32_t>(py * projected.width + px), primitive);
      }
    }
    out.require_complete();
  }
}

void add_by_edges(const Projected& projected, Candidates& out) {
  const glm::dvec2 middle(0.5 * projected.width, 0.5 * projected.height);
  for (std::uint32_t primitive = 0; primitive < projected.triangles.size(); ++primitive) {
    const Triangle& t = projected.triangles[primitive];
    if (!t.drawn) continue;
    const auto pixels = static_cast<std::uint32_t>(projected.width * projected.height);
    for (std::uint32_t pixel = 0; t.loose && pixel < pixels; ++pixel) out.add(pixel, primitive);
    for (std::size_t i = 0; i < 3 && !t.loose; ++i) {
      const Corner &j = projected.corners[t.corner[i]], &k = projected.corners[t.corner[(i + 1) % 3]];
      // Pieces in front of the near plane and behind the far one are included: a triangle seen edge on may be snapped
      // onto pixels beyond such an edge and beyond the plane.
      const Piece piece = piece_in_window(projected, j, k, t.reach + 1);
      if (piece.from > piece.to) continue;
      std::array<glm::dvec2, 2> p;
      for (std::size_t end = 0; end < 2; ++end) {
        const glm::dvec3 v = j.v + (end == 0 ? piece.from : piece.to) * (k.v - j.v);
        p[end] = glm::dvec2(v) / std::max(v.z, kFloatRounding * t.size.w) + middle;
      }
      walk(projected, p[0], p[1], t.reach,
           [&](int px, int py) { out.add(static_cast<std::uint32_t>(py * projected.width + px), primitive); });
    }
    out.require_complete();
  }
}

}  // namespace plumbline::math
