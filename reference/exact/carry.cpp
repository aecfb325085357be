#include "reference/exact/carry.h"

#include "capture/seen_as.h"
#include "reference/arithmetic/draw_ranges.h"
#include "reference/arithmetic/light.h"
#include "reference/exact/clip.h"
#include "reference/exact/fragments.h"
#include "reference/exact/geometry.h"
#include "reference/exact/input.h"
#include "reference/exact/window.h"

namespace plumbline::exact {
namespace {

glm::dvec4 at_vertex(Varying varying, const Mesh& mesh, const Vertex<double>& vertex, std::size_t number) {
  if (varying == Varying::texture) return {glm::dvec2(mesh.texcoords.at(number)), 0, 1};
  if (varying == Varying::normal) return {vertex.n_eye, 0};
  if (varying == Varying::position) return vertex.p_eye;
  return glm::dvec4(0);
}

}  // namespace

void light_varyings(const Scene& scene, const Records<double>& in, Records<double>& out) {
  const std::vector<LightSource<double>> lights = lights_of(scene, in);
  const std::vector<DrawRange> ranges = math::ranges_of_draws(scene);
  for (const Varying v : carried(scene)) {
    std::vector<glm::dvec4>& column = out.varyings[v].vertices;
    column.assign(in.vertices.size(), glm::dvec4(0));
    for (std::size_t d = 0; d < scene.draws.size(); ++d) {
      if (!carries(scene, scene.draws[d], v)) continue;
      const std::size_t first = ranges[d].first_vertex, last = first + ranges[d].vertex_count;
      const Mesh& mesh = scene.meshes[scene.draws[d].mesh];
      for (std::size_t i = first; i < last; ++i) {
        const Vertex<double>& vertex = in.vertices.at(i);
        column.at(i) = is_lit(v)
                           ? math::vertex_color({scene, scene.draws[d], lights}, static_cast<std::uint32_t>(i - first),
                                                glm::dvec3(vertex.p_eye), vertex.n_eye, {is_back(v), is_secondary(v)})
                           : at_vertex(v, mesh, vertex, i - first);
      }
    }
  }
}

void clip_varyings(const Scene& scene, const Records<double>& in, Records<double>& out) {
  for (const Varying v : carried(scene)) {
    const Records<double> as_color = seen_as(in, v);
    for (const auto& vertex : clip_primitives(scene, in.vertices, as_color.lit, is_lit(v)).vertices)
      out.varyings[v].clipped.push_back(vertex.color);
  }
}

void window_varyings(const Scene& scene, const Records<double>& in, Records<double>& out) {
  const DrawOf draw_of(scene);
  for (const Varying v : carried(scene)) {
    const Records<double> as_color = seen_as(in, v);
    require_size("records.varyings", as_color.polygons.vertices.size(), in.polygons.vertices.size());
    const auto triangles = window_triangles(scene, as_color.polygons, in.matrices);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto& t = triangles[i];
      if (!is_back(v)) {
        out.varyings[v].triangles.push_back({t.v[0].color, t.v[1].color, t.v[2].color});
      } else if (!t.front && carries(scene, draw_of(t.primitive), v)) {
        for (std::size_t k = 0; k < 3; ++k) {
          glm::dvec4& side = v == Varying::back_color ? out.triangles.at(i).v[k].color
                                                      : out.varyings[Varying::secondary].triangles.at(i)[k];
          side = t.v[k].color;
        }
      }
    }
  }
}

void fragment_varyings(const Scene& scene, const Records<double>& in, Records<double>& out) {
  const DrawOf draw_of(scene);
  for (const Varying v : carried(scene)) {
    if (is_back(v)) continue;
    const Records<double> as_color = seen_as(in, v);
    require_size("records.varyings", as_color.triangles.size(), in.triangles.size());
    const auto fours = fragment_attributes(scene, as_color);
    for (std::size_t i = 0; i < fours.size(); ++i) {
      const bool wanted = carries(scene, draw_of(in.triangles[in.covered[i].triangle].primitive), v);
      out.varyings[v].fragments.push_back(wanted ? fours[i].color : glm::dvec4(0));
    }
  }
}

}  // namespace plumbline::exact
