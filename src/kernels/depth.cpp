#include "kernels/depth.h"

#include <algorithm>
#include <cmath>

namespace plumbline::pipeline {

namespace {

PlaneCorners<double> corners_of(const WindowTriangle& t) {
  const auto& v = t.v;
  return plane_corners<float>({v[0].p_win.x, v[1].p_win.x, v[2].p_win.x}, {v[0].p_win.y, v[1].p_win.y, v[2].p_win.y},
                              {v[0].snapped.x, v[1].snapped.x, v[2].snapped.x},
                              {v[0].snapped.y, v[1].snapped.y, v[2].snapped.y}, t.front ? 1.0 : -1.0);
}

// Polygon offset of a window triangle, line or point [window z]; 0 for lines and points.
double offset_of(const WindowTriangle& triangle, const DepthState& state) {
  if (triangle.corners < 3 || state.offset == PolygonOffset{}) return 0;
  const double z0 = triangle.v[0].p_win.z, z1 = triangle.v[1].p_win.z, z2 = triangle.v[2].p_win.z;
  const PlaneCorners<double> c = corners_of(triangle);
  const double slope_x = difference_of_products(z1 - z0, c.d2_y, z2 - z0, c.d1_y) / c.twice_area;
  const double slope_y = difference_of_products(z2 - z0, c.d1_x, z1 - z0, c.d2_x) / c.twice_area;
  const double m = std::max(std::abs(slope_x), std::abs(slope_y));
  return state.offset.factor * m + state.offset.units * polygon_offset_unit(state.format, std::max({z0, z1, z2}));
}

}  // namespace

BarycentricPlanes planes_of(const WindowTriangle& triangle, int x0, int y0) {
  const double x = x0 + 0.5, y = y0 + 0.5;
  if (triangle.corners == 3) return {corner_planes(corners_of(triangle), x, y), {x, y}};
  const glm::dvec2 p0(triangle.v[0].p_win), p1(triangle.v[1].p_win);
  PlaneCorners<double> line = line_corners(p0.x, p0.y, p1.x, p1.y);  // a point has no slopes
  if (line.twice_area == 0) line = {line.p0_x, line.p0_y, 0, 0, 0, 0, 1};
  BarycentricPlanes planes{corner_planes(line, x, y), {x, y}};
  planes.l2 = {0, 0, 0};
  return planes;
}

BarycentricPlanes at_offset(const BarycentricPlanes& planes, glm::ivec2 offset) {
  if (offset == glm::ivec2(0)) return planes;
  const glm::dvec2 by = glm::dvec2(offset) / static_cast<double>(kSubpixel);
  return {planes, {planes.x0 - by.x, planes.y0 - by.y}};
}

DepthState depth_state(const Draw& draw, DepthFormat format, bool depth_clamp) {
  if (!depth_clamp) return {format, 0, 1, draw.polygon_offset};
  const auto [low, high] = std::minmax(draw.depth_range.near, draw.depth_range.far);
  return {format, low, high, draw.polygon_offset};
}

DepthSetup depth_setup(const WindowTriangle& triangle, const DepthState& state) {
  const double z0 = triangle.v[0].p_win.z;
  return {z0 + offset_of(triangle, state),
          triangle.v[1].p_win.z - z0,
          triangle.corners == 3 ? triangle.v[2].p_win.z - z0 : 0,
          depth_scale(state.format),
          state.low,
          state.high};
}

DepthPlane depth_plane(const DepthSetup& depth, const CornerPlanes<double>& planes) {
  const double unit = depth.scale == 0 ? 1 : depth.scale;
  return {planes.through(depth.z0 * unit, depth.dz1 * unit, depth.dz2 * unit), depth.scale, depth.low * unit,
          depth.high * unit};
}

DepthPlane at_offset(const DepthPlane& depth, glm::ivec2 offset) {
  if (offset == glm::ivec2(0)) return depth;
  const glm::dvec2 by = glm::dvec2(offset) / static_cast<double>(kSubpixel);
  DepthPlane out = depth;
  out.code.at_0 += by.x * out.code.x + by.y * out.code.y;
  return out;
}

}  // namespace plumbline::pipeline
