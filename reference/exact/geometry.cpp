#include "reference/exact/geometry.h"

#include <fmt/format.h>

#include "reference/arithmetic/draw_ranges.h"
#include "reference/arithmetic/light.h"
#include "reference/arithmetic/matrices.h"
#include "reference/exact/input.h"

namespace plumbline::exact {

std::vector<Matrices<double>> make_matrices(const Scene& scene) {
  std::vector<Matrices<double>> matrices;
  for (const Draw& draw : scene.draws) matrices.push_back(math::double_matrices(scene, draw));
  return matrices;
}

std::vector<Vertex<double>> transform_vertices(const Scene& scene, const std::vector<Matrices<double>>& matrices) {
  require_size("records.matrices", matrices.size(), scene.draws.size());
  std::vector<Vertex<double>> vertices;
  for (std::size_t d = 0; d < scene.draws.size(); ++d) {
    const Mesh& mesh = scene.meshes.at(scene.draws[d].mesh);
    require_size(fmt::format("the normals of mesh {}", scene.draws[d].mesh), mesh.normals.size(),
                 mesh.positions.size());
    const glm::dmat4 model_view_projection = matrices[d].projection * matrices[d].model_view;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::dvec4 p_model(mesh.positions[i], 1);
      vertices.push_back(
          {.p_eye = matrices[d].model_view * p_model,
           .p_clip = model_view_projection * p_model,
           .n_eye = math::normal_in_eye_space(scene.draws[d].normals, matrices[d].normal, mesh.normals[i])});
    }
  }
  return vertices;
}

std::vector<LightSource<double>> lights_of(const Scene& scene, const Records<double>& records) {
  if (records.lights.empty()) return math::light_sources(scene);
  require_size("records.lights", records.lights.size(), scene.lights.size());
  return records.lights;
}

std::vector<Lit<double>> light_vertices(const Scene& scene, const Records<double>& records) {
  const std::vector<LightSource<double>> lights = lights_of(scene, records);
  const std::vector<Vertex<double>>& vertices = records.vertices;
  const std::vector<DrawRange> ranges = math::ranges_of_draws(scene);
  require_size("records.vertices", vertices.size(),
               ranges.empty() ? 0 : ranges.back().first_vertex + ranges.back().vertex_count);
  std::vector<Lit<double>> lit;
  for (std::size_t d = 0; d < scene.draws.size(); ++d)
    for (std::uint32_t i = 0; i < ranges[d].vertex_count; ++i) {
      const Vertex<double>& v = vertices[ranges[d].first_vertex + i];
      lit.push_back({math::vertex_color({scene, scene.draws[d], lights}, i, glm::dvec3(v.p_eye), v.n_eye)});
    }
  return lit;
}

}  // namespace plumbline::exact
