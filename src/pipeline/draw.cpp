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

void clear(ClipPolygons<float>& polygons) {
  polygons.vertices.clear();
  polygons.polygons.clear();
}

// Those of the geometry; no others are there.
void clear(Records<float>& records) {
  records.matrices.clear();
  records.lights.clear();
  records.vertices.clear();
  records.lit.clear();
  clear(records.polygons);
  records.triangles.clear();
  for (const Varying v : kAllVaryings) {
    VaryingColumns<float>& columns = records.varyings[v];
    columns.vertices.clear();
    columns.clipped.clear();
    columns.triangles.clear();
  }
}

std::span<const ClipPolygon> polygons_of(const DrawRange& range, std::span<const ClipPolygon> polygons) {
  const auto from = [&](std::uint32_t primitive) {
    return std::partition_point(polygons.begin(), polygons.end(),
                                [&](const ClipPolygon& p) { return p.primitive < primitive; });
  };
  return {from(range.first_primitive), from(range.first_primitive + range.primitive_count)};
}

// The polygons alone, a varying in the place of the colour.
void with_varying(const ClipPolygons<float>& from, std::span<const ClipPolygon> polygons,
                  const std::vector<Vec4<float>>& clipped, ClipPolygons<float>& out) {
  clear(out);
  for (const ClipPolygon& polygon : polygons) {
    out.polygons.push_back({polygon.primitive, static_cast<std::uint32_t>(out.vertices.size()), polygon.count});
    for (std::uint32_t i = polygon.first; i < polygon.first + polygon.count; ++i) {
      out.vertices.push_back({from.vertices[i].p_clip, clipped.at(i), from.vertices[i].cut});
    }
  }
}

}  // namespace

GeometryStages geometry_stages() { return {matrices, light_sources, transform, light, carry, clip, to_window}; }

void GeometryRun::begin(const Scene& scene, const GeometryStages& stages) {
  scene_ = &scene;
  stages_ = stages;
  draw_ranges(scene, ranges_);
  plumbline::carried(scene, carried_);
}

std::size_t GeometryRun::bytes() const {
  const auto of = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
  return of(as_lit_) + of(polygons_.vertices) + of(polygons_.polygons) + of(triangles_);
}

void GeometryRun::run(std::size_t draw, Stage stage, const Records<float>& in, Records<float>& out) {
  const Draw& d = scene_->draws[draw];
  switch (stage) {
    case Stage::matrices:
      if (draw == 0) {
        for (const LightSource<float>& light : stages_.lights(*scene_)) out.lights.push_back(light);
      }
      return out.matrices.push_back(stages_.matrices(*scene_, d));
    case Stage::vertex: return stages_.vertex(in.matrices.at(draw), d.normals, scene_->meshes[d.mesh], out.vertices);
    case Stage::light: return light(draw, in, out);
    case Stage::clip: return clip(draw, in, out);
    default: return window(draw, in, out);
  }
}

void GeometryRun::light(std::size_t draw, const Records<float>& in, Records<float>& out) const {
  const Draw& d = scene_->draws[draw];
  const auto vertices = std::span(in.vertices).subspan(ranges_[draw].first_vertex, ranges_[draw].vertex_count);
  const auto of_scene = in.lights.empty() ? light_sources(*scene_) : FixedVector<LightSource<float>, 8>();
  const Lights lights = in.lights.empty() ? Lights(of_scene) : Lights(in.lights);
  stages_.light(*scene_, d, lights, vertices, out.lit);
  for (const Varying v : carried_) stages_.carry(*scene_, d, v, lights, vertices, out.varyings[v].vertices);
}

void GeometryRun::clip(std::size_t draw, const Records<float>& in, Records<float>& out) {
  const Draw& d = scene_->draws[draw];
  const Mesh& mesh = scene_->meshes[d.mesh];
  const DrawRange& range = ranges_[draw];
  const auto vertices = std::span(in.vertices).subspan(range.first_vertex, range.vertex_count);
  const auto lit = std::span(in.lit).subspan(range.first_vertex, range.vertex_count);
  Assembly assembly{vertices,     lit, mesh.triangles, range.first_primitive, d.shading, scene_->depth_clamp,
                    mesh.topology};
  stages_.clip(assembly, out.polygons);
  for (const Varying v : carried_) {
    const auto column = std::span(in.varyings[v].vertices).subspan(range.first_vertex, range.vertex_count);
    as_lit_.clear();
    for (const Vec4<float>& four : column) as_lit_.push_back({four});
    assembly.lit = as_lit_;
    assembly.shading = shading_of(d, v);
    clear(polygons_);
    stages_.clip(assembly, polygons_);
    for (const ClipVertex<float>& vertex : polygons_.vertices) out.varyings[v].clipped.push_back(vertex.color);
  }
}

void GeometryRun::window(std::size_t draw, const Records<float>& in, Records<float>& out) {
  const Draw& d = scene_->draws[draw];
  const Matrices<float>& m = in.matrices.at(draw);
  const auto of_draw = polygons_of(ranges_[draw], in.polygons.polygons);
  const std::size_t first = out.triangles.size();
  stages_.window(m, d, in.polygons, of_draw, out.triangles);
  for (const Varying v : carried_) {
    with_varying(in.polygons, of_draw, in.varyings[v].clipped, polygons_);
    triangles_.clear();
    stages_.window(m, d, polygons_, polygons_.polygons, triangles_);
    if (!is_back(v)) {
      for (const WindowTriangle<float>& t : triangles_) {
        out.varyings[v].triangles.push_back({t.v[0].color, t.v[1].color, t.v[2].color});
      }
      continue;
    }
    if (!carries(*scene_, d, v)) continue;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (triangles_[i].front) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        Vec4<float>& to = v == Varying::back_color ? out.triangles[first + i].v[k].color
                                                   : out.varyings[Varying::secondary].triangles[first + i][k];
        to = triangles_[i].v[k].color;
      }
    }
  }
}

void run_geometry(const Scene& scene, const GeometryStages& stages, GeometryRun& run, Records<float>& out) {
  clear(out);
  run.begin(scene, stages);
  for (std::size_t d = 0; d < run.draws(); ++d) {
    for (const Stage stage : {Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::window}) {
      run.run(d, stage, out, out);
    }
  }
}

Geometry run_geometry(const Scene& scene, const GeometryStages& stages) {
  Geometry out;
  GeometryRun run;
  run_geometry(scene, stages, run, out.records);
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
