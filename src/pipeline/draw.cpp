#include "pipeline/draw.h"

#include <algorithm>

#include "pipeline/carry.h"
#include "pipeline/clip.h"
#include "pipeline/light.h"
#include "pipeline/matrices.h"
#include "pipeline/vertex.h"
#include "pipeline/window.h"

namespace plumbline::pipeline {

namespace {

template <class T>
void append(std::vector<T> what, std::vector<T>& to) {
  to.insert(to.end(), what.begin(), what.end());
}

std::span<const ClipPolygon> polygons_of(const DrawRange& range, std::span<const ClipPolygon> polygons) {
  const auto from = [&](std::uint32_t primitive) {
    return std::partition_point(polygons.begin(), polygons.end(),
                                [&](const ClipPolygon& p) { return p.primitive < primitive; });
  };
  return {from(range.first_primitive), from(range.first_primitive + range.primitive_count)};
}

// The polygons alone, a varying in the place of the colour.
ClipPolygons<float> with_varying(const ClipPolygons<float>& from, std::span<const ClipPolygon> polygons,
                                 const std::vector<Vec4<float>>& clipped) {
  ClipPolygons<float> out;
  for (const ClipPolygon& polygon : polygons) {
    out.polygons.push_back({polygon.primitive, static_cast<std::uint32_t>(out.vertices.size()), polygon.count});
    for (std::uint32_t i = polygon.first; i < polygon.first + polygon.count; ++i) {
      out.vertices.push_back({from.vertices[i].p_clip, clipped.at(i), from.vertices[i].cut});
    }
  }
  return out;
}

}  // namespace

GeometryStages geometry_stages() { return {matrices, transform, light, carry, clip, to_window}; }

GeometryRun::GeometryRun(const Scene& scene, const GeometryStages& stages)
    : scene_(scene), stages_(stages), ranges_(draw_ranges(scene)), carried_(carried(scene)) {}

void GeometryRun::run(std::size_t draw, Stage stage, const Records<float>& in, Records<float>& out) const {
  const Draw& d = scene_.draws[draw];
  switch (stage) {
    case Stage::matrices: return out.matrices.push_back(stages_.matrices(scene_, d));
    case Stage::vertex: return stages_.vertex(in.matrices.at(draw), d.normals, scene_.meshes[d.mesh], out.vertices);
    case Stage::light: return light(draw, in, out);
    case Stage::clip: return clip(draw, in, out);
    default: return window(draw, in, out);
  }
}

void GeometryRun::light(std::size_t draw, const Records<float>& in, Records<float>& out) const {
  const Draw& d = scene_.draws[draw];
  const auto vertices = std::span(in.vertices).subspan(ranges_[draw].first_vertex, ranges_[draw].vertex_count);
  stages_.light(scene_, d, vertices, out.lit);
  for (const Varying v : carried_) stages_.carry(scene_, d, v, vertices, out.varyings[v].vertices);
}

void GeometryRun::clip(std::size_t draw, const Records<float>& in, Records<float>& out) const {
  const Draw& d = scene_.draws[draw];
  const Mesh& mesh = scene_.meshes[d.mesh];
  const DrawRange& range = ranges_[draw];
  const auto vertices = std::span(in.vertices).subspan(range.first_vertex, range.vertex_count);
  const auto lit = std::span(in.lit).subspan(range.first_vertex, range.vertex_count);
  Assembly assembly{vertices, lit, mesh.triangles, range.first_primitive, d.shading, scene_.depth_clamp, mesh.topology};
  stages_.clip(assembly, out.polygons);
  for (const Varying v : carried_) {
    const auto column = std::span(in.varyings[v].vertices).subspan(range.first_vertex, range.vertex_count);
    const std::vector<Lit<float>> as_color = as_lit(column);
    assembly.lit = as_color;
    assembly.shading = shading_of(d, v);
    ClipPolygons<float> polygons;
    stages_.clip(assembly, polygons);
    append(colors_of(polygons.vertices), out.varyings[v].clipped);
  }
}

void GeometryRun::window(std::size_t draw, const Records<float>& in, Records<float>& out) const {
  const Draw& d = scene_.draws[draw];
  const Matrices<float>& m = in.matrices.at(draw);
  const auto of_draw = polygons_of(ranges_[draw], in.polygons.polygons);
  const std::size_t first = out.triangles.size();
  stages_.window(m, d, in.polygons, of_draw, out.triangles);
  for (const Varying v : carried_) {
    const ClipPolygons<float> polygons = with_varying(in.polygons, of_draw, in.varyings[v].clipped);
    std::vector<WindowTriangle<float>> triangles;
    stages_.window(m, d, polygons, polygons.polygons, triangles);
    if (!is_back(v)) {
      append(colors_of(triangles), out.varyings[v].triangles);
      continue;
    }
    if (!carries(scene_, d, v)) continue;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (triangles[i].front) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        Vec4<float>& to = v == Varying::back_color ? out.triangles[first + i].v[k].color
                                                   : out.varyings[Varying::secondary].triangles[first + i][k];
        to = triangles[i].v[k].color;
      }
    }
  }
}

Geometry run_geometry(const Scene& scene, const GeometryStages& stages) {
  Geometry out;
  const GeometryRun run(scene, stages);
  for (std::size_t d = 0; d < run.draws(); ++d) {
    for (const Stage stage : {Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::window}) {
      run.run(d, stage, out.records, out.records);
    }
  }
  out.first_triangle = triangles_of_draws(scene, out.records.triangles);
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
