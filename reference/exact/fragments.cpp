#include "reference/exact/fragments.h"

#include <algorithm>

#include "reference/exact/input.h"
#include "scene/antialias.h"

namespace plumbline::exact {

double depth_at(const WindowTriangle<double>& triangle, const Barycentric& weights, const FrameFormat& frame, int x,
                int y) {
  const auto b = weights.at(x, y, glm::dvec2(sample_place(frame)) / static_cast<double>(kSubpixel));
  // From the first corner on: the weights' sum of 1 is used in exact form, and a flat triangle's depth is exact.
  const long double z0 = triangle.v[0].p_win.z;
  const long double z = z0 + b[1] * (triangle.v[1].p_win.z - z0) + b[2] * (triangle.v[2].p_win.z - z0);
  return std::clamp(static_cast<double>(z), 0.0, 1.0);
}

glm::dvec4 color_at(const WindowTriangle<double>& triangle, const Barycentric& weights, int x, int y) {
  const auto b = weights.at(x, y);
  glm::vec<4, long double> over_w(0);
  long double one_over_w = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const long double weight = b[i] * triangle.v[i].inv_w;
    over_w += weight * glm::vec<4, long double>(triangle.v[i].color);
    one_over_w += weight;
  }
  return glm::dvec4(over_w / one_over_w);
}

std::vector<double> fragment_depths(const Scene& scene, const Records<double>& records) {
  std::vector<double> depth;
  depth.reserve(records.covered.size());
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const WindowTriangle<double>& triangle = records.triangles[run.triangle];
    const Barycentric weights(triangle, scene.frame.width, scene.frame.height);
    for (std::size_t i = run.first; i < run.last; ++i)
      depth.push_back(depth_at(triangle, weights, scene.frame, records.covered[i].x, records.covered[i].y));
  }
  return depth;
}

std::vector<Attributes<double>> fragment_attributes(const Scene& scene, const Records<double>& records) {
  std::vector<Attributes<double>> attributes;
  attributes.reserve(records.covered.size());
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const WindowTriangle<double>& triangle = records.triangles[run.triangle];
    const Barycentric weights(triangle, scene.frame.width, scene.frame.height);
    for (std::size_t i = run.first; i < run.last; ++i)
      attributes.push_back({color_at(triangle, weights, records.covered[i].x, records.covered[i].y)});
  }
  return attributes;
}

}  // namespace plumbline::exact
