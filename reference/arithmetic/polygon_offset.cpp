// Slope g of a plane through corners p_i of depth z_i: g . (p_i - p_j) = z_i - z_j. Corners displaced by up to d, with
// depths up to e off, change g by some dg with |dg . (p_i - p_j)| <= 2 (e + |g| d) along every side. A linear function
// that varies by at most v over a triangle has a slope of at most v over the smallest altitude.
#include "reference/arithmetic/polygon_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/arithmetic/bounded.h"

namespace plumbline::math {

long double offset_unit(DepthFormat format, const Conventions& conventions, double largest_z) {
  const long double unit = conventions.offset_unit.x, of_16_bits = conventions.offset_unit.y;
  switch (format) {
    case DepthFormat::z8: return unit / 0xff;
    case DepthFormat::z16: return of_16_bits / 0xffff;
    case DepthFormat::z24: return unit / 0xffffff;
    case DepthFormat::z32f: break;
  }
  if (conventions.float_offset_unit > 0) return conventions.float_offset_unit;
  float below = static_cast<float>(std::max(largest_z, 0.0));
  if (below > 0 && static_cast<double>(below) > largest_z) below = std::nextafter(below, 0.0f);
  return static_cast<long double>(std::nextafter(below, std::numeric_limits<float>::infinity())) - below;
}

OffsetBounds polygon_offset(const Projected& scene, const Triangle& t, const PolygonOffset& offset) {
  if (offset == PolygonOffset{}) return {};
  if (t.flat) return {0, kInfinity};
  const double scale = range_scale(t), factor = offset.factor, units = offset.units;
  double z_ndc = 1;  // largest |z_ndc|; under depth clamp a piece's corner may exceed 1
  if (scene.depth_clamp) {
    z_ndc = t.ahead ? std::max({1.0, std::abs(2 * t.z_min - 1), std::abs(2 * t.z_max - 1)})
                    : std::max(1.0, t.size.z / t.w_min);
  }
  const double corner_error =
      kFloatRounding * (scale * t.roundings * (t.size.z + z_ndc * t.size.w) / (2 * t.w_min) + 3);  // as pixel_hit.cpp's
  // r depends on the largest depth of a piece's corners: corners of the triangle, or cuts.
  const double near = t.range.near, far = t.range.far;
  double least = scene.depth_clamp ? 0 : std::min(near, far),
         largest = scene.depth_clamp ? kInfinity : std::max(near, far);
  if (t.ahead) {
    const double a = near + (far - near) * t.z_min, b = near + (far - near) * t.z_max;
    largest = std::min(largest, std::max(a, b) + corner_error);
    if (!t.cut) least = std::max(a, b) - corner_error;
  }
  OffsetBounds out;
  if (units != 0) {
    const bool is_of_depth = scene.depth == DepthFormat::z32f && !(scene.conventions.float_offset_unit > 0);
    if (is_of_depth && !std::isfinite(largest)) return {0, kInfinity};
    const auto r_at = [&](double z) { return static_cast<double>(offset_unit(scene.depth, scene.conventions, z)); };
    const double r_lo = r_at(least), r_hi = r_at(largest);
    out = {0.5 * units * (r_lo + r_hi), 0.5 * std::abs(units) * (r_hi - r_lo)};
  }
  if (factor == 0) return out;
  const double m = scale * std::max(std::abs(t.z_plane.x), std::abs(t.z_plane.y));
  const double slope = scale * std::hypot(t.z_plane.x, t.z_plane.y);
  const double altitude = t.altitude - 2 * t.reach;
  // OpenGL 2.1, 3.5.5: the slope is the gradient's length, or its larger component (equations 3.10 and 3.11).
  out.middle += factor * 0.5 * (m + slope);
  out.half += std::abs(factor) * 0.5 * (slope - m);
  out.half += altitude > 0 ? std::abs(factor) * 2 * (corner_error + slope * t.reach) / altitude : kInfinity;
  return out;
}

}  // namespace plumbline::math
