#include "reference/arithmetic/light.h"

#include <algorithm>
#include <cmath>

#include "reference/arithmetic/matrices.h"

namespace plumbline::math {
namespace {

glm::dvec3 unit_of(glm::dvec3 v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

/// Vector from the point to the light: the specification's VP, not yet of unit length.
glm::dvec3 towards(const Light& light, const LightSource<double>& source, glm::dvec3 p_eye) {
  const glm::dvec3 place(source.p_eye);
  return light.kind == Light::Kind::directional ? place : place - p_eye;
}

/// att_i * spot_i of the specification.
double share_at(const Light& light, const LightSource<double>& source, glm::dvec3 vp) {
  if (light.kind == Light::Kind::directional) return 1;
  const double d = glm::length(vp);
  const glm::dvec3 k(light.attenuation);
  // The divisor may be 0 for a light at the point itself (open in the specification): limited, so that 1/0 is finite.
  const double attenuation = 1 / std::max(k[0] + k[1] * d + k[2] * d * d, 1e-38);
  if (!light.spot) return attenuation;
  const glm::dvec3 s = unit_of(source.spot_eye);
  const double cosine = glm::dot(-unit_of(vp), s);
  if (cosine < std::cos(glm::radians(light.spot->cutoff_degrees))) return 0;
  return attenuation * std::pow(std::max(0.0, cosine), static_cast<double>(light.spot->exponent));
}

/// Argument of the specular term's power.
double highlight(const LightModel& model, glm::dvec3 n, glm::dvec3 l, glm::dvec3 e) {
  switch (model.specular) {
    case LightModel::Specular::half_vector: return std::max(0.0, glm::dot(n, unit_of(l + e)));
    case LightModel::Specular::reflection: return std::max(0.0, glm::dot(2 * glm::dot(n, l) * n - l, e));
  }
  return 0;
}

/// x^s, limited to 1e300: the power of a long normal may exceed double, and 0 times infinity is NaN. With 1e300, any
/// colour above 1e-200 times any share above 1e-100 exceeds 1, to which the sum is clamped.
double finite_power(double x, double s) { return std::min(std::pow(x, s), 1e300); }

}  // namespace

std::vector<LightSource<double>> light_sources(const Scene& scene) {
  const glm::dmat4 view = view_matrix(scene);
  const glm::dmat3 turned(view);
  std::vector<LightSource<double>> out;
  for (const Light& light : scene.lights) {
    const bool point = light.kind == Light::Kind::point;
    out.push_back({.p_eye = point ? view * glm::dvec4(light.vector, 1) : glm::dvec4(turned * light.vector, 0),
                   .spot_eye = point && light.spot ? turned * light.spot->direction : glm::dvec3(0)});
  }
  return out;
}

glm::dvec4 light(const Scene& scene, const DoubleMaterial& material, Lights lights, glm::dvec3 p_eye,
                 glm::dvec3 n_eye) {
  const LightModel& model = scene.light_model;
  const glm::dvec3 ambient(material.ambient), diffuse(material.diffuse), specular(material.specular);
  const glm::dvec3 to_eye = model.local_viewer ? unit_of(-p_eye) : glm::dvec3(0, 0, 1);
  glm::dvec3 rgb = glm::dvec3(material.emission) + ambient * glm::dvec3(model.ambient);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& source = scene.lights[i];
    const glm::dvec3 vp = towards(source, lights[i], p_eye), to_light = unit_of(vp);
    const double share = share_at(source, lights[i], vp);
    if (!(share > 0)) continue;
    glm::dvec3 n = n_eye;
    if (model.sides == LightModel::Sides::flip && glm::dot(n, to_eye) < 0) n = -n;
    // GzRender's rule: the light counts only on the eye's side (N.L and N.E of one sign).
    const bool reached = model.sides != LightModel::Sides::flip || glm::dot(n, to_eye) > 0;
    const double n_dot_vp = glm::dot(n, to_light);
    glm::dvec3 color = ambient * glm::dvec3(source.ambient);
    if (reached && n_dot_vp > 0) {  // else the diffuse term is clamped to 0, and the specular one has f = 0
      color += n_dot_vp * diffuse * glm::dvec3(source.diffuse);
      color += finite_power(highlight(model, n, to_light, to_eye), material.shininess) *
               (specular * glm::dvec3(source.specular));
    }
    rgb += share * color;
  }
  return glm::clamp(glm::dvec4(rgb, material.diffuse.a), 0.0, 1.0);
}

DoubleMaterial material_of(const Scene& scene, const Draw& draw, LitPart part, const glm::dvec4& color) {
  const Material& own = part.back && draw.back_material ? *draw.back_material : draw.material;
  DoubleMaterial material{own.ambient, own.diffuse, own.specular, own.emission, own.shininess};
  if (!scene.meshes.at(draw.mesh).colors.empty()) {
    const ColorMaterial follows = draw.color_material;
    const bool both = follows == ColorMaterial::ambient_and_diffuse;
    if (both || follows == ColorMaterial::ambient) material.ambient = color;
    if (both || follows == ColorMaterial::diffuse) material.diffuse = color;
    if (follows == ColorMaterial::specular) material.specular = color;
    if (follows == ColorMaterial::emission) material.emission = color;
  }
  const glm::dvec4 none(0);
  if (part.secondary) return {none, none, material.specular, none, material.shininess};
  if (scene.light_model.separate_specular) material.specular = none;
  return material;
}

DoubleMaterial material_at(const Scene& scene, const Draw& draw, LitPart part, std::uint32_t vertex) {
  const Mesh& mesh = scene.meshes.at(draw.mesh);
  return material_of(scene, draw, part, mesh.colors.empty() ? glm::dvec4(0) : glm::dvec4(mesh.colors.at(vertex)));
}

glm::dvec4 fragment_light(const LitDraw& lit, LitPart part, const glm::dvec4& color, glm::dvec3 n, glm::dvec3 p_eye) {
  const DoubleMaterial material = material_of(lit.scene, lit.draw, part, color);
  return light(lit.scene, material, lit.lights, p_eye, part.back ? -unit_of(n) : unit_of(n));
}

glm::dvec4 color_sum(const glm::dvec4& primary, const glm::dvec4& secondary) {
  return glm::clamp(primary + glm::dvec4(glm::dvec3(secondary), 0), 0.0, 1.0);
}

glm::dvec4 vertex_color(const LitDraw& lit, std::uint32_t vertex, glm::dvec3 p_eye, glm::dvec3 n_eye, LitPart part) {
  const auto& [scene, draw, lights] = lit;
  if (is_lit_per_vertex(draw)) {
    return light(scene, material_at(scene, draw, part, vertex), lights, p_eye, part.back ? -n_eye : n_eye);
  }
  const Mesh& mesh = scene.meshes.at(draw.mesh);
  const glm::dvec4 color(mesh.colors.empty() ? draw.material.diffuse : mesh.colors.at(vertex));
  return glm::clamp(color, 0.0, 1.0);
}

glm::dvec3 normal_in_eye_space(Normals normals, const glm::dmat3& normal_matrix, glm::dvec3 n) {
  const glm::dvec3 n_eye = normal_matrix * n;
  switch (normals) {
    case Normals::normalize: return glm::normalize(n_eye);
    case Normals::rescale: {  // f = 1 / sqrt(m31^2 + m32^2 + m33^2), of the model-view's inverse
      const glm::dmat3 inverse = glm::transpose(normal_matrix);
      return n_eye / std::sqrt(inverse[0].z * inverse[0].z + inverse[1].z * inverse[1].z + inverse[2].z * inverse[2].z);
    }
    case Normals::as_they_are: return n_eye;
  }
  return n_eye;
}

}  // namespace plumbline::math
