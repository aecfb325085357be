#include "check/polygons/clip_distances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "check/bounds/units.h"

namespace plumbline::check {

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

AlongLine along_line(const ClipVertex<double>& v, const ClipVertex<double>& a, const ClipVertex<double>& b,
                     const Corners& c) {
  return from_line(place_of(v, c), place_of(a, c), place_of(b, c));
}

double distance_from_edges(const ClipVertex<double>& v, const Corners& c) {
  return std::min({distance_from_edge(v, c, 0), distance_from_edge(v, c, 1), distance_from_edge(v, c, 2)});
}

}  // namespace plumbline::check
