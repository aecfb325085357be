#include "check/bounds/fragment_bounds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "check/bounds/mean_bounds.h"
#include "check/bounds/units.h"
#include "check/verdict/ledger.h"
#include "reference/arithmetic/light_bounds.h"

namespace plumbline::check {

namespace {

// Mesa's departures from OpenGL 2.1: fog of triangles behind the eye (3.10); clamp of the colour sum (3.9, 3.10).
constexpr std::string_view kBehindEye =
                               "Mesa interpolates |z_eye| of vertices behind the eye, fog is of a fragment's own",
                           kClampedLate = "Mesa clamps the sum of colours after fog, the specification before";
const Records<double> kNone;
const std::vector<Vec4<double>> kNowhere;

// Differences, per vertex, of what of() takes from a record; `granted` where the reference has no such records.
template <class Record>
std::vector<Vec4<double>> columns_apart(const std::vector<Record>& a, const std::vector<Record>& b, auto of,
                                        double granted) {
  std::vector<Vec4<double>> out(a.size(), Vec4<double>(granted));
  if (b.size() != a.size()) return out;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::abs(std::invoke(of, a[i]) - std::invoke(of, b[i]));
  return out;
}
Vec4<double> normal_of(const Vertex<double>& v) { return {v.n_eye, 0}; }

// Per vertex, bound of a reference's fog coordinate against the z_eye that it hands out: both are the z row of M p, but
// the order of its four products and three sums may differ.
std::vector<Vec4<double>> fog_apart(const Scene& scene, const Records<double>& r) {
  std::vector<Vec4<double>> out(r.vertices.size(), Vec4<double>(0));
  const DrawIndex draws(scene);
  for (std::size_t i = 0; i < std::min(out.size(), draws.vertices()); ++i) {
    const std::size_t d = draws.of_vertex(i).value();
    if (!scene.draws[d].fog || d >= r.matrices.size()) continue;
    const Mesh& mesh = scene.meshes[scene.draws[d].mesh];
    const Vec4<double> p(mesh.positions[i - draws.ranges()[d].first_vertex], 1);
    out[i].z = 4 * u * magnitude(r.matrices[d].model_view, p).z;
  }
  return out;
}

// Per vertex, bound of the difference in a lit varying that the reference does not hand out; empty: no draw carries it.
std::vector<Vec4<double>> granted(const Scene& scene, const Records<double>& r, Varying v) {
  if (std::ranges::none_of(scene.draws, [&](const Draw& draw) { return carries(scene, draw, v); })) return {};
  std::vector<Vec4<double>> out(r.vertices.size(), Vec4<double>(0));
  const DrawIndex draws(scene);
  for (std::size_t i = 0; i < std::min(out.size(), draws.vertices()); ++i) {
    const std::size_t d = draws.of_vertex(i).value();
    const Draw& draw = scene.draws[d];
    if (!carries(scene, draw, v)) continue;
    const std::vector<glm::vec4>& colors = scene.meshes[draw.mesh].colors;
    Vertex<double> vertex = r.vertices[i];
    if (is_back(v)) vertex.n_eye = -vertex.n_eye;
    const Vec4<double> color(colors.empty() ? glm::vec4(0) : colors[i - draws.ranges()[d].first_vertex]);
    const math::LightBounds bounds = math::light_bounds(
        scene, math::material_of(scene, draw, {is_back(v), is_secondary(v)}, color), vertex, {}, r.lights);
    out[i] = {tolerance(Profile::opengl, Stage::light).factor * u * bounds.magnitude + bounds.jump +
                  Vec3<double>(bounds.overflows),
              u};
  }
  return out;
}

// Factor on the corners' errors at a pixel's centre: the sum of |barycentric weights|, 1 inside the triangle. Line,
// which ends beside its last pixel's centre: the larger of the sums by the projection and by the major axis.
double enlarged(WindowTriangle<double> t, int x, int y) {
  for (int k = 0; k < 3; ++k) t.v[static_cast<std::size_t>(k)].color = {k == 0, k == 1, k == 2, 0};
  const auto sum_of = [](const Vec4<double>& weights) {
    return std::abs(weights.x) + std::abs(weights.y) + std::abs(weights.z);
  };
  const Vec4<double> weights = color_of_plane(t, x, y).value;
  const double by_plane = std::max(1.0, sum_of(weights));
  return t.corners == 2 ? std::max(by_plane, sum_of(weights + bounds_from_origin(t, x, y).line_shift_color)) : by_plane;
}

// Error of the candidate's interpolation (ledger, exact.attributes). Where a corner is far away beside the eye, the
// error may exceed that of a plane evaluated from the origin.
Vec4<double> mean_error(const WindowTriangle<double>& t, int x, int y) {
  return tolerance(Profile::exact, Stage::attributes).factor * u * bounds_of_mean(t, x, y);
}

std::vector<Vec4<double>> lit_colors(const Records<double>& r) {
  std::vector<Vec4<double>> out;
  for (const Lit<double>& lit : r.lit) out.push_back(glm::abs(lit.color));
  return out;
}

// Larger element of each pair; a missing one counts as 0.
std::vector<Vec4<double>> larger(std::vector<Vec4<double>> a, const std::vector<Vec4<double>>& b) {
  a.resize(std::max(a.size(), b.size()), Vec4<double>(0));
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) a[i] = glm::max(a[i], b[i]);
  return a;
}

// Indices of the `wanted` fragments, of those whose triangle is recorded.
template <class Wanted>
std::vector<std::size_t> fragments_of(const Records<double>& r, const Wanted& wanted) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    if (r.covered[i].triangle < r.triangles.size() && wanted(i)) out.push_back(i);
  }
  return out;
}

}  // namespace

