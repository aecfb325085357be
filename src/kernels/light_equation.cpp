#include "kernels/light_equation.h"

#include <cmath>

namespace plumbline::pipeline {

namespace {

EyeLight eye_light(const Light& light, const LightSource<float>& source) {
  const bool directional = light.kind == Light::Kind::directional;
  const Vec3<float> vector = Vec3<float>(source.p_eye);
  EyeLight out{directional, vector, {}, false, false, light.attenuation, {}, 0, 0};
  if (directional) {
    out.vector = unit(vector);
    out.half = unit(out.vector + Vec3<float>{0, 0, 1});
  }
  out.attenuates = !directional && light.attenuation != glm::vec3(1, 0, 0);
  if (!directional && light.spot) {
    out.has_cone = true;
    out.cone = unit(source.spot_eye);
    out.cos_cutoff = static_cast<float>(std::cos(light.spot->cutoff_degrees * kRadians));
    out.exponent = light.spot->exponent;
  }
  return out;
}

}  // namespace

Illumination illumination(const Scene& scene, Lights lights) {
  Illumination out{scene.light_model, {}};
  for (std::size_t i = 0; i < scene.lights.size(); ++i) out.lights.push_back(eye_light(scene.lights[i], lights[i]));
  return out;
}

ColoredMaterial colored_material(const Scene& scene, const Draw& draw, LitPart part) {
  const glm::vec4 zero(0), one(1);
  const Material with_zero = lit_material(scene, draw, part, &zero), with_one = lit_material(scene, draw, part, &one);
  const auto follows = [&](auto of) { return with_zero.*of != with_one.*of; };
  return {lit_material(scene, draw, part, nullptr), follows(&Material::emission), follows(&Material::ambient),
          follows(&Material::diffuse), follows(&Material::specular)};
}

FragmentLight fragment_light(const Scene& scene, const Draw& draw, Lights lights) {
  FragmentLight out{&scene, false, illumination(scene, lights), {}, {}};
  out.by_color = draw.color_material != ColorMaterial::none && !scene.meshes[draw.mesh].colors.empty();
  for (const bool back : {false, true}) {
    for (const bool secondary : {false, true}) {
      out.material[back][secondary] = colored_material(scene, draw, {back, secondary});
      out.reflectance[back][secondary] = reflectance<float>(scene, {out.material[back][secondary].own}, {});
    }
  }
  return out;
}

}  // namespace plumbline::pipeline
