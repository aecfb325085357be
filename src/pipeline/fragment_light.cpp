#include "pipeline/fragment_light.h"

#include <cmath>

namespace plumbline::pipeline {

FragmentLight fragment_light(const Scene& scene, const Draw& draw) {
  const bool by_color = draw.color_material != ColorMaterial::none && !scene.meshes[draw.mesh].colors.empty();
  const auto of = [&](bool back, bool secondary) {
    return reflectance(scene, lit_material(scene, draw, {back, secondary}, nullptr));
  };
  return {&scene,
          &draw,
          by_color,
          illumination(scene),
          {{of(false, false), of(false, true)}, {of(true, false), of(true, true)}}};
}

Vec4<float> lit_fragment(const FragmentLight& light, LitPart part, const Vec4<float>& color, const Vec3<float>& n,
                         const Vec3<float>& p_eye) {
  const float length = std::sqrt((n.x * n.x + n.y * n.y) + n.z * n.z);
  const Vec3<float> n_eye = n / (part.back ? -length : length);
  if (!light.by_color) return lit(light.illumination, light.reflectance[part.back][part.secondary], p_eye, n_eye);
  const glm::vec4 of_vertex(color);
  return lit(light.illumination, reflectance(*light.scene, lit_material(*light.scene, *light.draw, part, &of_vertex)),
             p_eye, n_eye);
}

}  // namespace plumbline::pipeline
