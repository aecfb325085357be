#include "kernels/fragment_light.h"

namespace plumbline::pipeline {

FragmentLight fragment_light(const Scene& scene, const Draw& draw, Lights lights) {
  FragmentLight out{&scene, false, illumination(scene, lights), {}, {}};
  out.by_color = draw.color_material != ColorMaterial::none && !scene.meshes[draw.mesh].colors.empty();
  for (const bool back : {false, true}) {
    for (const bool secondary : {false, true}) {
      out.material[back][secondary] = colored_material(scene, draw, {back, secondary});
      out.reflectance[back][secondary] = reflectance(scene, out.material[back][secondary].own);
    }
  }
  return out;
}

}  // namespace plumbline::pipeline
