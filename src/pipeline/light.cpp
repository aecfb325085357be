#include "pipeline/geometry.h"

#include <algorithm>

namespace plumbline::pipeline {

void light_part(const Scene& scene, const Draw& draw, const Mesh& mesh, LitPart part, Lights lights,
                std::span<const Vertex<float>> vertices, std::size_t attribute, std::span<Attributes> out) {
  const bool by_color = draw.color_material != ColorMaterial::none && !mesh.colors.empty();
  const Illumination in_eye_space = illumination(scene, lights);
  const ColoredMaterial material = colored_material(scene, draw, part);
  Reflectance<float> of_vertex = reflectance<float>(scene, {material.own}, {});
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (by_color) of_vertex = reflectance<float>(scene, material, mesh.colors[i]);
    const Vec3<float>& n = vertices[i].n_eye;
    out[i][attribute] = lit(in_eye_space, of_vertex, Vec3<float>(vertices[i].p_eye), part.back ? -n : n);
    if (part.secondary) out[i][attribute].a = 0;
  }
}

void light(const Scene& scene, const Draw& draw, const Mesh& mesh, Lights lights,
           std::span<const Vertex<float>> vertices, std::vector<Attributes>& out) {
  out.resize(out.size() + vertices.size());
  const std::span<Attributes> added = std::span(out).last(vertices.size());
  std::ranges::fill(added, Attributes{});
  if (is_lit_per_vertex(draw)) light_part(scene, draw, mesh, {}, lights, vertices, 0, added);
  for (std::size_t i = 0; i < added.size() && !is_lit_per_vertex(draw); ++i) {
    added[i].color() = glm::clamp(mesh.colors.empty() ? draw.material.diffuse : mesh.colors[i], 0.0f, 1.0f);
  }
  for (const Varying v : kAllVaryings) {
    if (!carries(scene, draw, v)) continue;
    if (is_lit(v)) {
      light_part(scene, draw, mesh, {is_back(v), is_secondary(v)}, lights, vertices, 1 + index_of(v), added);
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
