#include "rasterizer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace {

struct Point {
  std::int64_t x, y;  // [1/256 pixel]
};

std::int64_t edge(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

// Whether the triangle has the centres on this edge, its interior to the left of it: on a left or a bottom edge.
bool owns(Point a, Point b) {
#ifdef PLANTED_BUG
  return false;
#endif
  return b.y < a.y || (b.y == a.y && b.x > a.x);
}

// Twice the area of a triangle of corners and a point, positive where they are counter-clockwise.
double area_of(const Corner& a, const Corner& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// Channel as a frame of 8 bits holds it, and depth as one of 24.
float stored(double x) { return static_cast<float>(std::nearbyint(std::clamp(x, 0.0, 1.0) * 255) / 255); }
double stored_depth(double z) { return std::nearbyint(std::clamp(z, 0.0, 1.0) * 16777215) / 16777215; }

}  // namespace

Image::Image(int w, int h, const double (&clear)[4], double clear_depth) : width(w), height(h) {
  const std::size_t pixels = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  for (std::size_t i = 0; i < 4 * pixels; ++i) color.push_back(stored(clear[i % 4]));
  depth.assign(pixels, stored_depth(clear_depth));
}

void draw(Image& image, const Corner (&corners)[3]) {
  Point p[3];
  for (int i = 0; i < 3; ++i) p[i] = {std::llrint(corners[i].x * 256), std::llrint(corners[i].y * 256)};
  std::int64_t area = edge(p[0], p[1], p[2]);
  if (area == 0) return;
  int order[3] = {0, 1, 2};
  if (area < 0) std::swap(order[1], order[2]), area = -area;
  const auto at = [&](int i) { return p[order[i % 3]]; };
  // Coverage goes by corners on a grid of 1/256 pixel; what is interpolated, by the corners themselves, unless the grid
  // has turned the triangle over.
  Corner from[3] = {corners[order[0]], corners[order[1]], corners[order[2]]};
  if (!(area_of(from[0], from[1], from[2].x, from[2].y) > 0)) {
    for (int i = 0; i < 3; ++i) {
      from[i].x = static_cast<double>(at(i).x) / 256, from[i].y = static_cast<double>(at(i).y) / 256;
    }
  }
  const double whole = area_of(from[0], from[1], from[2].x, from[2].y);
  const auto limits = [&](auto of, int size) {
    const auto [low, high] = std::minmax({of(p[0]), of(p[1]), of(p[2])});
    return std::pair(std::max<std::int64_t>(low / 256 - 1, 0), std::min<std::int64_t>(high / 256 + 1, size - 1));
  };
  const auto [left, right] = limits([](Point q) { return q.x; }, image.width);
  const auto [bottom, top] = limits([](Point q) { return q.y; }, image.height);
  for (std::int64_t y = bottom; y <= top; ++y) {
    for (std::int64_t x = left; x <= right; ++x) {
      const Point centre{256 * x + 128, 256 * y + 128};
      bool covered = true;
      double z = 0, q = 0, color[4] = {0, 0, 0, 0};
      for (int i = 0; i < 3; ++i) {
        const std::int64_t e = edge(at(i + 1), at(i + 2), centre);
        covered = covered && (e > 0 || (e == 0 && owns(at(i + 1), at(i + 2))));
        const Corner& corner = from[i];
        const double share =
            area_of(from[(i + 1) % 3], from[(i + 2) % 3], static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5) /
            whole;
        z += share * corner.z;
        q += share * corner.inv_w;
        for (int c = 0; c < 4; ++c) color[c] += share * corner.inv_w * corner.color[c];
      }
      const std::size_t pixel = static_cast<std::size_t>(y * image.width + x);
      z = stored_depth(z);
      if (!covered || (image.depth_test && !(z < image.depth[pixel]))) continue;
      image.depth[pixel] = z;
      for (std::size_t c = 0; c < 4; ++c) {
        image.color[4 * pixel + c] = stored(color[c] / q);
      }
    }
  }
}
