#include "pipeline/fragment_light.h"

#include <cmath>

namespace plumbline::pipeline {

FragmentLight fragment_light(const Scene& scene, const Draw& draw) {
  const bool by_color = draw.color_material != ColorMaterial::none && !scene.meshes[draw.mesh].colors.empty();
  return {&scene, &draw, by_color, illumination(scene), reflectance(scene, draw.material)};
}

Vec4<float> lit_fragment(const FragmentLight& light, const Vec4<float>& color, const Vec3<float>& n,
                         const Vec3<float>& p_eye) {
  const Vec3<float> n_eye = n / std::sqrt((n.x * n.x + n.y * n.y) + n.z * n.z);
  if (!light.by_color) return lit(light.illumination, light.reflectance, p_eye, n_eye);
  return lit(light.illumination, reflectance(*light.scene, colored(*light.draw, color)), p_eye, n_eye);
}

}  // namespace plumbline::pipeline
