#include "pipeline/geometry.h"

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

// Vertex at share t of the way from `v` to `towards`, with its attributes.
ClipVertex lerp(const ClipVertex& v, const ClipVertex& towards, float t) {
  ClipVertex out{v.p_clip + t * (towards.p_clip - v.p_clip), {}, true};
  for (std::size_t i = 0; i < kAttributes; ++i) {
    out.attributes[i] = v.attributes[i] + t * (towards.attributes[i] - v.attributes[i]);
  }
  return out;
}

// Polygon clipped by one plane. The plane adds one vertex to a convex polygon. Rounding may make the polygon cross a
// plane many times; each run of outside vertices becomes two vertices: at most 3, 4, 6, 9, 13, 19, 28 vertices after 0
// to 6 planes (Polygon::kMostCorners).
Polygon cut_by(const Vec4<float>& plane, const Polygon& in) {
  Polygon out{in.primitive, {}};
  for (std::size_t i = 0; i < in.corners.size(); ++i) {
    const ClipVertex& from = in.corners[i];
    const ClipVertex& to = in.corners[(i + 1) % in.corners.size()];
    const float d_from = distance_to(plane, from.p_clip), d_to = distance_to(plane, to.p_clip);
    if (d_from >= 0) out.corners.push_back(from);
    if ((d_from >= 0) == (d_to >= 0)) continue;
    const bool from_inside = d_from >= 0;
    const float d_in = from_inside ? d_from : d_to, d_out = from_inside ? d_to : d_from;
    const bool start_outside = -d_out < d_in;
    out.corners.push_back(start_outside == from_inside ? lerp(to, from, d_to / (d_to - d_from))
                                                       : lerp(from, to, d_from / (d_from - d_to)));
  }
  return out;
}

// Line clipped by the planes; no corners where nothing is left. Each end moves by the largest share that a plane cuts
// off there.
Polygon cut_line(std::span<const Vec4<float>> planes, const Polygon& line) {
  const ClipVertex &a = line.corners[0], &b = line.corners[1];
  float from_a = 0, from_b = 0;
  for (const Vec4<float>& plane : planes) {
    const float d_a = distance_to(plane, a.p_clip), d_b = distance_to(plane, b.p_clip);
    if (d_b < 0) from_b = std::max(from_b, d_b / (d_b - d_a));
    if (d_a < 0) from_a = std::max(from_a, d_a / (d_a - d_b));
  }
  Polygon out{line.primitive, {}};
  if (from_a + from_b >= 1) return out;
  out.corners.push_back(from_a > 0 ? lerp(a, b, from_a) : a);
  out.corners.push_back(from_b > 0 ? lerp(b, a, from_b) : b);
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

Polygon assemble(const DrawInput& input, const glm::uvec3& corners, std::span<const Vertex<float>> vertices,
                 std::span<const Attributes> attributes) {
  Polygon out;
  const auto count = static_cast<int>(corner_count(input.topology));
  for (int k = 0; k < count; ++k) {
    ClipVertex corner{vertices[corners[k]].p_clip, attributes[corners[k]], false};
    if (input.draw->shading == Shading::flat) {
      const Attributes& provoking = attributes[corners[2]];
      corner.attributes.color() = provoking.color();
      for (const Varying v : kAllVaryings) {
        if (is_lit(v)) corner.attributes[v] = provoking[v];
      }
    }
    out.corners.push_back(corner);
  }
  return out;
}

void clip(const DrawInput& input, Polygon& polygon) {
  constexpr std::size_t kSides = 4;
  clip_at(std::span(kPlanes).first(input.depth_clamp ? kSides : kPlanes.size()), polygon);
}

void clip_at(std::span<const Vec4<float>> planes, Polygon& polygon) {
  const std::size_t count = polygon.corners.size();
  unsigned violated = 0, violated_by_all = ~0u;
  bool all_finite = true;
  for (const ClipVertex& corner : polygon.corners) {
    const unsigned bits = outcode(planes, corner.p_clip);
    violated |= bits;
    violated_by_all &= bits;
    all_finite &= finite(corner.p_clip);
  }
  if (!all_finite || violated_by_all != 0) return polygon.corners.clear();
  if (count == 2 && violated != 0) polygon = cut_line(planes, polygon);
  for (std::size_t p = 0; count == 3 && p < planes.size() && polygon.corners.size() >= 3; ++p) {
    if ((violated >> p & 1u) != 0) polygon = cut_by(planes[p], polygon);
  }
  if (polygon.corners.size() < count) polygon.corners.clear();
}

}  // namespace plumbline::pipeline
