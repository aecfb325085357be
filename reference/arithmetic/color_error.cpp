#include "reference/arithmetic/color_error.h"

#include <algorithm>
#include <cmath>

#include "reference/arithmetic/bounded.h"
#include "reference/arithmetic/light_bounds.h"

namespace plumbline::math {

namespace {

/// |m| |v|: per component, the sum of the absolute values of the terms of m v.
glm::dvec3 terms(const glm::dmat3& m, glm::dvec3 v) {
  return glm::abs(m[0] * v.x) + glm::abs(m[1] * v.y) + glm::abs(m[2] * v.z);
}
// Length of the error of m p: 6 u of its terms, of which the entries take 1, the product 3, the matrix' own product 2.
double place_error(const glm::dmat4& m, glm::dvec3 p) {
  return 6 * kFloatRounding * glm::length(terms(glm::dmat3(m), p) + glm::abs(glm::dvec3(m[3])));
}

}  // namespace

BoundedVector unit(const BoundedVector& a) {
  const double length = glm::length(a.v);
  if (!(length > 2 * a.error)) return {{0, 0, 1}, 2};
  return {a.v / length, chord(a.error / length) + 4 * kFloatRounding};
}

BoundedVector eye_position(const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex) {
  const glm::dvec3 p(mesh.positions[vertex]);
  return {glm::dvec3(m.model_view * glm::dvec4(p, 1)), place_error(m.model_view, p)};
}

// Error: 4 u of the product's terms (entries 1, sum 3); 3 u of the length by normalising, or 6 u by rescaling's
// divisor.
BoundedVector eye_normal(const Draw& draw, const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex) {
  const glm::dvec3 normal(mesh.normals[vertex]), scaled = m.normal * normal;
  const glm::dvec3 n = normal_in_eye_space(draw.normals, m.normal, normal);
  const double sum = 4 * glm::length(terms(m.normal, normal)) * glm::length(n) / glm::length(scaled);
  return {n, kFloatRounding * (sum + (draw.normals == Normals::rescale ? 6 : 3) * glm::length(n))};
}

std::vector<double> light_errors(const Scene& scene, const glm::dmat4& view) {
  std::vector<double> out;
  for (const Light& light : scene.lights) {
    const bool point = light.kind == Light::Kind::point;
    out.push_back(place_error(point ? view : glm::dmat4(glm::dmat3(view)), light.vector));
  }
  return out;
}

double color_error(const LitDraw& lit, const Matrices<double>& m, std::span<const double> light_errors,
                   std::uint32_t vertex, LitPart part) {
  const auto& [scene, draw, lights] = lit;
  if (!is_lit_per_vertex(draw)) return kFloatRounding;
  const Mesh& mesh = scene.meshes[draw.mesh];
  const BoundedVector p = eye_position(mesh, m, vertex), n = eye_normal(draw, mesh, m, vertex);
  return light_error(scene, material_at(scene, draw, part, vertex),
                     {glm::dvec4(p.v, 1), glm::dvec4(0), part.back ? -n.v : n.v}, {p.error, n.error, 0, light_errors},
                     lights);
}

}  // namespace plumbline::math
