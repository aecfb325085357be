#include "check/polygons/legal_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "check/bounds/units.h"

namespace plumbline::check {

std::array<double, 6> distances(const Vec4<double>& p) {
  return {p.w - p.x, p.w + p.x, p.w - p.y, p.w + p.y, p.w + p.z, p.w - p.z};
}

bool on_plane(const ClipVertex<double>& v, std::size_t plane, double tolerance) {
  return std::abs(distances(v.p_clip)[plane]) <= tolerance;
}

bool needs_no_cut(const Corners& c) {
  const auto all_corners = [&](std::size_t plane, auto are) {
    return std::ranges::all_of(c.p_clip, [&](const Vec4<double>& corner) { return are(distances(corner)[plane]); });
  };
  bool inside = true, outside = false;
  for (std::size_t p = 0; p < c.planes; ++p) {
    inside &= all_corners(p, [](double d) { return d >= 0; });
    outside |= all_corners(p, [](double d) { return d < 0; });
  }
  return inside || outside;
}

bool may_vanish(std::span<const ClipVertex<double>> polygon, std::size_t planes, double tolerance) {
  for (std::size_t p = 0; p < planes && !polygon.empty(); ++p) {
    if (std::ranges::all_of(polygon, [&](const auto& v) { return distances(v.p_clip)[p] <= tolerance; })) return true;
  }
  return false;
}

std::vector<ClipVertex<double>> cut_by(std::span<const ClipVertex<double>> polygon, std::size_t plane, double by) {
  std::vector<ClipVertex<double>> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex<double>&v = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const double d = distances(v.p_clip)[plane] - by, d_next = distances(next.p_clip)[plane] - by;
    if (d >= 0) left.push_back(v);
    if ((d >= 0) == (d_next >= 0)) continue;
    const double t = d / (d - d_next);
    left.push_back({glm::mix(v.p_clip, next.p_clip, t), glm::mix(v.color, next.color, t), true});
  }
  return left;
}

std::vector<ClipVertex<double>> clipped(const Corners& c, double by) {
  std::vector<ClipVertex<double>> polygon;
  for (std::size_t i = 0; i < 3; ++i) polygon.push_back({c.p_clip[i], c.color[i], false});
  for (std::size_t p = 0; p < c.planes; ++p) polygon = cut_by(polygon, p, by);
  return polygon;
}

bool is_flat(const Corners& c, double tolerance) {
  const auto length = [](const Vec4<double>& v) { return std::sqrt(glm::dot(v, v)); };
  std::size_t from = 0;  // of the longest edge
  for (std::size_t i = 1; i < 3; ++i) {
    if (length(c.p_clip[(i + 1) % 3] - c.p_clip[i]) > length(c.p_clip[(from + 1) % 3] - c.p_clip[from])) from = i;
  }
  const Vec4<double> along = c.p_clip[(from + 1) % 3] - c.p_clip[from],
                     rest = c.p_clip[(from + 2) % 3] - c.p_clip[from];
  const double squared = glm::dot(along, along);
  return squared == 0 || length(rest - along * (glm::dot(rest, along) / squared)) <= tolerance;
}

bool may_end_in(const ClipVertex<double>& v, const Corners& c, std::size_t i, double tolerance) {
  const auto d = distances(c.p_clip[i]);
  const bool is_corner = v.p_clip == c.p_clip[i] && v.color == c.color[i];
  for (std::size_t p = 0; p < c.planes; ++p) {
    if (std::abs(d[p]) <= tolerance && (v.cut ? on_plane(v, p, tolerance) : is_corner)) return true;
  }
  return false;
}

namespace {

double distance_to_segment(const Vec4<double>& p, const Vec4<double>& a, const Vec4<double>& b) {
  const Vec4<double> along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
  return glm::distance(p, a + t * along);
}

double distance_to_triangle(const Vec4<double>& p, const Vec4<double>& a, const Vec4<double>& b,
                            const Vec4<double>& c) {
  const double to_sides =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const Vec4<double> e = b - a, f = c - a, to = p - a;
  const double ee = glm::dot(e, e), ff = glm::dot(f, f), ef = glm::dot(e, f), area = ee * ff - ef * ef;
  if (!(area > 1e-24 * ee * ff)) return to_sides;  // 0 but for double's rounding
  const double s = (ff * glm::dot(e, to) - ef * glm::dot(f, to)) / area,
               t = (ee * glm::dot(f, to) - ef * glm::dot(e, to)) / area;
  return s >= 0 && t >= 0 && s + t <= 1 ? std::min(to_sides, glm::distance(to, s * e + t * f)) : to_sides;
}

}  // namespace

