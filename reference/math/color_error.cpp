#include "reference/math/color_error.h"

#include <algorithm>
#include <cmath>

#include "reference/math/project.h"

namespace plumbline::math {

namespace {

/// |m| |v|: what the sums' terms come to by their absolute values.
glm::dvec3 terms(const glm::dmat3& m, glm::dvec3 v) {
  return glm::abs(m[0] * v.x) + glm::abs(m[1] * v.y) + glm::abs(m[2] * v.z);
}
double place_error(const glm::dmat4& m,
                   glm::dvec3 p) {  // entries 1, product 3, and 2 spare for the matrix' own product
  return 6 * kFloatRounding * glm::length(terms(glm::dmat3(m), p) + glm::abs(glm::dvec3(m[3])));
}

double largest(const glm::vec4& material, const glm::vec3& light) {
  const glm::vec3 c = glm::abs(glm::vec3(material) * light);
  return std::max({c.r, c.g, c.b});
}

/// How far x^s moves where x, in [0,1], moves by `error`: the slope is at most s, and for s < 1 the difference of
/// powers at most the power of the difference. A float pow: 32 u.
double power_error(double s, double error) {
  if (s == 0) return 0;
  return std::min(1.0, (s < 1 ? std::pow(error, s) : s * error) + 32 * kFloatRounding);
}

}  // namespace

// N: matrix entries 1 u, sum 3 u of its terms, normalising 3 u. L: the same of the light's place and the point's over
// their distance. H = (L + z)/|L + z|: L's error over |L + z|, and 4 u. Dot products: the errors' sum and 3 u. Where
// N.L may fall on either side of 0, the whole specular term may come or go. 16 u of the sum for the additions.
double color_error(const Scene& scene, const Draw& draw, const Matrices<double>& m, const glm::dmat4& view,
                   std::uint32_t vertex) {
  constexpr double u = kFloatRounding;
  if (!draw.lit) return u;
  const Mesh& mesh = scene.meshes[draw.mesh];
  const glm::dvec3 p(mesh.positions[vertex]), normal(mesh.normals[vertex]);
  const glm::dvec3 p_eye(m.model_view * glm::dvec4(p, 1)), n_scaled = m.normal * normal;
  const glm::dvec3 n = glm::normalize(n_scaled);
  const double n_error = u * (4 * glm::length(terms(m.normal, normal)) / glm::length(n_scaled) + 3);
  const Material& material = draw.material;
  double error = 0;
  double sum = largest(material.emission, glm::vec3(1)) + largest(material.ambient, scene.ambient);
  for (const Light& light : scene.lights) {
    const bool at_place = light.kind == Light::Kind::point;
    const glm::dvec3 to_light =
        at_place ? glm::dvec3(view * glm::dvec4(light.vector, 1)) - p_eye : glm::dmat3(view) * light.vector;
    const double distance = glm::length(to_light);
    const double moved = at_place ? place_error(view, light.vector) + place_error(m.model_view, p)
                                  : 6 * u * glm::length(terms(glm::dmat3(view), light.vector));
    if (!(distance > 2 * moved)) return 1;
    const glm::dvec3 l = to_light / distance;
    const double l_error = moved / distance + 4 * u, bisector = glm::length(l + glm::dvec3(0, 0, 1));
    const double h_error = bisector > 4 * l_error ? 2 * l_error / bisector + 4 * u : 1;
    const double dot_error = n_error + l_error + 3 * u, n_dot_l = glm::dot(n, l);
    const double diffuse = largest(material.diffuse, light.diffuse);
    const double specular = largest(material.specular, light.specular);
    error += diffuse * dot_error;
    if (n_dot_l > -dot_error) error += specular * power_error(material.shininess, n_error + h_error + 3 * u);
    if (std::abs(n_dot_l) <= dot_error) error += specular;
    sum += largest(material.ambient, light.ambient) + diffuse + specular;
  }
  return std::min(1.0, error + 16 * u * sum);
}

}  // namespace plumbline::math
