#include "scene/mesh/mesh_solids.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "scene/mesh/mesh_shapes.h"

namespace plumbline {
namespace {

std::uint32_t index_of(std::size_t i) { return static_cast<std::uint32_t>(i); }

/// The middle of an edge on the unit sphere: one vertex for both triangles at the edge.
class Middles {
 public:
  explicit Middles(std::vector<glm::dvec3>& positions) : positions_(positions) {}
  std::uint32_t operator()(std::uint32_t a, std::uint32_t b) {
    const auto [at, made] = made_.try_emplace(std::minmax(a, b), index_of(positions_.size()));
    if (made) positions_.push_back(glm::normalize(positions_[a] + positions_[b]));
    return at->second;
  }

 private:
  std::vector<glm::dvec3>& positions_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made_;
};

/// Adds the 2 * `around` triangles between two rings of `around` vertices that begin at `first` and `next`:
/// counter-clockwise from outside if each ring runs counter-clockwise as seen looking from `next` to `first`.
void add_band(std::vector<glm::uvec3>& triangles, std::uint32_t first, std::uint32_t next, int around) {
  for (int i = 0; i < around; ++i) {
    const auto a = static_cast<std::uint32_t>(i), b = static_cast<std::uint32_t>((i + 1) % around);
    triangles.emplace_back(first + a, first + b, next + b);
    triangles.emplace_back(first + a, next + b, next + a);
  }
}

}  // namespace

Mesh make_cube() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const std::uint32_t first = index_of(mesh.positions.size());
      glm::vec3 normal(0), u(0), v(0);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = side;  // u x v is the normal
      for (const glm::vec2 at : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        mesh.positions.push_back(normal + at.x * u + at.y * v);
        mesh.normals.push_back(normal);
        mesh.texcoords.push_back(0.5f * (at + 1.0f));
      }
      mesh.triangles.emplace_back(first, first + 1, first + 2);
      mesh.triangles.emplace_back(first, first + 2, first + 3);
    }
  }
  return mesh;
}

Mesh make_icosphere(int subdivisions) {
  const double g = std::numbers::phi;
  std::vector<glm::dvec3> positions{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::dvec3& p : positions) p = glm::normalize(p);
  Mesh mesh;
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int round = 0; round < subdivisions; ++round) {
    Middles middle(positions);
    std::vector<glm::uvec3> smaller;
    smaller.reserve(4 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
      const std::uint32_t xy = middle(t.x, t.y), yz = middle(t.y, t.z), zx = middle(t.z, t.x);
      smaller.emplace_back(t.x, xy, zx);
      smaller.emplace_back(xy, t.y, yz);
      smaller.emplace_back(zx, yz, t.z);
      smaller.emplace_back(xy, yz, zx);
    }
    mesh.triangles = std::move(smaller);
  }
  mesh.positions.assign(positions.begin(), positions.end());
  mesh.normals = mesh.positions;
  return mesh;
}

Mesh make_torus_knot(const TorusKnot& knot) {
  constexpr double kRing = 0.6, kThickness = 0.25;
  Mesh mesh;
  for (int s = 0; s < knot.segments; ++s) {
    const double turn = 2 * std::numbers::pi * s / knot.segments, around = knot.p * turn, through = knot.q * turn;
    const glm::dvec3 outward(std::cos(around), std::sin(around), 0), along(-outward.y, outward.x, 0), up(0, 0, 1);
    // The torus' normal and the curve's tangent make a frame that closes after one round without a twist to correct.
    const glm::dvec3 normal = std::cos(through) * outward + std::sin(through) * up;
    const double from_axis = kRing + kThickness * std::cos(through);
    const glm::dvec3 tangent = glm::normalize(
        knot.p * from_axis * along + knot.q * kThickness * (std::cos(through) * up - std::sin(through) * outward));
    const glm::dvec3 across = glm::cross(tangent, normal);
    const glm::dvec3 middle = kRing * outward + kThickness * normal;
    for (int i = 0; i < knot.sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / knot.sides;
      const glm::dvec3 out = std::cos(angle) * normal + std::sin(angle) * across;
      mesh.positions.emplace_back(middle + knot.tube * out);
      mesh.normals.emplace_back(out);
    }
  }
  for (int s = 0; s < knot.segments; ++s) {
    add_band(mesh.triangles, index_of(static_cast<std::size_t>(s * knot.sides)),
             index_of(static_cast<std::size_t>((s + 1) % knot.segments * knot.sides)), knot.sides);
  }
  return mesh;
}

std::vector<glm::dvec2> bezier_profile(std::span<const glm::dvec2> control, int steps) {
  std::vector<glm::dvec2> profile{control.front()};
  for (std::size_t c = 0; c + 3 < control.size(); c += 3) {
    for (int i = 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps, s = 1 - t;
      profile.push_back(s * s * s * control[c] + 3 * s * s * t * control[c + 1] + 3 * s * t * t * control[c + 2] +
                        t * t * t * control[c + 3]);
    }
  }
  return profile;
}

Mesh make_revolution(std::span<const glm::dvec2> profile, int slices) {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> rings;  // where each ring begins; a tip is a ring of one
  for (const glm::dvec2& point : profile) {
    rings.push_back(index_of(positions.size()));
    for (int i = 0; i < (point.x > 0 ? slices : 1); ++i) {
      const double angle = 2 * std::numbers::pi * i / slices;
      positions.emplace_back(point.x * std::sin(angle), point.y, point.x * std::cos(angle));
    }
  }
  std::vector<glm::uvec3> triangles;
  for (std::size_t r = 0; r + 1 < profile.size(); ++r) {
    const bool from_tip = !(profile[r].x > 0), to_tip = !(profile[r + 1].x > 0);
    if (!from_tip && !to_tip) {
      add_band(triangles, rings[r], rings[r + 1], slices);
      continue;
    }
    if (from_tip && to_tip) continue;  // a line along the axis
    for (int i = 0; i < slices; ++i) {
      const auto a = static_cast<std::uint32_t>(i), b = static_cast<std::uint32_t>((i + 1) % slices);
      if (from_tip)
        triangles.emplace_back(rings[r], rings[r + 1] + b, rings[r + 1] + a);
      else
        triangles.emplace_back(rings[r] + a, rings[r] + b, rings[r + 1]);
    }
  }
  return make_triangles(std::move(positions), std::move(triangles), {});
}

}  // namespace plumbline