double distance_to_polygon(const Vec4<double>& p, std::span<const ClipVertex<double>> polygon) {
  double least = kInfinite;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex<double>& next = polygon[std::min(i + 1, polygon.size() - 1)];
    least = std::min(least, distance_to_triangle(p, polygon[0].p_clip, polygon[i].p_clip, next.p_clip));
  }
  return least;
}

namespace {

using Vec8 = std::array<double, 8>;

Vec8 place_of(const Vec4<double>& p, const Vec4<double>& color, const Corners& c) {
  const double s = c.scale, k = c.color_scale;
  return {p.x / s, p.y / s, p.z / s, p.w / s, color.r / k, color.g / k, color.b / k, color.a / k};
}
Vec8 place_of(const ClipVertex<double>& v, const Corners& c) { return place_of(v.p_clip, v.color, c); }
Vec8 corner_of(const Corners& c, std::size_t i) { return place_of(c.p_clip[i], c.color[i], c); }

double dot(const Vec8& a, const Vec8& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 8; ++i) sum += a[i] * b[i];
  return sum;
}
Vec8 minus(const Vec8& a, const Vec8& b, double times = 1) {
  Vec8 out;
  for (std::size_t i = 0; i < 8; ++i) out[i] = a[i] - times * b[i];
  return out;
}

double largest(const Vec8& v) {
  double out = 0;
  for (double value : v) out = std::max(out, std::isfinite(value) ? std::abs(value) : kInfinite);
  return out;
}

AlongLine from_line(const Vec8& v, const Vec8& a, const Vec8& b) {
  const Vec8 along = minus(b, a), rest = minus(v, a);
  const double share = dot(along, along) > 0 ? dot(rest, along) / dot(along, along) : 0;
  return {share, largest(minus(rest, along, share))};
}

}  // namespace

double largest_difference(const ClipVertex<double>& a, const ClipVertex<double>& b, const Corners& c) {
  return largest(minus(place_of(a, c), place_of(b, c)));
}

double distance_between(const ClipVertex<double>& a, const ClipVertex<double>& b, const Corners& c) {
  const Vec8 apart = minus(place_of(a, c), place_of(b, c));
  return std::sqrt(dot(apart, apart));
}

// Largest coordinate of v - corner 0 after its components along the triangle's two directions are removed
// (Gram-Schmidt): 0 on the plane, whose points are weighted means of the corners.
double distance_from_triangle(const ClipVertex<double>& v, const Corners& c) {
  const Vec8 origin = corner_of(c, 0);
  Vec8 e1 = minus(corner_of(c, 1), origin), e2 = minus(corner_of(c, 2), origin);
  if (dot(e2, e2) > dot(e1, e1)) std::swap(e1, e2);
  if (dot(e1, e1) > 0) e2 = minus(e2, e1, dot(e1, e2) / dot(e1, e1));
  Vec8 rest = minus(place_of(v, c), origin);
  if (dot(e1, e1) > 0) rest = minus(rest, e1, dot(rest, e1) / dot(e1, e1));
  if (dot(e2, e2) > 1e-24 * dot(e1, e1)) rest = minus(rest, e2, dot(rest, e2) / dot(e2, e2));
  return largest(rest);
}

double distance_from_edge(const ClipVertex<double>& v, const Corners& c, std::size_t i) {
  return from_line(place_of(v, c), corner_of(c, i), corner_of(c, (i + 1) % 3)).distance;
}

AlongLine nearest_on_line(const ClipVertex<double>& v, const ClipVertex<double>& a, const ClipVertex<double>& b,
                          const Corners& c) {
  return from_line(place_of(v, c), place_of(a, c), place_of(b, c));
}

double distance_from_edges(const ClipVertex<double>& v, const Corners& c) {
  return std::min({distance_from_edge(v, c, 0), distance_from_edge(v, c, 1), distance_from_edge(v, c, 2)});
}

}  // namespace plumbline::check
