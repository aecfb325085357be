#include "pipeline/depth.h"

#include <algorithm>
#include <cmath>

#include "pipeline/window.h"

namespace plumbline::pipeline {

namespace {

BarycentricPlanes along_line(const WindowTriangle<float>& line, glm::dvec2 anchor) {
  const glm::dvec2 p0(line.v[0].p_win), d = glm::dvec2(line.v[1].p_win) - p0;
  const double square = glm::dot(d, d);
  if (square == 0) return {anchor.x, anchor.y, 0, 0, 0, 0, 0, 0};
  return {anchor.x, anchor.y, glm::dot(anchor - p0, d) / square, d.x / square, d.y / square, 0, 0, 0};
}

PlaneCorners<double> corners_of(const WindowTriangle<float>& t) {
  const auto& v = t.v;
  return plane_corners<float>({v[0].p_win.x, v[1].p_win.x, v[2].p_win.x}, {v[0].p_win.y, v[1].p_win.y, v[2].p_win.y},
                              {v[0].snapped.x, v[1].snapped.x, v[2].snapped.x},
                              {v[0].snapped.y, v[1].snapped.y, v[2].snapped.y}, t.front ? 1.0 : -1.0);
}

// In window z.
double offset_of(const WindowTriangle<float>& triangle, const DepthState& state) {
  if (triangle.corners < 3 || state.offset == PolygonOffset{}) return 0;
  const double z0 = triangle.v[0].p_win.z, z1 = triangle.v[1].p_win.z, z2 = triangle.v[2].p_win.z;
  const PlaneCorners<double> c = corners_of(triangle);
  const double slope_x = difference_of_products(z1 - z0, c.d2_y, z2 - z0, c.d1_y) / c.twice_area;
  const double slope_y = difference_of_products(z2 - z0, c.d1_x, z1 - z0, c.d2_x) / c.twice_area;
  const double m = std::max(std::abs(slope_x), std::abs(slope_y));
  return state.offset.factor * m + state.offset.units * polygon_offset_unit(state.format, std::max({z0, z1, z2}));
}

}  // namespace

BarycentricPlanes planes_of(const WindowTriangle<float>& triangle, int x0, int y0) {
  if (triangle.corners < 3) return along_line(triangle, {x0 + 0.5, y0 + 0.5});
  const glm::dvec2 anchor(x0 + 0.5, y0 + 0.5);
  const AffinePlanes<double> p = planes_through(corners_of(triangle), anchor.x, anchor.y);
  return {anchor.x, anchor.y, p.l1_0, p.l1_x, p.l1_y, p.l2_0, p.l2_x, p.l2_y};
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
