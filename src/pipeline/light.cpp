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
  const bool by_color = draw.color_material != ColorMaterial::none && !scene.meshes[draw.mesh].colors.empty();
  const Illumination lights = illumination(scene);
  Reflectance of_vertex = reflectance(scene, draw.material);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (by_color) of_vertex = reflectance(scene, colored(draw, scene.meshes[draw.mesh].colors[i]));
    out.push_back({lit(lights, of_vertex, Vec3<float>(vertices[i].p_eye), vertices[i].n_eye)});
  }
}

}  // namespace plumbline::pipeline
