#include "capture/varying.h"

#include <algorithm>

#include "scene/scene.h"

namespace plumbline {

bool carries(const Scene& scene, const Draw& draw, Varying v) {
  const bool two = is_lit_per_vertex(draw) && scene.light_model.sides == LightModel::Sides::two;
  const bool separate = is_lit_per_vertex(draw) && scene.light_model.separate_specular;
  switch (v) {
    case Varying::secondary: return separate;
    case Varying::back_color: return two;
    case Varying::back_secondary: return two && separate;
    case Varying::texture: return draw.texture.has_value();
    case Varying::normal: return is_lit_per_fragment(draw);
    case Varying::position: return draw.fog.has_value() || is_lit_per_fragment(draw);
  }
  return false;
}

std::vector<Varying> carried(const Scene& scene) {
  std::vector<Varying> out;
  carried(scene, out);
  return out;
}

void carried(const Scene& scene, std::vector<Varying>& out) {
  out.clear();
  std::copy_if(kAllVaryings.begin(), kAllVaryings.end(), std::back_inserter(out), [&](Varying v) {
    return std::any_of(scene.draws.begin(), scene.draws.end(), [&](const Draw& d) { return carries(scene, d, v); });
  });
}

bool is_plain(const Scene& scene, const Draw& draw) {
  return std::none_of(kAllVaryings.begin(), kAllVaryings.end(),
                      [&](Varying v) { return !is_back(v) && carries(scene, draw, v); });
}

bool is_plain(const Scene& scene) {
  return std::all_of(scene.draws.begin(), scene.draws.end(), [&](const Draw& d) { return is_plain(scene, d); });
}

}  // namespace plumbline
