#include "pipeline/depth.h"

#include <algorithm>
#include <cmath>

#include "pipeline/window.h"

namespace plumbline::pipeline {

namespace {

// a b - c d to within two roundings of the result, however close the products are (Kahan).
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  const double error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

double cross(glm::dvec2 a, glm::dvec2 b) { return difference_of_products(a.x, b.y, a.y, b.x); }

BarycentricPlanes along_line(const WindowTriangle<float>& line, glm::dvec2 anchor) {
  const glm::dvec2 p0(line.v[0].p_win), d = glm::dvec2(line.v[1].p_win) - p0;
  const double square = glm::dot(d, d);
  if (square == 0) return {anchor.x, anchor.y, 0, 0, 0, 0, 0, 0};
  return {anchor.x, anchor.y, glm::dot(anchor - p0, d) / square, d.x / square, d.y / square, 0, 0, 0};
}

// The corners that planes go through.
struct PlaneCorners {
  glm::dvec2 p0, d1, d2;  // d1, d2: the others' places from it
  double twice_area;
};
PlaneCorners corners_of(const WindowTriangle<float>& triangle) {
  glm::dvec2 p[3];
  for (int i = 0; i < 3; ++i) p[i] = glm::dvec2(triangle.v[static_cast<std::size_t>(i)].p_win);
  double twice_area = cross(p[1] - p[0], p[2] - p[0]);
  if (!(triangle.front ? twice_area > 0 : twice_area < 0)) {
    for (int i = 0; i < 3; ++i) p[i] = glm::dvec2(triangle.v[static_cast<std::size_t>(i)].snapped) / 256.0 + 0.5;
    twice_area = cross(p[1] - p[0], p[2] - p[0]);
  }
  return {p[0], p[1] - p[0], p[2] - p[0], twice_area};
}

// In window z.
double offset_of(const WindowTriangle<float>& triangle, const DepthState& state) {
  if (triangle.corners < 3 || state.offset == PolygonOffset{}) return 0;
  const double z0 = triangle.v[0].p_win.z, z1 = triangle.v[1].p_win.z, z2 = triangle.v[2].p_win.z;
  const auto [p0, d1, d2, twice_area] = corners_of(triangle);
  const double slope_x = difference_of_products(z1 - z0, d2.y, z2 - z0, d1.y) / twice_area;
  const double slope_y = difference_of_products(z2 - z0, d1.x, z1 - z0, d2.x) / twice_area;
  const double m = std::max(std::abs(slope_x), std::abs(slope_y));
  return state.offset.factor * m + state.offset.units * polygon_offset_unit(state.format, std::max({z0, z1, z2}));
}

}  // namespace

BarycentricPlanes planes_of(const WindowTriangle<float>& triangle, int x0, int y0) {
  if (triangle.corners < 3) return along_line(triangle, {x0 + 0.5, y0 + 0.5});
  const auto [p0, d1, d2, twice_area] = corners_of(triangle);
  const glm::dvec2 anchor(x0 + 0.5, y0 + 0.5), d = anchor - p0;
  return {anchor.x,           anchor.y,           cross(d, d2) / twice_area,
          d2.y / twice_area,  -d2.x / twice_area, cross(d1, d) / twice_area,
          -d1.y / twice_area, d1.x / twice_area};
}

BarycentricPlanes moved(const BarycentricPlanes& planes, glm::ivec2 place) {
  const glm::dvec2 by = glm::dvec2(place) / static_cast<double>(kSubpixel);
  BarycentricPlanes out = planes;
  out.x0 -= by.x;
  out.y0 -= by.y;
  return out;
}

// What the near and far plane do not cut is clamped to where they are (GL_ARB_depth_clamp); else to what formats hold.
DepthState depth_state(const Draw& draw, DepthFormat format, bool depth_clamp) {
  DepthState out{format};
  out.offset = draw.polygon_offset;
  if (!depth_clamp) return out;
  const auto [low, high] = std::minmax(draw.depth_range.near, draw.depth_range.far);
  out.low = low;
  out.high = high;
  return out;
}

DepthSetup depth_setup(const WindowTriangle<float>& triangle, const DepthState& state) {
  const double z0 = triangle.v[0].p_win.z;
  return {z0 + offset_of(triangle, state),
          triangle.v[1].p_win.z - z0,
          triangle.v[2].p_win.z - z0,
          depth_scale(state.format),
          state.low,
          state.high};
}

DepthSetup moved(const DepthSetup& depth, const BarycentricPlanes& planes, glm::ivec2 place) {
  const glm::dvec2 by = glm::dvec2(place) / static_cast<double>(kSubpixel);
  DepthSetup out = depth;
  out.z0 += (by.x * planes.l1_x + by.y * planes.l1_y) * out.dz1 + (by.x * planes.l2_x + by.y * planes.l2_y) * out.dz2;
  return out;
}

}  // namespace plumbline::pipeline
