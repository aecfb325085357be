#include "reference/exact/fragments.h"

#include <algorithm>
#include <cmath>

#include "reference/arithmetic/passes.h"
#include "reference/arithmetic/polygon_offset.h"
#include "reference/exact/input.h"

namespace plumbline::exact {
namespace {

/// OpenGL 2.1 spec, equations 3.10 to 3.13: m the larger of |dz/dx|, |dz/dy|.
long double polygon_offset(DepthFormat format, const Conventions& by, const PolygonOffset& offset,
                           const WindowTriangle<double>& triangle, const Barycentric& weights) {
  if (triangle.corners < 3 || offset == PolygonOffset{}) return 0;
  const double z0 = triangle.v[0].p_win.z, z1 = triangle.v[1].p_win.z, z2 = triangle.v[2].p_win.z;
  const auto slope = weights.slope(z1 - z0, z2 - z0);
  const auto size = [](Float128 v) { return static_cast<long double>(v < 0 ? -v : v); };
  const long double m = std::max(size(slope[0]), size(slope[1]));
  return m * offset.factor + math::offset_unit(format, by, std::max({z0, z1, z2})) * offset.units;
}

}  // namespace

// GL 4.5 compatibility, section 17.3.6: depth clamp clamps to glDepthRange's range, whichever end is the larger.
DepthRule depth_rule(const Scene& scene, const Draw& draw, const WindowTriangle<double>& triangle,
                     const Barycentric& weights, const Conventions& by) {
  DepthRule rule;
  rule.place = math::sample_offset(scene.frame);
  rule.offset = polygon_offset(scene.frame.depth, by, draw.polygon_offset, triangle, weights);
  if (!scene.depth_clamp) return rule;
  const double near = draw.depth_range.near, far = draw.depth_range.far;
  rule.low = std::min(near, far);
  rule.high = std::max(near, far);
  return rule;
}

double depth_at(const WindowTriangle<double>& triangle, const Barycentric& weights, const DepthRule& rule, int x,
                int y) {
  const auto b = weights.at(x, y, rule.place);
  // Depths relative to the first corner's: the weights then sum to 1 exactly, and a triangle of one depth has exactly
  // that depth.
  const long double z0 = triangle.v[0].p_win.z;
  const long double z = rule.offset + z0 + b[1] * (triangle.v[1].p_win.z - z0) + b[2] * (triangle.v[2].p_win.z - z0);
  return std::clamp(static_cast<double>(z), rule.low, rule.high);
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

std::vector<double> fragment_depths(const Scene& scene, const Records<double>& records, const Conventions& by) {
  std::vector<double> depth;
  depth.reserve(records.covered.size());
  const DrawOf draw_of(scene);
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const WindowTriangle<double>& triangle = records.triangles[run.triangle];
    const Barycentric weights(triangle, scene.frame.width, scene.frame.height);
    const DepthRule rule = depth_rule(scene, draw_of(triangle.primitive), triangle, weights, by);
    for (std::size_t i = run.first; i < run.last; ++i)
      depth.push_back(depth_at(triangle, weights, rule, records.covered[i].x, records.covered[i].y));
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
