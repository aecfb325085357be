#include "reference/exact/exact.h"

#include "reference/exact/clip.h"
#include "reference/exact/coverage.h"
#include "reference/exact/fragments.h"
#include "reference/exact/frame.h"
#include "reference/exact/geometry.h"
#include "reference/exact/input.h"
#include "reference/exact/selection.h"
#include "reference/exact/window.h"
#include "reference/math/oracle.h"
#include "reference/math/resolve.h"

namespace plumbline::exact {
namespace {

class Exact : public Renderer {
 public:
  RendererInfo info() const override;
  Capture capture(const Scene& scene, const Request& request) override;
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in) override;

 private:
  Capture empty_capture(const Scene& scene) const;
};

RendererInfo Exact::info() const {
  RendererInfo info{.name = "exact", .version = "1", .stages = {}, .legal = true};
  for (Ability& ability : info.stages) ability = {.shows = true, .runs = true, .reason = {}};
  info[Stage::texture] = {.shows = false, .runs = false, .reason = "scenes have no textures yet"};
  return info;
}

Capture Exact::empty_capture(const Scene& scene) const {
  Capture out;
  out.renderer = info().name;
  out.version = info().version;
  out.width = scene.frame.width;
  out.height = scene.frame.height;
  return out;
}

Capture Exact::run_stage(const Scene& scene, Stage stage, const Capture& in) {
  Capture out = empty_capture(scene);
  const Records<double>& records = in.records;
  switch (stage) {
    case Stage::matrices: out.records.matrices = make_matrices(scene); break;
    case Stage::vertex: out.records.vertices = transform_vertices(scene, records.matrices); break;
    case Stage::light: out.records.lit = light_vertices(scene, records.vertices); break;
    case Stage::clip: out.records.polygons = clip_primitives(scene, records.vertices, records.lit); break;
    case Stage::window: out.records.triangles = window_triangles(scene, records.polygons, records.matrices); break;
    case Stage::coverage: cover_triangles(scene, records.triangles, Request{}.memory_budget, out); break;
    case Stage::depth: out.records.depth = fragment_depths(scene, records); break;
    case Stage::attributes: out.records.attributes = fragment_attributes(scene, records); break;
    case Stage::texture: return Renderer::run_stage(scene, stage, in);
    case Stage::shade: out.records.shaded = shade_fragments(records.attributes); break;
    case Stage::visibility:
      out.records.drawn = drawn_fragments(scene, records);
      out.planes.id = visible_primitives(scene, records, out.records.drawn);
      break;
    case Stage::merge: merge_fragments(scene, in, out); break;
    case Stage::resolve:
      require_samples(scene, in.samples);
      out.planes.color = math::mean_colors(scene.frame, in.samples);
      break;
  }
  return out;
}

/// Planes of nothing but the clear values; depth and colour are in their buffers.
Planes cleared_planes(const FrameFormat& frame) {
  Planes planes;
  planes.count = Plane<std::uint32_t>(frame.width, frame.height);
  planes.id_sum = Plane<std::uint64_t>(frame.width, frame.height);
  planes.id = Plane<std::int32_t>(frame.width, frame.height, kBackground);
  planes.shaded = Plane<glm::vec4>(frame.width, frame.height, frame.clear_color);
  return planes;
}

/// How many fragments' records a capture will hold.
std::size_t selected_fragments(const Scene& scene, const Selection& selection,
                               const std::vector<WindowTriangle<double>>& triangles) {
  std::size_t count = 0;
  if (!selection.fragments()) return count;
  const DrawOf draw_of(scene);
  for (const WindowTriangle<double>& triangle : triangles) {
    if (!selection.primitive(triangle.primitive)) continue;
    const Draw& draw = draw_of(triangle.primitive);
    if (triangle.corners < 3) {
      std::vector<Covered> covered;
      append_covered(triangle, scene.frame, draw, 0, covered);
      for (const Covered& c : covered) count += selection.pixel(c.x, c.y);
      continue;
    }
    const CoveredRows rows(snapped_corners(triangle), scene.frame, draw);
    for (int y = rows.y_begin(); y < rows.y_end(); ++y)
      for (auto [x, end] = rows.row(y); x < end; ++x) count += selection.pixel(x, y);
  }
  return count;
}

/// Stages 5 to 11, triangle by triangle, so that no fragment is kept that nobody asked for.
void draw_triangles(const Scene& scene, const std::vector<WindowTriangle<double>>& triangles,
                    const Selection& selection, Capture& out) {
  const FrameFormat& frame = scene.frame;
  const DrawOf draw_of(scene);
  DepthBuffer buffer(frame);
  ColorBuffer colors(scene);
  out.planes = cleared_planes(frame);
  std::uint32_t kept = 0;  // the triangle's number among those that the capture hands out
  std::vector<Covered> covered;
  for (const WindowTriangle<double>& triangle : triangles) {
    const bool wanted = selection.primitive(triangle.primitive);
    const Draw& draw = draw_of(triangle.primitive);
    covered.clear();
    append_covered(triangle, frame, draw, wanted ? kept++ : 0, covered);
    if (covered.empty()) continue;

    const Barycentric weights(triangle, frame.width, frame.height);
    for (const Covered& c : covered) {
      add_fragment(out.planes, c.x, c.y, id_weight(triangle.primitive));
      const double depth = depth_at(triangle, weights, frame, c.x, c.y);
      const bool visible = buffer.test(c.x, c.y, draw, depth);
      const bool recorded = wanted && selection.fragments() && selection.pixel(c.x, c.y);
      if (!visible && !recorded) continue;
      const glm::dvec4 color = color_at(triangle, weights, c.x, c.y);
      if (recorded) selection.add(c, depth, color, visible, out.records);
      if (!visible) continue;
      out.planes.id(c.x, c.y) = static_cast<std::int32_t>(triangle.primitive);
      out.planes.shaded(c.x, c.y) = glm::vec4(color);
      colors.write(c.x, c.y, draw.merge, color);
    }
  }
  out.planes.depth = buffer.take();
  out.planes.color = colors.take();
}

Capture Exact::capture(const Scene& scene, const Request& request) {
  if (scene.frame.antialias.kind != Antialias::Kind::none) return math::capture_resolved(*this, scene, request);
  require_budget(scene, plane_bytes(scene), request.memory_budget);
  Capture out = empty_capture(scene);
  Records<double>& records = out.records;
  records.matrices = make_matrices(scene);
  records.vertices = transform_vertices(scene, records.matrices);
  records.lit = light_vertices(scene, records.vertices);
  records.polygons = clip_primitives(scene, records.vertices, records.lit);
  const auto triangles = window_triangles(scene, records.polygons, records.matrices);

  const Selection selection(scene, request);
  if (request.records.has(Stage::window)) records.triangles = triangles;
  selection.prune(records);
  const std::size_t fragments = selected_fragments(scene, selection, triangles);
  require_budget(scene, plane_bytes(scene) + geometry_bytes(records) + fragments * selection.bytes_per_fragment(),
                 request.memory_budget);
  selection.reserve(fragments, records);
  draw_triangles(scene, triangles, selection, out);
  if (request.legal && !draws(scene, Topology::lines) && !draws(scene, Topology::points))
    out.legal = math::legal_by_boxes(scene, request);
  return out;
}

}  // namespace

std::unique_ptr<Renderer> make_exact() { return std::make_unique<Exact>(); }

}  // namespace plumbline::exact
