#include "pipeline/clip.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::pipeline {

namespace {

constexpr std::array<Vec4<float>, 6> kPlanes = {Vec4<float>(-1, 0, 0, 1), Vec4<float>(1, 0, 0, 1),
                                                Vec4<float>(0, -1, 0, 1), Vec4<float>(0, 1, 0, 1),
                                                Vec4<float>(0, 0, 1, 1),  Vec4<float>(0, 0, -1, 1)};

float distance_to(const Vec4<float>& plane, const Vec4<float>& p) {
  return ((p.x * plane.x + p.y * plane.y) + p.z * plane.z) + p.w * plane.w;
}

// A plane adds one vertex to a convex polygon. Rounding may make one cross a plane many times: each run of vertices
// outside becomes two, so that six planes make 3, 4, 6, 9, 13, 19, 28 vertices at most.
struct Polygon {
  std::array<ClipVertex<float>, 28> v;
  int count = 0;
  void add(const ClipVertex<float>& vertex) { v[static_cast<std::size_t>(count++)] = vertex; }
};

ClipVertex<float> cut(const ClipVertex<float>& a, float d_a, const ClipVertex<float>& b, float d_b) {
  const float t = d_a / (d_a - d_b);
  return {a.p_clip + t * (b.p_clip - a.p_clip), a.color + t * (b.color - a.color), true};
}

Polygon cut_by(const Vec4<float>& plane, const Polygon& in) {
  Polygon out;
  for (int i = 0; i < in.count; ++i) {
    const ClipVertex<float>& from = in.v[static_cast<std::size_t>(i)];
    const ClipVertex<float>& to = in.v[static_cast<std::size_t>((i + 1) % in.count)];
    const float d_from = distance_to(plane, from.p_clip), d_to = distance_to(plane, to.p_clip);
    if (d_from >= 0) out.add(from);
    if ((d_from >= 0) == (d_to >= 0)) continue;
    const bool from_inside = d_from >= 0;
    const float d_in = from_inside ? d_from : d_to, d_out = from_inside ? d_to : d_from;
    const bool start_outside = -d_out < d_in;
    out.add(start_outside == from_inside ? cut(to, d_to, from, d_from) : cut(from, d_from, to, d_to));
  }
  return out;
}

// A line's two vertices, or none: each end is moved by the largest of the shares that the planes cut off there.
Polygon cut_line(std::span<const Vec4<float>> planes, const Polygon& line) {
  const ClipVertex<float>&a = line.v[0], &b = line.v[1];
  float from_a = 0, from_b = 0;
  for (const Vec4<float>& plane : planes) {
    const float d_a = distance_to(plane, a.p_clip), d_b = distance_to(plane, b.p_clip);
    if (d_b < 0) from_b = std::max(from_b, d_b / (d_b - d_a));
    if (d_a < 0) from_a = std::max(from_a, d_a / (d_a - d_b));
  }
  Polygon out;
  if (from_a + from_b >= 1) return out;
  const auto moved = [](const ClipVertex<float>& v, const ClipVertex<float>& towards, float t) -> ClipVertex<float> {
    return {v.p_clip + t * (towards.p_clip - v.p_clip), v.color + t * (towards.color - v.color), true};
  };
  out.add(from_a > 0 ? moved(a, b, from_a) : a);
  out.add(from_b > 0 ? moved(b, a, from_b) : b);
  return out;
}

// One bit per plane that the vertex violates.
unsigned outcode(std::span<const Vec4<float>> planes, const Vec4<float>& p) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!(distance_to(planes[i], p) >= 0)) bits |= 1u << i;
  }
  return bits;
}

bool finite(const Vec4<float>& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
}

}  // namespace

std::span<const Vec4<float>, 6> view_volume() { return kPlanes; }

void clip(const Assembly& assembly, ClipPolygons<float>& out) {
  constexpr std::size_t kSides = 4;
  clip_at(std::span(kPlanes).first(assembly.depth_clamp ? kSides : kPlanes.size()), assembly, out);
}

void clip_at(std::span<const Vec4<float>> planes, const Assembly& assembly, ClipPolygons<float>& out) {
  const auto count = static_cast<int>(corner_count(assembly.topology));
  for (std::size_t i = 0; i < assembly.triangles.size(); ++i) {
    const glm::uvec3 corners = assembly.triangles[i];
    Polygon polygon;
    unsigned violated = 0, violated_by_all = ~0u;
    bool drop = false;
    for (int k = 0; k < count; ++k) {
      const std::uint32_t provoking = assembly.shading == Shading::flat ? corners[2] : corners[k];
      const Vec4<float>& p_clip = assembly.vertices[corners[k]].p_clip;
      polygon.add({p_clip, assembly.lit[provoking].color, false});
      const unsigned bits = outcode(planes, p_clip);
      violated |= bits;
      violated_by_all &= bits;
      drop |= !finite(p_clip);
    }
    if (drop || violated_by_all != 0) continue;
    if (assembly.topology == Topology::lines && violated != 0) polygon = cut_line(planes, polygon);
    for (std::size_t p = 0; assembly.topology == Topology::triangles && p < planes.size() && polygon.count >= 3; ++p) {
      if ((violated >> p & 1u) != 0) polygon = cut_by(planes[p], polygon);
    }
    if (polygon.count < count) continue;
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.insert(out.vertices.end(), polygon.v.begin(), polygon.v.begin() + polygon.count);
    out.polygons.push_back(
        {assembly.first_primitive + static_cast<std::uint32_t>(i), first, static_cast<std::uint32_t>(polygon.count)});
  }
}

}  // namespace plumbline::pipeline
