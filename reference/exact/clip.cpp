#include "reference/exact/clip.h"

#include <algorithm>
#include <cmath>

#include "reference/arithmetic/draw_ranges.h"
#include "reference/exact/input.h"

namespace plumbline::exact {
namespace {

using Polygon = std::vector<ClipVertex<double>>;

ClipVertex<double> cut(const ClipVertex<double>& in, const ClipVertex<double>& out, const glm::dvec4& plane) {
  const double d_in = glm::dot(plane, in.p_clip), d_out = glm::dot(plane, out.p_clip);
  const double t = d_in / (d_in - d_out);
  return {
      .p_clip = in.p_clip + t * (out.p_clip - in.p_clip), .color = in.color + t * (out.color - in.color), .cut = true};
}

Polygon cut_by(const Polygon& polygon, const glm::dvec4& plane) {
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex<double>& a = polygon[i];
    const ClipVertex<double>& b = polygon[(i + 1) % polygon.size()];
    const bool a_in = glm::dot(plane, a.p_clip) >= 0, b_in = glm::dot(plane, b.p_clip) >= 0;
    if (a_in) left.push_back(a);
    if (a_in && !b_in) left.push_back(cut(a, b, plane));
    if (!a_in && b_in) left.push_back(cut(b, a, plane));
  }
  return left;
}

bool finite(const glm::dvec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

}  // namespace

glm::dvec4 clip_plane(int index) {
  glm::dvec4 plane(0, 0, 0, 1);
  switch (index) {
    case 0: plane.x = -1; break;
    case 1: plane.x = 1; break;
    case 2: plane.y = -1; break;
    case 3: plane.y = 1; break;
    case 4: plane.z = 1; break;
    case 5: plane.z = -1; break;
    default: require_index("a clip plane", static_cast<std::size_t>(index), kPlanes);
  }
  return plane;
}

std::vector<ClipVertex<double>> clip_triangle(const std::array<ClipVertex<double>, 3>& corners, int planes) {
  Polygon polygon(corners.begin(), corners.end());
  for (int i = 0; i < planes; ++i) {
    const glm::dvec4 plane = clip_plane(i);
    if (std::any_of(corners.begin(), corners.end(), [&](const auto& v) { return glm::dot(plane, v.p_clip) < 0; }))
      polygon = cut_by(polygon, plane);
  }
  return polygon;
}

std::vector<ClipVertex<double>> clip_line(const ClipVertex<double>& a, const ClipVertex<double>& b, int planes) {
  double first = 0, last = 1;
  for (int i = 0; i < planes; ++i) {
    const glm::dvec4 plane = clip_plane(i);
    const double d_a = glm::dot(plane, a.p_clip), d_b = glm::dot(plane, b.p_clip);
    if (d_a < 0 && d_b < 0) return {};
    if (d_a < 0) first = std::max(first, d_a / (d_a - d_b));
    if (d_b < 0) last = std::min(last, d_a / (d_a - d_b));
  }
  if (first >= last) return {};
  const auto at = [&](double t) -> ClipVertex<double> {
    return {.p_clip = glm::mix(a.p_clip, b.p_clip, t), .color = glm::mix(a.color, b.color, t), .cut = true};
  };
  return {first > 0 ? at(first) : a, last < 1 ? at(last) : b};
}

namespace {

Polygon clip_primitive(Topology topology, const std::array<ClipVertex<double>, 3>& corners, int planes) {
  if (topology == Topology::triangles) return clip_triangle(corners, planes);
  if (topology == Topology::lines) return clip_line(corners[0], corners[1], planes);
  for (int i = 0; i < planes; ++i)
    if (glm::dot(clip_plane(i), corners[0].p_clip) < 0) return {};
  return {corners[0]};
}

}  // namespace

ClipPolygons<double> clip_primitives(const Scene& scene, const std::vector<Vertex<double>>& vertices,
                                     const std::vector<Lit<double>>& lit, bool flat_applies) {
  require_size("records.lit", lit.size(), vertices.size());
  const std::vector<DrawRange> ranges = math::ranges_of_draws(scene);
  ClipPolygons<double> out;
  for (std::size_t d = 0; d < scene.draws.size(); ++d) {
    const std::vector<glm::uvec3>& triangles = scene.meshes.at(scene.draws[d].mesh).triangles;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      std::array<ClipVertex<double>, 3> corners;
      for (int i = 0; i < 3; ++i) {
        const std::size_t v = ranges[d].first_vertex + triangles[t][i];
        require_index("a triangle's corner", v, vertices.size());
        corners[static_cast<std::size_t>(i)] = {vertices[v].p_clip, lit[v].color, false};
      }
      if (!std::all_of(corners.begin(), corners.end(), [](const auto& v) { return finite(v.p_clip); })) continue;
      if (flat_applies && scene.draws[d].shading == Shading::flat)
        corners[0].color = corners[1].color = corners[2].color;
      const Polygon polygon =
          clip_primitive(scene.meshes[scene.draws[d].mesh].topology, corners, scene.depth_clamp ? kSides : kPlanes);
      if (polygon.empty()) continue;
      out.polygons.push_back({.primitive = ranges[d].first_primitive + t,
                              .first = static_cast<std::uint32_t>(out.vertices.size()),
                              .count = static_cast<std::uint32_t>(polygon.size())});
      out.vertices.insert(out.vertices.end(), polygon.begin(), polygon.end());
    }
  }
  return out;
}

}  // namespace plumbline::exact
