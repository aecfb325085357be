#include "painter/assemble.h"

#include <algorithm>

#include "pipeline/geometry.h"

namespace plumbline::pipeline {

namespace {

// Copies primitives of `from`, each with vertices of its own.
void copy_primitives(const Mesh& from, std::span<const std::uint32_t> primitives, Mesh& to) {
  to.topology = from.topology;
  to.positions.clear(), to.normals.clear(), to.colors.clear(), to.texcoords.clear();
  to.triangles.clear();
  const std::uint32_t corners = corner_count(from.topology);
  for (const std::uint32_t i : primitives) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    for (std::uint32_t k = 0; k < corners; ++k) {
      const std::uint32_t v = from.triangles[i][static_cast<int>(k)];
      to.positions.push_back(from.positions[v]);
      to.normals.push_back(from.normals[v]);
      if (!from.colors.empty()) to.colors.push_back(from.colors[v]);
      if (!from.texcoords.empty()) to.texcoords.push_back(from.texcoords[v]);
    }
    to.triangles.push_back({first, first + std::min(1u, corners - 1), first + corners - 1});
  }
}

}  // namespace

// Fills of_draw_: all primitives of a draw that does not go in lanes, else those that the view volume may cut.
void ScalarGeometry::find(const AssemblyWork& draw) {
  of_draw_.clear();
  const auto violates = [&](unsigned bits) { return (bits & draw.planes) != 0; };
  if (draw.outside != nullptr && !violates(draw.any_outside)) return;
  for (std::uint32_t i = 0; i < draw.range.primitive_count; ++i) {
    const glm::uvec3& c = draw.mesh->triangles[i];
    const auto clipped = [&] {
      const unsigned a = draw.outside[c[0]], b = draw.outside[c[1]], e = draw.outside[c[2]];
      return violates(a | b | e) && !violates(a & b & e) && ((a | b | e) & kNotFinite) == 0;
    };
    if (draw.outside == nullptr || clipped()) of_draw_.push_back(i);
  }
}

std::span<const ShadedTriangle> ScalarGeometry::run(const Scene& scene, std::span<const AssemblyWork> draws) {
  triangles_.clear();
  for (const AssemblyWork& work : draws) {
    find(work);
    if (of_draw_.empty()) continue;
    if (work.outside != nullptr) copy_primitives(*work.mesh, of_draw_, clipped_);
    run_draw(scene, work, work.outside != nullptr ? clipped_ : *work.mesh);
  }
  return triangles_;
}

void ScalarGeometry::run_draw(const Scene& scene, const AssemblyWork& work, const Mesh& mesh) {
  const Draw& draw = *work.draw;
  const DrawInput input = draw_input(scene, draw, matrices(scene, draw));
  const auto lights = light_sources(scene);
  vertices_.clear();
  transform(input.matrices, draw.normals, mesh, vertices_);
  attributes_.clear();
  light({scene, draw, mesh, {lights.begin(), lights.end()}, vertices_}, attributes_);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Polygon polygon = assemble(input, mesh.triangles[i], vertices_, attributes_);
    polygon.primitive = work.range.first_primitive + of_draw_[i];
    clip(input, polygon);
    to_window(input, polygon, triangles_);
  }
}

}  // namespace plumbline::pipeline