FragmentsByPixel::FragmentsByPixel(const FrameFormat& frame, const Records<double>& r,
                                   std::vector<std::size_t> fragments)
    : width_(frame.width), records_(r), fragments_(std::move(fragments)) {
  std::ranges::stable_sort(fragments_, {}, [&](std::size_t i) { return pixel(i); });
}

FragmentsByPixel FragmentsByPixel::drawn(const FrameFormat& frame, const Records<double>& r) {
  const bool is_known = r.drawn.size() == r.covered.size();
  return {frame, r, fragments_of(r, [&](std::size_t i) { return is_known && r.drawn[i].drawn; })};
}

FragmentsByPixel FragmentsByPixel::covered(const FrameFormat& frame, const Records<double>& r) {
  return {frame, r, fragments_of(r, [](std::size_t) { return true; })};
}

FragmentBounds::FragmentBounds(const Scene& scene, const Capture& candidate, const Capture& reference, double factor)
    : scene_(scene),
      records_(candidate.records),
      texels_(candidate.legal.texels),
      factor_(factor),
      draws_(scene),
      lit_(larger(lit_colors(candidate.records), candidate.records.varyings[Varying::back_color].vertices)),
      lit_apart_(larger(columns_apart(candidate.records.lit, reference.records.lit, &Lit<double>::color,
                                      u * tolerance(Profile::opengl, Stage::light).factor),
                        granted(scene, candidate.records, Varying::back_color))),
      secondary_apart_(larger(granted(scene, candidate.records, Varying::secondary),
                              granted(scene, candidate.records, Varying::back_secondary))),
      eye_apart_(
          larger(columns_apart(candidate.records.vertices, reference.records.vertices, &Vertex<double>::p_eye, 0),
                 fog_apart(scene, candidate.records))),
      normals_apart_(columns_apart(candidate.records.vertices, reference.records.vertices, normal_of, 0)),
      drawn_(FragmentsByPixel::drawn(scene.frame, is_plain(scene) ? kNone : candidate.records)) {
  for (const Draw& draw : scene.draws) plain_.push_back(is_plain(scene, draw));
  for (const Texture& texture : scene.textures)
    texel_arithmetic_.push_back(tolerance(Profile::opengl, Stage::texture).factor * u * largest_texel(texture));
}

Vec4<double> FragmentBounds::largest_of(std::uint32_t primitive, const std::vector<Vec4<double>>& column,
                                        bool flat_applies) const {
  Vec4<double> out(0);
  const Draw* draw = draws_.draw(primitive);
  if (draw == nullptr) return out;
  const glm::uvec3 corners = draws_.corners(primitive);
  for (int i = flat_applies && draw->shading == Shading::flat ? 2 : 0; i < 3; ++i) {
    if (corners[i] < column.size()) out = glm::max(out, glm::abs(column[corners[i]]));
  }
  return out;
}

bool FragmentBounds::reaches_behind_eye(std::uint32_t primitive) const {
  const glm::uvec3 corners = draws_.corners(primitive);
  for (int i = 0; i < 3; ++i) {
    if (corners[i] < records_.vertices.size() && records_.vertices[corners[i]].p_eye.z > 0) return true;
  }
  return false;
}

std::optional<WindowTriangle<double>> FragmentBounds::as_color(std::size_t i, Varying v) const {
  const std::uint32_t number = records_.covered[i].triangle;
  const auto& corners = records_.varyings[v].triangles;
  if (number >= corners.size()) return std::nullopt;
  WindowTriangle<double> out = records_.triangles[number];
  for (std::size_t k = 0; k < 3; ++k) out.v[k].color = corners[number][k];
  return out;
}

