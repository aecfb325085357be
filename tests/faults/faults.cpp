#include "faults/faults.h"

#include <algorithm>
#include <array>
#include <utility>

#include "faults/antialias.h"
#include "faults/light.h"
#include "faults/notes.h"
#include "faults/textures.h"
#include "faults/variants.h"
#include "pipeline/carry.h"
#include "pipeline/clip.h"
#include "pipeline/light.h"
#include "pipeline/matrices.h"
#include "pipeline/vertex.h"
#include "pipeline/window.h"

namespace plumbline::faults {

namespace {

Matrices<float> fov_taken_horizontally(const Scene& scene, const Draw& draw) {
  Matrices<float> m = pipeline::matrices(scene, draw);
  if (std::holds_alternative<Perspective>(scene.projection)) {
    const float aspect = static_cast<float>(scene.frame.width) / static_cast<float>(scene.frame.height);
    m.projection[0][0] *= aspect;
    m.projection[1][1] *= aspect;
  }
  return m;
}

Matrices<float> depth_range_not_mapped(const Scene& scene, const Draw& draw) {
  Matrices<float> m = pipeline::matrices(scene, draw);
  m.win_scale.z = m.win_translate.z = 0.5f;
  return m;
}

void normals_by_model_view(const Matrices<float>& matrices, Normals normals, const Mesh& mesh,
                           std::vector<Vertex<float>>& out) {
  Matrices<float> wrong = matrices;
  wrong.normal = Mat3<float>(matrices.model_view);
  pipeline::transform(wrong, normals, mesh, out);
}

void lights_in_world_space(const Scene& scene, const Draw& draw, std::span<const Vertex<float>> vertices,
                           std::vector<Lit<float>>& out) {
  Scene wrong = scene;
  wrong.dialect = Dialect::gl;
  wrong.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};  // eye space is the world
  pipeline::light(wrong, draw, vertices, out);
}

// Of the vertices before their cut: the fog of a primitive that reaches behind the eye grows towards it.
void positions_by_distance(const Scene& scene, const Draw& draw, Varying varying,
                           std::span<const Vertex<float>> vertices, std::vector<Vec4<float>>& out) {
  const std::size_t first = out.size();
  pipeline::carry(scene, draw, varying, vertices, out);
  if (varying != Varying::position) return;
  for (std::size_t i = first; i < out.size(); ++i) out[i].z = std::abs(out[i].z);
}

void normals_not_renormalised(const Matrices<float>& matrices, Normals, const Mesh& mesh,
                              std::vector<Vertex<float>>& out) {
  pipeline::transform(matrices, Normals::as_they_are, mesh, out);
}

void no_near_plane(const pipeline::Assembly& assembly, ClipPolygons<float>& out) {
  const auto planes = pipeline::view_volume();
  const std::array<Vec4<float>, 5> kept = {planes[0], planes[1], planes[2], planes[3], planes[5]};
  pipeline::clip_at(kept, assembly, out);
}

void snapped_by_truncation(const Matrices<float>& matrices, const Draw& draw, const ClipPolygons<float>& polygons,
                           std::span<const ClipPolygon> of_draw, std::vector<WindowTriangle<float>>& out) {
  const std::size_t first = out.size();
  pipeline::to_window(matrices, draw, polygons, of_draw, out);
  for (std::size_t i = first; i < out.size(); ++i) {
    for (WindowVertex<float>& v : out[i].v) v.snapped = glm::ivec2((glm::vec2(v.p_win) - 0.5f) * 256.0f);
    if (out[i].corners == 3) out[i].front = pipeline::snapped_area(out[i]) > 0;
  }
}

std::vector<glm::ivec2> line_end_drawn(const Triangle& t, glm::ivec2 origin, int size) {
  std::vector<glm::ivec2> pixels = pipeline::thin_pixels(t, origin, size);
  WindowTriangle<float> end{{t.v[1], t.v[1], t.v[1]}, t.primitive, true, 1};
  for (const glm::ivec2 last : pipeline::thin_pixels(end, origin, size)) {
    if (std::find(pixels.begin(), pixels.end(), last) == pixels.end()) pixels.push_back(last);
  }
  return pixels;
}

std::vector<glm::ivec2> steep_lines_torn(const Triangle& t, glm::ivec2 origin, int size) {
  std::vector<glm::ivec2> pixels = pipeline::thin_pixels(t, origin, size);
  std::vector<glm::ivec2> one_per_column;
  for (const glm::ivec2 p : pixels) {
    if (one_per_column.empty() || one_per_column.back().x != p.x) one_per_column.push_back(p);
  }
  return one_per_column;
}

// Every pixel of the thin line becomes a row of an x-major line, a column of a y-major one.
std::vector<glm::ivec2> lines_widened_along(const Triangle& t, glm::ivec2 origin, int size) {
  if (t.corners != 2 || t.width == 1) return pipeline::thin_pixels(t, origin, size);
  WindowTriangle<float> thin = t;
  thin.width = 1;
  const auto width = static_cast<int>(t.width);
  const glm::ivec2 d = glm::abs(t.v[1].snapped - t.v[0].snapped),
                   along = d.x >= d.y ? glm::ivec2(1, 0) : glm::ivec2(0, 1);
  std::vector<glm::ivec2> pixels;
  for (const glm::ivec2 p : pipeline::thin_pixels(thin, origin - width, size + 2 * width)) {
    for (int k = 0; k < width; ++k) {
      const glm::ivec2 q = p + along * (k - width / 2), in_box = q - origin;
      const bool inside = in_box.x >= 0 && in_box.y >= 0 && in_box.x < size && in_box.y < size;
      if (inside && std::find(pixels.begin(), pixels.end(), q) == pixels.end()) pixels.push_back(q);
    }
  }
  return pixels;
}

std::vector<glm::ivec2> points_off_by_half(const Triangle& t, glm::ivec2 origin, int size) {
  WindowTriangle<float> moved = t;
  if (t.corners == 1) moved.v[0].snapped += kSubpixel / 2;
  return pipeline::thin_pixels(moved, origin, size);
}

void mode_of_other_face(const Matrices<float>& matrices, const Draw& draw, const ClipPolygons<float>& polygons,
                        std::span<const ClipPolygon> of_draw, std::vector<WindowTriangle<float>>& out) {
  Draw wrong = draw;
  std::swap(wrong.front_mode, wrong.back_mode);
  pipeline::to_window(matrices, wrong, polygons, of_draw, out);
}

void diagonals_drawn(const Matrices<float>& matrices, const Draw& draw, const ClipPolygons<float>& polygons,
                     std::span<const ClipPolygon> of_draw, std::vector<WindowTriangle<float>>& out) {
  if (draw.front_mode == PolygonMode::fill && draw.back_mode == PolygonMode::fill)
    return pipeline::to_window(matrices, draw, polygons, of_draw, out);
  ClipPolygons<float> fans;
  for (const ClipPolygon& p : of_draw) {
    if (p.count < 3) return pipeline::to_window(matrices, draw, polygons, of_draw, out);
    for (std::uint32_t i = 2; i < p.count; ++i) {
      fans.polygons.push_back({p.primitive, static_cast<std::uint32_t>(fans.vertices.size()), 3});
      for (const std::uint32_t k : {0u, i - 1, i}) fans.vertices.push_back(polygons.vertices[p.first + k]);
    }
  }
  pipeline::to_window(matrices, draw, fans, fans.polygons, out);
}

float truncated_depth(const Setup& setup, const Barycentric<float>& b) {
  const pipeline::DepthSetup& s = setup.depth;
  const double z = pipeline::clamp01(s.z0 + b.l1 * s.dz1 + b.l2 * s.dz2);
  return s.scale == 0.0 ? static_cast<float>(z) : static_cast<float>(static_cast<std::int64_t>(z * s.scale));
}

Color<float> fogged_alpha(const pipeline::Surface& surface, bool front,
                          const pipeline::SurfaceAttributes<float>& attributes) {
  Color<float> color = pipeline::shade_surface<float>(surface, front, attributes);
  if (surface.draw->fog) color.a *= pipeline::fog_factor<float>(*surface.draw->fog, attributes[Varying::position].b);
  return color;
}

bool less_equal_for_less(DepthFunc func, float incoming, float stored) {
  const DepthFunc wrong = func == DepthFunc::less ? DepthFunc::less_equal : func;
  return pipeline::depth_passes_for(pipeline::FragmentStages(), wrong, incoming, stored);
}

Color<float> truncated_color(const Color<float>& color, float scale) {
  if (scale == 0.0f) return color;
  const auto code = [&](float v) { return static_cast<float>(static_cast<int>(pipeline::clamp01(v) * scale)); };
  return {code(color.r), code(color.g), code(color.b), code(color.a)};
}

bool scissor_with_its_far_sides(const Scissor& box, const Pixels<float>& p) {
  return pipeline::scissor<float>({box.x, box.y, box.width + 1, box.height + 1}, p);
}

pipeline::DepthSetup offset_without_slope(const Triangle& triangle, const pipeline::DepthState& state) {
  pipeline::DepthState wrong = state;
  wrong.offset.factor = 0;
  return pipeline::depth_setup(triangle, wrong);
}

bool alpha_at_the_reference_kept(const AlphaTest& test, float alpha, float scale) {
  const bool greater = test.func == CompareFunc::greater;
  return pipeline::alpha_passes<float>({greater ? CompareFunc::greater_equal : test.func, test.reference}, alpha,
                                       scale);
}

bool swapped_depth_ops(const StencilFace& face, bool alive, bool nearer, std::uint8_t* at) {
  StencilFace wrong = face;
  std::swap(wrong.pass, wrong.depth_fail);
  return pipeline::stencil_test<float>(wrong, alive, nearer, at);
}

Color<float> sides_of_logic_op_swapped(LogicOp op, const Color<float>& source, const Color<float>& stored,
                                       float scale) {
  const LogicOp wrong = op == LogicOp::and_reverse    ? LogicOp::and_inverted
                        : op == LogicOp::and_inverted ? LogicOp::and_reverse
                                                      : op;
  return pipeline::logic<float>(wrong, source, stored, scale);
}

Merge swapped_factors(const Merge& of_draw) {
  Merge wrong = of_draw;
  if (wrong.blend) {
    std::swap(wrong.blend->rgb.source, wrong.blend->rgb.destination);
    std::swap(wrong.blend->alpha.source, wrong.blend->alpha.destination);
  }
  return wrong;
}

Merge ignored_color_mask(const Merge& of_draw) {
  return {of_draw.blend, glm::bvec4(true), of_draw.depth_mask, of_draw.logic_op};
}

constexpr std::array kFaults = {
    Fault{"matrices.fov_horizontal", "the vertical field of view is taken for the horizontal one", Stage::matrices,
          put<&Geometry::matrices, fov_taken_horizontally>},
    Fault{"matrices.depth_range_not_mapped", "every draw's depths fill [0,1], whatever its depth range",
          Stage::matrices, put<&Geometry::matrices, depth_range_not_mapped>},
    Fault{"vertex.normals_by_model_view", "normals go by the model-view matrix, not its inverse transpose",
          Stage::vertex, put<&Geometry::vertex, normals_by_model_view>},
    Fault{"vertex.not_renormalised", "normals are not brought to unit length after the model's scale", Stage::vertex,
          put<&Geometry::vertex, normals_not_renormalised>},
    Fault{"light.world_space", "lights are not brought to eye space", Stage::light,
          put<&Geometry::light, lights_in_world_space>},
    Fault{"light.distance_at_vertices", "the distance for fog is taken at the vertices and interpolated", Stage::light,
          put<&Geometry::carry, positions_by_distance>},
    Fault{"clip.no_near_plane", "nothing is cut at the near plane", Stage::clip, put<&Geometry::clip, no_near_plane>},
    Fault{"window.snap_truncates", "window positions are truncated to 1/256 pixel, not rounded", Stage::window,
          put<&Geometry::window, snapped_by_truncation>},
    Fault{"window.mode_of_other_face",
          "front faces are drawn in the back faces' polygon mode, and back faces in theirs", Stage::window,
          put<&Geometry::window, mode_of_other_face>},
    Fault{"window.diagonals_drawn", "the edges of a cut triangle's fan are drawn, not those of its polygon",
          Stage::window, put<&Geometry::window, diagonals_drawn>},
    Fault{"coverage.inclusive_edges", "pixels on any edge are covered: shared edges are painted twice", Stage::coverage,
          put<&Fragment::edges, tied<all_edges_in>>},
    Fault{"coverage.scissor_inclusive", "the scissor box has one column and one row too many", Stage::coverage,
          put<&Fragment::scissor, scissor_with_its_far_sides>},
    Fault{"coverage.line_end_drawn", "a line's last pixel is drawn too: lines that meet paint it twice",
          Stage::coverage, put<&Fragment::thin_pixels, line_end_drawn>},
    Fault{"coverage.steep_lines_torn", "lines are stepped along x in every octant: steep ones have gaps",
          Stage::coverage, put<&Fragment::thin_pixels, steep_lines_torn>},
    Fault{"coverage.lines_widened_along", "wide lines are widened along their major axis, not across it",
          Stage::coverage, put<&Fragment::thin_pixels, lines_widened_along>},
    Fault{"coverage.points_off_by_half", "points' squares lie half a pixel too far right and up", Stage::coverage,
          put<&Fragment::thin_pixels, points_off_by_half>},
    Fault{"depth.truncated", "depth codes are truncated, not rounded", Stage::depth,
          put<&Fragment::depth, truncated_depth>},
    Fault{"depth.offset_without_slope", "a polygon offset is of its units alone", Stage::depth,
          put<&Fragment::depth_setup, offset_without_slope>},
    Fault{"attributes.affine", "attributes are interpolated without perspective", Stage::attributes,
          put<&Fragment::attributes, affine_attributes>},
    Fault{"shade.fogged_alpha", "fog takes alpha too", Stage::shade, put<&Fragment::shade_surface, fogged_alpha>},
    Fault{"visibility.less_equal", "an equal depth passes where only a smaller one may", Stage::visibility,
          put<&Fragment::depth_passes, less_equal_for_less>},
    Fault{"visibility.alpha_at_reference", "an alpha equal to the reference passes where only a greater one may",
          Stage::visibility, put<&Fragment::alpha_passes, alpha_at_the_reference_kept>},
    Fault{"visibility.stencil_ops_swapped", "the stencil op of a depth that fails is taken for that of one that passes",
          Stage::visibility, put<&Fragment::stencil_test, swapped_depth_ops>},
    Fault{"merge.truncated", "colours are truncated to codes, not rounded", Stage::merge,
          put<&Fragment::merge, truncated_color>},
    Fault{"merge.factors_swapped", "blending takes the source's factor for the destination's, and the other way round",
          Stage::merge, put<&Fragment::merge_state, swapped_factors>},
    Fault{"merge.logic_op_sides", "a logic op turns the wrong one over: s & ~d for ~s & d", Stage::merge,
          put<&Fragment::logic, sides_of_logic_op_swapped>},
    Fault{"merge.color_mask_ignored", "masked channels are written", Stage::merge,
          put<&Fragment::merge_state, ignored_color_mask>},
    Fault{"coverage.samples_mirrored", "the samples' y is counted downwards in the pixel", Stage::coverage,
          put<&Fragment::places, mirrored_samples>},
    Fault{"depth.of_centre", "all samples of a pixel have the depth at its centre", Stage::depth,
          put<&Fragment::places, depth_of_centre>},
    Fault{"attributes.of_sample", "a sample's colour is that at its own place, not at the pixel's centre",
          Stage::attributes, put<&Fragment::places, color_of_sample>},
    Fault{"resolve.truncated", "the mean of a pixel's samples is truncated to a code, not rounded", Stage::resolve,
          [](Table& t) {
            t.resolve = {truncated_mean, truncated_mean};
          }},
    Fault{"resolve.weights_swapped", "two of the six taps have each other's weight", Stage::resolve,
          put<&pipeline::ResolveStage::weighted, mean_of_swapped>},
};

// The light's own list, where the lights stand.
std::vector<Fault> with_those_of_other_files() {
  std::vector<Fault> out(kFaults.begin(), kFaults.end());
  out.insert(out.end(), of_light().begin(), of_light().end());
  out.insert(out.end(), of_textures().begin(), of_textures().end());
  return out;
}

}  // namespace

pipeline::Stages Fault::stages() const {
  Table table = production();
  apply(table);
  return stages_of(table);
}

std::span<const Fault> of_stages() {
  static const std::vector<Fault> kAll = with_those_of_other_files();
  return kAll;
}

std::vector<Fault> all() {
  std::vector<Fault> out(of_stages().begin(), of_stages().end());
  out.insert(out.end(), of_notes().begin(), of_notes().end());
  return out;
}

}  // namespace plumbline::faults
