#include "pipeline/light.h"

namespace plumbline::pipeline {

namespace {

void each_lit(const Scene& scene, const Draw& draw, LitPart part, Lights in_eye_space,
              std::span<const Vertex<float>> vertices, auto add) {
  const bool by_color = draw.color_material != ColorMaterial::none && !scene.meshes[draw.mesh].colors.empty();
  const Illumination lights = illumination(scene, in_eye_space);
  const ColoredMaterial material = colored_material(scene, draw, part);
  Reflectance<float> of_vertex = reflectance(scene, material.own);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (by_color) {
      const glm::vec4& c = scene.meshes[draw.mesh].colors[i];
      of_vertex = reflectance<float>(scene, material, {c.r, c.g, c.b, c.a});
    }
    const Vector<float> p = spread<float>(vertices[i].p_eye), n = spread<float>(vertices[i].n_eye);
    const Color<float> color = lit(lights, of_vertex, p, part.back ? -n : n);
    add({color.r, color.g, color.b, part.secondary ? 0 : color.a});
  }
}

}  // namespace

void light(const Scene& scene, const Draw& draw, Lights lights, std::span<const Vertex<float>> vertices,
           std::vector<Lit<float>>& out) {
  if (!is_lit_per_vertex(draw)) {
    const Mesh& mesh = scene.meshes[draw.mesh];
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      out.push_back({glm::clamp(mesh.colors.empty() ? draw.material.diffuse : mesh.colors[i], 0.0f, 1.0f)});
    }
    return;
  }
  each_lit(scene, draw, {}, lights, vertices, [&](const Vec4<float>& color) { out.push_back({color}); });
}

void light_part(const Scene& scene, const Draw& draw, LitPart part, Lights lights,
                std::span<const Vertex<float>> vertices, std::vector<Vec4<float>>& out) {
  each_lit(scene, draw, part, lights, vertices, [&](const Vec4<float>& color) { out.push_back(color); });
}

}  // namespace plumbline::pipeline
