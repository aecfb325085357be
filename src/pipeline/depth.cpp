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

double area(const glm::dvec2 (&p)[3]) {
  return difference_of_products(p[1].x - p[0].x, p[2].y - p[0].y, p[1].y - p[0].y, p[2].x - p[0].x);
}

}  // namespace

BarycentricPlanes planes_of(const WindowTriangle<float>& triangle) {
  glm::dvec2 p[3];
  for (int i = 0; i < 3; ++i) p[i] = glm::dvec2(triangle.v[static_cast<std::size_t>(i)].p_win);
  double twice_area = area(p);
  if (!(triangle.front ? twice_area > 0 : twice_area < 0)) {
    for (int i = 0; i < 3; ++i) p[i] = glm::dvec2(triangle.v[static_cast<std::size_t>(i)].snapped) / 256.0 + 0.5;
    twice_area = area(p);
  }
  return {p[0].x,
          p[0].y,
          (p[2].y - p[0].y) / twice_area,
          (p[0].x - p[2].x) / twice_area,
          (p[0].y - p[1].y) / twice_area,
          (p[1].x - p[0].x) / twice_area};
}

DepthSetup depth_setup(const WindowTriangle<float>& triangle, double scale) {
  const double z0 = triangle.v[0].p_win.z;
  return {z0, triangle.v[1].p_win.z - z0, triangle.v[2].p_win.z - z0, scale};
}

}  // namespace plumbline::pipeline
