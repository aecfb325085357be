#include "pipeline/light.h"

#include "pipeline/light_equation.h"

namespace plumbline::pipeline {

void light(const Scene& scene, const Draw& draw, std::span<const Vertex<float>> vertices,
           std::vector<Lit<float>>& out) {
  if (!is_lit_per_vertex(draw)) {
    const Mesh& mesh = scene.meshes[draw.mesh];
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      out.push_back({glm::clamp(mesh.colors.empty() ? draw.material.diffuse : mesh.colors[i], 0.0f, 1.0f)});
    }
    return;
  }
  std::vector<Vec4<float>> colors;
  light_part(scene, draw, {}, vertices, colors);
  for (const Vec4<float>& color : colors) out.push_back({color});
}

void light_part(const Scene& scene, const Draw& draw, LitPart part, std::span<const Vertex<float>> vertices,
                std::vector<Vec4<float>>& out) {
  const std::vector<glm::vec4>& colors = scene.meshes[draw.mesh].colors;
  const bool by_color = draw.color_material != ColorMaterial::none && !colors.empty();
  const Illumination lights = illumination(scene);
  Reflectance of_vertex = reflectance(scene, lit_material(scene, draw, part, nullptr));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (by_color) of_vertex = reflectance(scene, lit_material(scene, draw, part, &colors[i]));
    const Vec3<float> n = part.back ? -vertices[i].n_eye : vertices[i].n_eye;
    out.push_back(lit(lights, of_vertex, Vec3<float>(vertices[i].p_eye), n));
    if (part.secondary) out.back().a = 0;
  }
}

}  // namespace plumbline::pipeline
