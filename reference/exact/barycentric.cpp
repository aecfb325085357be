#include "reference/exact/barycentric.h"

#include <algorithm>
#include <cmath>

#include "reference/exact/window.h"

namespace plumbline::exact {
namespace {

struct Point {
  Float128 x, y;
};

Float128 cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }

Float128 doubled_area(const std::array<Point, 3>& p) { return cross(p[1] - p[0], p[2] - p[0]); }

std::array<Point, 3> positions(const WindowTriangle<double>& triangle) {
  std::array<Point, 3> unsnapped, snapped;
  for (std::size_t i = 0; i < 3; ++i) {
    const WindowVertex<double>& v = triangle.v[i];
    unsnapped[i] = {v.p_win.x, v.p_win.y};
    snapped[i] = {v.snapped.x / static_cast<double>(kSubpixel) + 0.5,
                  v.snapped.y / static_cast<double>(kSubpixel) + 0.5};
  }
  if (triangle.corners < 3) return unsnapped;
  const Float128 area = doubled_area(unsnapped);
  const auto on_grid = facing(snapped_corners(triangle));
  const bool faces_otherwise = on_grid > 0 ? !(area > 0) : on_grid < 0 && !(area < 0);
  return faces_otherwise ? snapped : unsnapped;
}

}  // namespace

Barycentric::Barycentric(const WindowTriangle<double>& triangle, int width, int height) {
  const std::array<Point, 3> p = positions(triangle);
  const Point e1 = p[1] - p[0], e2 = p[2] - p[0];
  if (triangle.corners == 3) {
    // Weight 1 at q is cross(q - p0, e2) / area, weight 2 is cross(e1, q - p0) / area.
    const Float128 area = doubled_area(p);
    exact_ = {p[0].x, p[0].y, e2.y / area, -e2.x / area, -e1.y / area, e1.x / area};
  } else {
    // Weight 1 at q is dot(q - p0, e1) / dot(e1, e1).
    const Float128 square = e1.x * e1.x + e1.y * e1.y, one_over = square > 0 ? 1 / square : 0;
    exact_ = {p[0].x, p[0].y, e1.x * one_over, e1.y * one_over, 0, 0};
  }
  const auto narrow = [](Float128 v) { return static_cast<long double>(v); };
  rounded_ = {narrow(exact_.x0),    narrow(exact_.y0),    narrow(exact_.d1_dx),
              narrow(exact_.d1_dy), narrow(exact_.d2_dx), narrow(exact_.d2_dy)};

  // Largest term of the sums that make a weight within the triangle's bounding box: a long double has 64 bits.
  const auto [x_min, x_max] = std::minmax({narrow(p[0].x), narrow(p[1].x), narrow(p[2].x)});
  const auto [y_min, y_max] = std::minmax({narrow(p[0].y), narrow(p[1].y), narrow(p[2].y)});
  const long double dx = std::min<long double>(x_max - x_min, width) + 1;
  const long double dy = std::min<long double>(y_max - y_min, height) + 1;
  const long double largest = std::max(std::max(std::abs(rounded_.d1_dx), std::abs(rounded_.d2_dx)) * dx,
                                       std::max(std::abs(rounded_.d1_dy), std::abs(rounded_.d2_dy)) * dy);
  rounded_suffices_ = largest <= 256;
}

template <class T>
std::array<long double, 3> Barycentric::at(const Affine<T>& affine, glm::dvec2 p) {
  const T dx = static_cast<T>(p.x) - affine.x0, dy = static_cast<T>(p.y) - affine.y0;
  const T b1 = affine.d1_dx * dx + affine.d1_dy * dy, b2 = affine.d2_dx * dx + affine.d2_dy * dy;
  return {static_cast<long double>(1 - b1 - b2), static_cast<long double>(b1), static_cast<long double>(b2)};
}

std::array<Float128, 2> Barycentric::slope(double at_second, double at_third) const {
  return {exact_.d1_dx * at_second + exact_.d2_dx * at_third, exact_.d1_dy * at_second + exact_.d2_dy * at_third};
}

std::array<long double, 3> Barycentric::at(int x, int y, glm::dvec2 off) const {
  const glm::dvec2 p = glm::dvec2(x, y) + 0.5 + off;  // exact: a sum of small multiples of 1/256
  return rounded_suffices_ ? at(rounded_, p) : at(exact_, p);
}

}  // namespace plumbline::exact
