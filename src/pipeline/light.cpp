#include "pipeline/light.h"

#include <algorithm>

namespace plumbline::pipeline {

void light_part(const Scene& scene, const Draw& draw, LitPart part, Lights lights,
                std::span<const Vertex<float>> vertices, std::size_t attribute, std::span<Attributes> out) {
  const Mesh& mesh = scene.meshes[draw.mesh];
  const bool by_color = draw.color_material != ColorMaterial::none && !mesh.colors.empty();
  const Illumination in_eye_space = illumination(scene, lights);
  const ColoredMaterial material = colored_material(scene, draw, part);
  Reflectance<float> of_vertex = reflectance(scene, material.own);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (by_color) {
      const glm::vec4& c = mesh.colors[i];
      of_vertex = reflectance<float>(scene, material, {c.r, c.g, c.b, c.a});
    }
    const Vector<float> p = spread<float>(vertices[i].p_eye), n = spread<float>(vertices[i].n_eye);
    const Color<float> color = lit(in_eye_space, of_vertex, p, part.back ? -n : n);
    out[i][attribute] = {color.r, color.g, color.b, part.secondary ? 0 : color.a};
  }
}

void light(const Scene& scene, const Draw& draw, Lights lights, std::span<const Vertex<float>> vertices,
           std::vector<Attributes>& out) {
  const Mesh& mesh = scene.meshes[draw.mesh];
  out.resize(out.size() + vertices.size());
  const std::span<Attributes> added = std::span(out).last(vertices.size());
  std::ranges::fill(added, Attributes{});
  if (is_lit_per_vertex(draw)) light_part(scene, draw, {}, lights, vertices, 0, added);
  for (std::size_t i = 0; i < added.size() && !is_lit_per_vertex(draw); ++i) {
    added[i].color() = glm::clamp(mesh.colors.empty() ? draw.material.diffuse : mesh.colors[i], 0.0f, 1.0f);
  }
  for (const Varying v : kAllVaryings) {
    if (!carries(scene, draw, v)) continue;
    if (is_lit(v)) {
      light_part(scene, draw, {is_back(v), is_secondary(v)}, lights, vertices, 1 + static_cast<std::size_t>(v), added);
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
