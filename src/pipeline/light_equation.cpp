#include "pipeline/light_equation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dialect/dialect.h"
#include "pipeline/math.h"

namespace plumbline::pipeline {

namespace {

float dot(const Vec3<float>& a, const Vec3<float>& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
float positive_dot(const Vec3<float>& a, const Vec3<float>& b) { return std::max(dot(a, b), 0.0f); }
Vec3<float> unit(const Vec3<float>& v) { return v / std::sqrt(dot(v, v)); }

EyeLight eye_light(const Light& light, const glm::dmat4& view) {
  const bool directional = light.kind == Light::Kind::directional;
  const Vec3<float> vector(view * glm::dvec4(light.vector, directional ? 0.0 : 1.0));
  EyeLight out{directional, directional ? unit(vector) : vector, false, false, light.attenuation, {}, 0, 0};
  out.attenuates = !directional && light.attenuation != glm::vec3(1, 0, 0);
  if (!directional && light.spot) {
    out.has_cone = true;
    out.cone = unit(Vec3<float>(view * glm::dvec4(light.spot->direction, 0)));
    out.cos_cutoff = static_cast<float>(std::cos(light.spot->cutoff_degrees * kRadians));
    out.exponent = light.spot->exponent;
  }
  return out;
}

// N.L, and the cosine whose power the highlight is; 0 where the light does not reach.
struct Cosines {
  float diffuse, specular;
};

Cosines cosines(const LightModel& model, Vec3<float> n, const Vec3<float>& to_light, const Vec3<float>& to_eye) {
  if (model.sides == LightModel::Sides::flip) {
    const float n_dot_l = dot(n, to_light), n_dot_e = dot(n, to_eye);
    if (n_dot_l < 0.0f && n_dot_e < 0.0f)
      n = -n;
    else if (!(n_dot_e > 0.0f))
      return {0, 0};
  }
  const float n_dot_l = positive_dot(n, to_light);
  if (!(n_dot_l > 0.0f)) return {0, 0};
  if (model.specular == LightModel::Specular::half_vector) return {n_dot_l, positive_dot(n, unit(to_light + to_eye))};
  const Vec3<float> mirrored = (2.0f * n_dot_l) * n - to_light;
  return {n_dot_l, positive_dot(mirrored, to_eye)};
}

// What distance and cone leave of a light.
float reach(const EyeLight& light, const Vec3<float>& from_point, const Vec3<float>& to_light) {
  float share = 1;
  if (light.attenuates) {
    const float d = std::sqrt(dot(from_point, from_point));
    const Vec3<float>& k = light.attenuation;
    // Only a light at the point itself has nothing to divide by.
    share = 1.0f / std::max(k.x + (k.y + k.z * d) * d, std::numeric_limits<float>::min());
  }
  if (light.has_cone) {
    const float cosine = -dot(to_light, light.cone);
    if (!(cosine >= light.cos_cutoff)) return 0;
    share *= power(std::max(cosine, 0.0f), light.exponent);
  }
  return share;
}

}  // namespace

Illumination illumination(const Scene& scene) {
  Illumination out{scene.light_model, {}};
  const glm::dmat4 view = view_matrix(scene);
  for (const Light& light : scene.lights) out.lights.push_back(eye_light(light, view));
  return out;
}

Reflectance reflectance(const Scene& scene, const Material& material) {
  const Vec3<float> ambient(material.ambient), diffuse(material.diffuse), specular(material.specular);
  Reflectance out{
      Vec3<float>(material.emission) + ambient * scene.light_model.ambient, {}, material.shininess, material.diffuse.a};
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& l = scene.lights[i];
    out.answers.at(i) = {l.ambient * ambient, l.diffuse * diffuse, l.specular * specular};
  }
  return out;
}

Vec4<float> lit(const Illumination& illumination, const Reflectance& reflectance, const Vec3<float>& p_eye,
                const Vec3<float>& n_eye) {
  const Vec3<float> to_eye = illumination.model.local_viewer ? unit(-p_eye) : Vec3<float>(0, 0, 1);
  Vec3<float> sum = reflectance.base;
  for (std::size_t i = 0; i < illumination.lights.size(); ++i) {
    const EyeLight& light = illumination.lights[i];
    const Reflectance::Answer& answer = reflectance.answers[i];
    const Vec3<float> from_point = light.directional ? light.vector : light.vector - p_eye;
    const Vec3<float> to_light = light.directional ? light.vector : unit(from_point);
    Vec3<float> color = answer.ambient;
    const Cosines c = cosines(illumination.model, n_eye, to_light, to_eye);
    if (c.diffuse > 0.0f) {
      color += c.diffuse * answer.diffuse;
      color += power(c.specular, reflectance.shininess) * answer.specular;
    }
    if (light.attenuates || light.has_cone) {
      const float share = reach(light, from_point, to_light);
      if (!(share > 0.0f)) continue;
      color *= share;
    }
    sum += color;
  }
  return glm::clamp(Vec4<float>(sum, reflectance.alpha), 0.0f, 1.0f);
}

}  // namespace plumbline::pipeline
