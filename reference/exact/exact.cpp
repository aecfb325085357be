#include "reference/exact/exact.h"

#include "reference/arithmetic/resolve.h"
#include "reference/exact/carry.h"
#include "reference/exact/clip.h"
#include "reference/exact/coverage.h"
#include "reference/exact/fragments.h"
#include "reference/exact/frame.h"
#include "reference/exact/geometry.h"
#include "reference/exact/input.h"
#include "reference/exact/selection.h"
#include "reference/exact/surface.h"
#include "reference/exact/texels.h"
#include "reference/exact/window.h"
#include "reference/oracle/oracle.h"

namespace plumbline::exact {
namespace {

class Exact : public Renderer {
 public:
  RendererInfo info() const override;
  Capture capture(const Scene& scene, const Request& request) override;
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& by) override;

 private:
  Capture empty_capture(const Scene& scene) const;
};

RendererInfo Exact::info() const {
  RendererInfo info{.name = "exact", .version = "1", .stages = {}, .legal = true, .profile = Profile::exact};
  for (Ability& ability : info.stages) ability = {.shows = true, .runs = true, .reason = {}};
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

Capture Exact::run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& by) {
  Capture out = empty_capture(scene);
  const Records<double>& records = in.records;
  switch (stage) {
    case Stage::matrices:
      out.records.matrices = make_matrices(scene);
      out.records.lights = math::light_sources(scene);
      break;
    case Stage::vertex: out.records.vertices = transform_vertices(scene, records.matrices); break;
    case Stage::light:
      out.records.lit = light_vertices(scene, records);
      light_varyings(scene, records, out.records);
      break;
    case Stage::clip:
      out.records.polygons = clip_primitives(scene, records.vertices, records.lit);
      clip_varyings(scene, records, out.records);
      break;
    case Stage::window:
      out.records.triangles = window_triangles(scene, records.polygons, records.matrices);
      window_varyings(scene, records, out.records);
      break;
    case Stage::coverage: cover_triangles(scene, records.triangles, Request{}.memory_budget, out); break;
    case Stage::depth: out.records.depth = fragment_depths(scene, records, by); break;
    case Stage::attributes:
      out.records.attributes = fragment_attributes(scene, records);
      fragment_varyings(scene, records, out.records);
      break;
    case Stage::texture: filter_texels(scene, records, by, out); break;
    case Stage::shade: out.records.shaded = shade_fragments(scene, records); break;
    case Stage::visibility:
      out.records.drawn = drawn_fragments(scene, records, out.planes.stencil);
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

/// Cleared planes count, id_sum, id and shaded; TestedFrame and ColorBuffer hold depth, stencil and colour.
Planes cleared_planes(const FrameFormat& frame) {
  Planes planes;
  planes.count = Plane<std::uint32_t>(frame.width, frame.height);
  planes.id_sum = Plane<std::uint64_t>(frame.width, frame.height);
  planes.id = Plane<std::int32_t>(frame.width, frame.height, kBackground);
  planes.shaded = Plane<glm::vec4>(frame.width, frame.height, frame.clear_color);
  return planes;
}

/// Number of fragments of which a capture will hold records.
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

/// The varyings that the draw carries, at the pixel's centre.
Fours fours_at(const Scene& scene, const Draw& draw, const Records<double>& window, std::size_t triangle,
               const Barycentric& weights, glm::ivec2 pixel) {
  Fours out{};
  WindowTriangle<double> as_color = window.triangles[triangle];
  for (const Varying v : kAllVaryings) {
    if (is_back(v) || !carries(scene, draw, v)) continue;
    for (std::size_t k = 0; k < 3; ++k) as_color.v[k].color = window.varyings[v].triangles[triangle][k];
    out[static_cast<std::size_t>(v)] = color_at(as_color, weights, pixel.x, pixel.y);
  }
  return out;
}

/// Stages 5 to 11 of the triangles and lights of `window`: planes, and records of the selected fragments. Triangle by
/// triangle, so that other fragments need no memory.
void draw_triangles(const Scene& scene, const Records<double>& window, const Selection& selection, Capture& out) {
  const FrameFormat& frame = scene.frame;
  const DrawOf draw_of(scene);
  TestedFrame buffer(frame);
  ColorBuffer colors(scene);
  out.planes = cleared_planes(frame);
  if (textured(scene)) out.planes.texel = Plane<glm::vec4>(frame.width, frame.height, glm::vec4(0));
  std::uint32_t kept = 0;  // number of the next triangle among those that the capture keeps
  std::vector<Covered> covered;
  for (std::size_t t = 0; t < window.triangles.size(); ++t) {
    const WindowTriangle<double>& triangle = window.triangles[t];
    const bool wanted = selection.primitive(triangle.primitive);
    const Draw& draw = draw_of(triangle.primitive);
    const bool plain = is_plain(scene, draw);
    covered.clear();
    append_covered(triangle, frame, draw, wanted ? kept++ : 0, covered);
    if (covered.empty()) continue;

    const Barycentric weights(triangle, frame.width, frame.height);
    const DepthRule rule = depth_rule(scene, draw, triangle, weights);
    for (const Covered& c : covered) {
      add_fragment(out.planes, c.x, c.y, id_weight(triangle.primitive));
      const double depth = depth_at(triangle, weights, rule, c.x, c.y);
      const bool recorded = wanted && selection.fragments() && selection.pixel(c.x, c.y);
      const bool colored = recorded || draw.alpha_test;
      glm::dvec4 color(0), shaded(0);
      Fours fours{};
      Texel<double> texel;
      const auto colour = [&] {
        color = color_at(triangle, weights, c.x, c.y);
        if (!plain) fours = fours_at(scene, draw, window, t, weights, {c.x, c.y});
        if (draw.texture) {
          const auto texture = static_cast<std::size_t>(Varying::texture);
          const TexturedTriangle with_texture{triangle, window.varyings[Varying::texture].triangles[t],
                                              scene.textures.at(draw.texture->texture), weights};
          texel = texel_at(with_texture, glm::dvec2(fours[texture]), c.x, c.y);
        }
        shaded = plain ? color : shade({scene, draw, window.lights}, triangle.front, color, fours, texel.color);
      };
      if (colored) colour();
      const bool visible = buffer.test({c.x, c.y, draw, triangle.front, depth, shaded.a});
      if (visible && !colored) colour();
      if (recorded) selection.add({c, depth, color, fours, texel, shaded, visible}, out.records);
      if (!visible) continue;
      out.planes.id(c.x, c.y) = static_cast<std::int32_t>(triangle.primitive);
      out.planes.shaded(c.x, c.y) = glm::vec4(shaded);
      if (!out.planes.texel.empty()) out.planes.texel(c.x, c.y) = glm::vec4(texel.color);
      colors.write(c.x, c.y, draw.merge, shaded);
    }
  }
  out.planes.depth = buffer.take_depth();
  out.planes.stencil = buffer.take_stencil();
  out.planes.color = colors.take();
}

Capture Exact::capture(const Scene& scene, const Request& request) {
  if (antialiased(scene)) return math::capture_resolved(*this, scene, request);
  require_budget(scene, plane_bytes(scene), request.memory_budget);
  Capture out = empty_capture(scene);
  Records<double>& records = out.records;
  records.matrices = make_matrices(scene);
  records.lights = math::light_sources(scene);
  records.vertices = transform_vertices(scene, records.matrices);
  records.lit = light_vertices(scene, records);
  records.polygons = clip_primitives(scene, records.vertices, records.lit);
  records.triangles = window_triangles(scene, records.polygons, records.matrices);
  light_varyings(scene, records, records);
  clip_varyings(scene, records, records);
  window_varyings(scene, records, records);
  Records<double> window;
  window.lights = records.lights;
  window.triangles = records.triangles;
  for (const Varying v : kAllVaryings) window.varyings[v].triangles = records.varyings[v].triangles;

  const Selection selection(scene, request);
  selection.prune(out);
  const std::size_t fragments = selected_fragments(scene, selection, window.triangles);
  require_budget(scene, plane_bytes(scene) + geometry_bytes(out) + fragments * selection.bytes_per_fragment(),
                 request.memory_budget);
  if (request.legal && !may_draw(scene, Topology::lines) && !may_draw(scene, Topology::points))
    out.legal = math::legal_by_boxes(scene, request);
  if (request.planes == WantedPlanes::none && !selection.fragments()) return out;
  selection.reserve(fragments, records);
  draw_triangles(scene, window, selection, out);
  return out;
}

}  // namespace

std::unique_ptr<Renderer> make_exact() { return std::make_unique<Exact>(); }

}  // namespace plumbline::exact
