#include "pipeline/depth.h"

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

}  // namespace

BarycentricPlanes planes_of(const WindowTriangle<float>& triangle, int x0, int y0) {
  if (triangle.corners < 3) return along_line(triangle, {x0 + 0.5, y0 + 0.5});
  glm::dvec2 p[3];
  for (int i = 0; i < 3; ++i) p[i] = glm::dvec2(triangle.v[static_cast<std::size_t>(i)].p_win);
  double twice_area = cross(p[1] - p[0], p[2] - p[0]);
  if (!(triangle.front ? twice_area > 0 : twice_area < 0)) {
    for (int i = 0; i < 3; ++i) p[i] = glm::dvec2(triangle.v[static_cast<std::size_t>(i)].snapped) / 256.0 + 0.5;
    twice_area = cross(p[1] - p[0], p[2] - p[0]);
  }
  const glm::dvec2 anchor(x0 + 0.5, y0 + 0.5), d1 = p[1] - p[0], d2 = p[2] - p[0], d = anchor - p[0];
  return {anchor.x,           anchor.y,           cross(d, d2) / twice_area,
          d2.y / twice_area,  -d2.x / twice_area, cross(d1, d) / twice_area,
          -d1.y / twice_area, d1.x / twice_area};
}

BarycentricPlanes moved(const BarycentricPlanes& planes, glm::ivec2 place) {
  if (place == glm::ivec2(0)) return planes;
  const glm::dvec2 by = glm::dvec2(place) / static_cast<double>(kSubpixel);
  BarycentricPlanes out = planes;
  out.x0 -= by.x;
  out.y0 -= by.y;
  return out;
}

DepthSetup depth_setup(const WindowTriangle<float>& triangle, double scale) {
  const double z0 = triangle.v[0].p_win.z;
  return {z0, triangle.v[1].p_win.z - z0, triangle.v[2].p_win.z - z0, scale};
}

DepthSetup moved(const DepthSetup& depth, const BarycentricPlanes& planes, glm::ivec2 place) {
  if (place == glm::ivec2(0)) return depth;
  const glm::dvec2 by = glm::dvec2(place) / static_cast<double>(kSubpixel);
  DepthSetup out = depth;
  out.z0 += (by.x * planes.l1_x + by.y * planes.l1_y) * out.dz1 + (by.x * planes.l2_x + by.y * planes.l2_y) * out.dz2;
  return out;
}

}  // namespace plumbline::pipeline
