#include "reference/exact/surface.h"

#include "reference/arithmetic/fog.h"
#include "reference/arithmetic/texture.h"
#include "reference/exact/geometry.h"
#include "reference/exact/input.h"

namespace plumbline::exact {

glm::dvec4 shade(const math::LitDraw& lit, bool front, const glm::dvec4& color, const Fours& fours,
                 const glm::dvec4& texel) {
  const Scene& scene = lit.scene;
  const Draw& draw = lit.draw;
  const auto four = [&](Varying v) { return fours[static_cast<std::size_t>(v)]; };
  const LightModel& model = scene.light_model;
  glm::dvec4 out = color, secondary = four(Varying::secondary);
  if (is_lit_per_fragment(draw)) {
    const bool back = !front && model.sides == LightModel::Sides::two;
    const auto part = [&](bool specular) {
      return math::fragment_light(lit, {back, specular}, color, glm::dvec3(four(Varying::normal)),
                                  glm::dvec3(four(Varying::position)));
    };
    out = part(false);
    if (model.separate_specular) secondary = part(true);
  }
  if (draw.texture) {
    out = math::textured_color(scene.textures.at(draw.texture->texture).format, *draw.texture, out, texel);
  }
  if (draw.lit && model.separate_specular) out = math::color_sum(out, secondary);
  if (draw.fog) out = math::fogged(*draw.fog, out, four(Varying::position).z);
  return out;
}

std::vector<Shaded<double>> shade_fragments(const Scene& scene, const Records<double>& records) {
  const std::size_t count = records.covered.size();
  require_size("records.attributes", records.attributes.size(), count);
  std::vector<Varying> varyings = carried(scene);
  std::erase_if(varyings, is_back);
  for (const Varying v : varyings) require_size("records.varyings", records.varyings[v].fragments.size(), count);
  if (textured(scene)) require_size("records.texels", records.texels.size(), count);
  std::vector<Shaded<double>> shaded;
  shaded.reserve(count);
  if (is_plain(scene)) {
    for (const Attributes<double>& a : records.attributes) shaded.push_back({a.color});
    return shaded;
  }
  const DrawOf draw_of(scene);
  const std::vector<LightSource<double>> lights = lights_of(scene, records);
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const WindowTriangle<double>& triangle = records.triangles[run.triangle];
    for (std::size_t i = run.first; i < run.last; ++i) {
      Fours fours{};
      for (const Varying v : varyings) fours[static_cast<std::size_t>(v)] = records.varyings[v].fragments[i];
      const glm::dvec4 texel = records.texels.empty() ? glm::dvec4(0) : records.texels[i].color;
      shaded.push_back({shade({scene, draw_of(triangle.primitive), lights}, triangle.front, records.attributes[i].color,
                              fours, texel)});
    }
  }
  return shaded;
}

}  // namespace plumbline::exact