Vec4<double> FragmentBounds::cut_error(std::uint32_t primitive, const std::vector<Vec4<double>>& column) const {
  const ClipPolygons<double>& clip = records_.polygons;
  const auto is_cut = [&](const ClipPolygon& polygon) {
    const auto corners = std::span(clip.vertices).subspan(polygon.first, polygon.count);
    return std::ranges::any_of(corners, &ClipVertex<double>::cut);
  };
  const auto own = std::ranges::equal_range(clip.polygons, primitive, {}, &ClipPolygon::primitive);
  if (std::ranges::none_of(own, is_cut)) return Vec4<double>(0);
  return tolerance(Profile::opengl, Stage::clip).factor * u * largest_of(primitive, column, false);
}

Vec4<double> FragmentBounds::lit_error(std::uint32_t primitive, double times) const {
  const Draw* draw = draws_.draw(primitive);
  const bool flat = draw != nullptr && draw->shading == Shading::flat;
  return times * largest_of(primitive, lit_apart_, true) + (flat ? Vec4<double>(0) : cut_error(primitive, lit_));
}

Vec4<double> FragmentBounds::varying_error(std::size_t i, Varying v) const {
  const Covered& c = records_.covered[i];
  const auto triangle = as_color(i, v);
  if (!triangle) return Vec4<double>(std::numeric_limits<double>::infinity());
  const PlaneBounds plane = bounds_from_origin(*triangle, c.x, c.y);
  const Vec4<double> beside = by_other_edges(i, &records_.varyings[v]);
  const auto& vertices_apart = v == Varying::position    ? eye_apart_
                               : v == Varying::normal    ? normals_apart_
                               : v == Varying::secondary ? secondary_apart_
                                                         : kNowhere;
  return plane.color_error(factor_) + glm::max(glm::abs(plane.line_shift_color), beside) +
         enlarged(*triangle, c.x, c.y) * largest_of(triangle->primitive, vertices_apart, is_lit(v)) +
         mean_error(*triangle, c.x, c.y) + cut_error(triangle->primitive, records_.varyings[v].vertices);
}

Vec4<double> FragmentBounds::by_other_edges(std::size_t i, const VaryingColumns<double>* columns) const {
  const Covered& c = records_.covered[i];
  const WindowTriangle<double>& own = records_.triangles[c.triangle];
  Vec4<double> most(0);
  if (own.corners == 3 || scene_.meshes[draw_of(own.primitive).mesh].topology != Topology::triangles) return most;
  const auto of_primitive = triangles_of(records_, static_cast<std::int32_t>(own.primitive));
  std::vector<WindowTriangle<double>> edges(of_primitive.begin(), of_primitive.end());
  const auto first = static_cast<std::size_t>(of_primitive.data() - records_.triangles.data());
  for (std::size_t k = 0; columns != nullptr && k < edges.size(); ++k) {
    if (first + k >= columns->triangles.size()) return Vec4<double>(std::numeric_limits<double>::infinity());
    for (std::size_t corner = 0; corner < 3; ++corner) edges[k].v[corner].color = columns->triangles[first + k][corner];
  }
  std::vector<EdgeValue> values = edge_values(edges, c.x, c.y);
  const std::vector<EdgeValue> tied = tied_corners(edges, c.x, c.y, depth_step(scene_.frame.depth, 1));
  values.insert(values.end(), tied.begin(), tied.end());
  if (values.empty()) return most;
  const WindowTriangle<double>& here = edges[c.triangle - first];
  const Vec4<double> mine = color_of_plane(here, c.x, c.y).value;
  for (const EdgeValue& value : values) most = glm::max(most, glm::abs(value.color - mine));
  for (const WindowTriangle<double>& edge : edges)
    most = glm::max(most, bounds_from_origin(edge, c.x, c.y).color_error(factor_));
  return most;
}

OpenShare FragmentBounds::open_texels(std::size_t i) const {
  const auto triangle = as_color(i, Varying::texture);
  if (!triangle || i >= texels_.size()) return {1, true};
  const Covered& c = records_.covered[i];
  return open_share(scene_.textures.at(draw_of(triangle->primitive).texture->texture), texels_[i],
                    color_of_plane(*triangle, c.x, c.y), Vec2<double>(varying_error(i, Varying::texture)));
}

