#include "pipeline/geometry.h"

#include <algorithm>

namespace plumbline::pipeline {

namespace {

// Writes one part of a lit draw's colours into attribute number `attribute` (0: the colour, 1 + v: Varying v) of each
// of `out`, which has one entry per vertex. Alpha of a secondary part is 0.
void light_part(const LightInput& in, LitPart part, std::size_t attribute, std::span<Attributes> out) {
  const bool by_color = in.draw.color_material != ColorMaterial::none && !in.mesh.colors.empty();
  const Illumination in_eye_space = illumination(in.scene, in.lights);
  const ColoredMaterial material = colored_material(in.scene, in.draw, part);
  Reflectance<float> of_vertex = reflectance<float>(in.scene, {material.own}, {});
  for (std::size_t i = 0; i < in.vertices.size(); ++i) {
    if (by_color) of_vertex = reflectance<float>(in.scene, material, in.mesh.colors[i]);
    const Vec3<float>& n = in.vertices[i].n_eye;
    out[i][attribute] = lit(in_eye_space, of_vertex, Vec3<float>(in.vertices[i].p_eye), part.back ? -n : n);
    if (part.secondary) out[i][attribute].a = 0;
  }
}

}  // namespace

void light(const LightInput& in, std::vector<Attributes>& out) {
  const auto& [scene, draw, mesh, lights, vertices] = in;
  out.resize(out.size() + vertices.size());
  const std::span<Attributes> added = std::span(out).last(vertices.size());
  std::ranges::fill(added, Attributes{});
  if (is_lit_per_vertex(draw)) light_part(in, {}, 0, added);
  for (std::size_t i = 0; i < added.size() && !is_lit_per_vertex(draw); ++i) {
    added[i].color() = glm::clamp(mesh.colors.empty() ? draw.material.diffuse : mesh.colors[i], 0.0f, 1.0f);
  }
  for (const Varying v : kAllVaryings) {
    if (!carries(scene, draw, v)) continue;
    if (is_lit(v)) {
      light_part(in, {is_back(v), is_secondary(v)}, 1 + index_of(v), added);
      continue;
    }
    for (std::size_t i = 0; i < added.size(); ++i) {
      added[i][v] = v == Varying::texture  ? Vec4<float>(mesh.texcoords.at(i), 0.0f, 1.0f)
                    : v == Varying::normal ? Vec4<float>(vertices[i].n_eye, 0.0f)
                                           : vertices[i].p_eye;
    }
  }
}

}  // namespace plumbline::pipeline
