#include "pipeline/draw.h"

#include <algorithm>

#include "pipeline/clip.h"
#include "pipeline/light.h"
#include "pipeline/matrices.h"
#include "pipeline/vertex.h"
#include "pipeline/window.h"

namespace plumbline::pipeline {

GeometryStages geometry_stages() { return {matrices, transform, light, clip, to_window}; }

Geometry run_geometry(const Scene& scene, const GeometryStages& stages) {
  Geometry out;
  Records<float>& r = out.records;
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  for (std::size_t d = 0; d < scene.draws.size(); ++d) {
    const Draw& draw = scene.draws[d];
    const Mesh& mesh = scene.meshes[draw.mesh];
    r.matrices.push_back(stages.matrices(scene, draw));
    stages.vertex(r.matrices.back(), draw.normals, mesh, r.vertices);
    const auto vertices = std::span(r.vertices).subspan(ranges[d].first_vertex);
    stages.light(scene, draw, vertices, r.lit);
    const auto lit = std::span(r.lit).subspan(ranges[d].first_vertex);
    const std::size_t first_polygon = r.polygons.polygons.size();
    stages.clip(
        {vertices, lit, mesh.triangles, ranges[d].first_primitive, draw.shading, scene.depth_clamp, mesh.topology},
        r.polygons);
    stages.window(r.matrices.back(), draw.cull, r.polygons, std::span(r.polygons.polygons).subspan(first_polygon),
                  r.triangles);
  }
  out.first_triangle = triangles_of_draws(scene, r.triangles);
  return out;
}

std::vector<std::uint32_t> triangles_of_draws(const Scene& scene, std::span<const WindowTriangle<float>> triangles) {
  std::vector<std::uint32_t> first;
  for (const DrawRange& range : draw_ranges(scene)) {
    const auto it = std::partition_point(triangles.begin(), triangles.end(), [&](const WindowTriangle<float>& t) {
      return t.primitive < range.first_primitive;
    });
    first.push_back(static_cast<std::uint32_t>(it - triangles.begin()));
  }
  first.push_back(static_cast<std::uint32_t>(triangles.size()));
  return first;
}

}  // namespace plumbline::pipeline