TexelBound FragmentBounds::texel(std::size_t i) const {
  const Draw& draw = draw_of(records_.triangles[records_.covered[i].triangle].primitive);
  if (i >= texels_.size() || i >= records_.varyings[Varying::texture].fragments.size()) {
    return {{}, Vec4<double>(std::numeric_limits<double>::infinity())};
  }
  const Vec4<double>& st = records_.varyings[Varying::texture].fragments[i];
  const std::size_t texture = draw.texture->texture;
  return texel_bound(scene_.textures.at(texture), texels_[i], Vec2<double>(st),
                     Vec2<double>(varying_error(i, Varying::texture)), texel_arithmetic_[texture]);
}

FragmentBound FragmentBounds::surface(std::size_t i) const {
  const Covered& c = records_.covered[i];
  const WindowTriangle<double>& triangle = records_.triangles[c.triangle];
  const Draw& draw = draw_of(triangle.primitive);
  const PlaneBounds plane = bounds_from_origin(triangle, c.x, c.y);
  ShadeInputs errors;
  errors.color = plane.color_error(factor_) + glm::max(glm::abs(plane.line_shift_color), by_other_edges(i, nullptr)) +
                 lit_error(triangle.primitive, enlarged(triangle, c.x, c.y)) + mean_error(triangle, c.x, c.y);
  for (const Varying v : kAllVaryings) {
    if (!is_back(v) && carries(scene_, draw, v)) errors[v] = varying_error(i, v);
  }
  const ShadeInputs fours = shade_inputs_of(records_, i);
  if (draw.texture) {
    const TexelBound bound = texel(i);
    errors.texel =
        glm::max(glm::abs(bound.range.hi - fours.texel), glm::abs(fours.texel - bound.range.lo)) + bound.slack;
  }
  FragmentBound out;
  out.color =
      shade_error(scene_, draw, fours, errors, {tolerance(Profile::opengl, Stage::shade).factor, kFlushedUnderflow});
  if (draw.texture && i < texels_.size())
    out.reason = mesas_other_level(scene_.textures.at(draw.texture->texture), texels_[i]);
  const bool summed = is_lit_per_vertex(draw) && scene_.light_model.separate_specular;
  Vec4<double> primary = fours.color;
  if (draw.texture) {
    const TextureFormat format = scene_.textures.at(draw.texture->texture).format;
    primary = environ_error(format, *draw.texture, primary, errors.color, fours.texel, errors.texel, {1}).color;
  }
  const Vec3<double> sum(primary + fours[Varying::secondary]);
  const bool clamped = summed && (std::max({sum.x, sum.y, sum.z}) > 1 || std::min({sum.x, sum.y, sum.z}) < 0);
  if (draw.fog && clamped) out.reason = kClampedLate;
  // A sample before the eye may be drawn at a centre where the triangle's plane is behind the eye.
  const bool behind = fours[Varying::position].z > 0 || reaches_behind_eye(triangle.primitive);
  if (draw.fog && behind) out.reason = kBehindEye;
  return out;
}

FragmentBound FragmentBounds::of_fragment(std::size_t i) const {
  const Covered& c = records_.covered[i];
  const WindowTriangle<double>& triangle = records_.triangles[c.triangle];
  if (!plain_[draws_.of_primitive(triangle.primitive).value()]) return surface(i);
  const PlaneBounds plane = bounds_from_origin(triangle, c.x, c.y);
  const Vec4<double> apart =
      lit_error(triangle.primitive, enlarged(triangle, c.x, c.y)) + mean_error(triangle, c.x, c.y);
  return {
      plane.color_error(factor_), glm::max(glm::abs(plane.line_shift_color), by_other_edges(i, nullptr)), apart, {}};
}

FragmentBound FragmentBounds::of_winner(std::int32_t primitive, int x, int y) const {
  const auto p = static_cast<std::uint32_t>(primitive);
  const auto draw = draws_.of_primitive(p);
  if (!draw || plain_[*draw]) {
    const PlaneBounds plane = primitive_bounds(records_, primitive, x, y);
    Vec4<double> mean(0);
    double times = std::numeric_limits<double>::infinity();  // of the triangle that the centre is in, or nearest to
    for (const WindowTriangle<double>& t : triangles_of(records_, primitive)) {
      if (is_near(t, x, y)) mean = glm::max(mean, mean_error(t, x, y));
      times = std::min(times, t.corners > 1 ? enlarged(t, x, y) : 1);
    }
    if (!std::isfinite(times)) times = 1;  // a sliver's plane, which has no bound either
    return {plane.color_error(factor_), plane.line_shift_color, lit_error(p, times) + mean, {}};
  }
  FragmentBound out{Vec4<double>(std::numeric_limits<double>::infinity()), {}, {}, {}};
  drawn_.each(x, y, [&](std::size_t i) {
    if (records_.triangles[records_.covered[i].triangle].primitive == p) out = surface(i);
  });
  return out;
}

}  // namespace plumbline::check
