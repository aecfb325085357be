#include "reference/math/light.h"

#include <algorithm>
#include <cmath>

namespace plumbline::math {
namespace {

glm::dvec3 unit(glm::dvec3 v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

/// From the point towards the light, unit length: the specification's VP.
glm::dvec3 towards(const Light& light, const glm::dmat4& view, glm::dvec3 p_eye) {
  if (light.kind == Light::Kind::directional) return unit(glm::dmat3(view) * light.vector);
  return unit(glm::dvec3(view * glm::dvec4(light.vector, 1)) - p_eye);
}

}  // namespace

glm::dvec4 light(const Scene& scene, const Draw& draw, const glm::dmat4& view, glm::dvec3 p_eye, glm::dvec3 n_eye) {
  const Material& material = draw.material;
  const glm::dvec3 ambient(material.ambient), diffuse(material.diffuse), specular(material.specular);
  glm::dvec3 rgb = glm::dvec3(material.emission) + ambient * glm::dvec3(scene.ambient);
  for (const Light& source : scene.lights) {
    const glm::dvec3 to_light = towards(source, view, p_eye);
    const double n_dot_vp = glm::dot(n_eye, to_light);
    rgb += ambient * glm::dvec3(source.ambient);
    if (!(n_dot_vp > 0)) continue;  // the diffuse term is clamped to 0, and the specular one has f = 0
    rgb += n_dot_vp * diffuse * glm::dvec3(source.diffuse);
    const glm::dvec3 half = unit(to_light + glm::dvec3(0, 0, 1));
    const double n_dot_h = std::max(0.0, glm::dot(n_eye, half));
    rgb += std::pow(n_dot_h, static_cast<double>(material.shininess)) * specular * glm::dvec3(source.specular);
  }
  return glm::clamp(glm::dvec4(rgb, material.diffuse.a), 0.0, 1.0);
}

glm::dvec4 vertex_color(const Scene& scene, const Draw& draw, const glm::dmat4& view, std::uint32_t vertex,
                        glm::dvec3 p_eye, glm::dvec3 n_eye) {
  if (draw.lit) return light(scene, draw, view, p_eye, n_eye);
  const Mesh& mesh = scene.meshes.at(draw.mesh);
  const glm::dvec4 color(mesh.colors.empty() ? draw.material.diffuse : mesh.colors.at(vertex));
  return glm::clamp(color, 0.0, 1.0);
}

}  // namespace plumbline::math
