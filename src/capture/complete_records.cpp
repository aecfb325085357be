#include "capture/complete_records.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "capture/capture_columns.h"
#include "scene/draw_index.h"

namespace plumbline {

namespace {

using Order = std::vector<std::size_t>;

/// Numbers of the records, in the order of their keys; of equal keys as they are. None: they are in order.
template <class Record>
std::optional<Order> order_by(const std::vector<Record>& records, auto key) {
  Order order(records.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (std::ranges::is_sorted(order, {}, key)) return std::nullopt;
  std::ranges::stable_sort(order, {}, key);
  return order;
}

/// Permutes a column by `order`. A column of another length stays unchanged.
template <class T>
void reorder(std::vector<T>& column, const Order& order) {
  if (column.size() != order.size()) return;
  std::vector<T> out;
  out.reserve(order.size());
  for (const std::size_t i : order) out.push_back(column[i]);
  column = std::move(out);
}

// ---- columns

constexpr double kFarthestPlace = 0x1p30;  // [1/256 pixel]
glm::dvec2 place_of(const Vec3<double>& p_win) { return (glm::dvec2(p_win) - 0.5) * double{kSubpixel}; }

// Clears the records of stage window and later.
struct ClearFromWindow {
  void group(Handed group, const auto&, auto& records) const {
    if (group.stage >= Stage::window) records.clear();
  }
  void plane(Handed, auto&) const {}
};

// Whether a window position has no place on a grid of 1/256 pixel in 32 bits, as of a renderer that cuts at no side.
bool reaches_beyond_grid(const Records<double>& r) {
  const auto is_beyond = [](const WindowVertex<double>& v) {
    const glm::dvec2 at = glm::abs(place_of(v.p_win));
    return std::isfinite(at.x) && std::isfinite(at.y) && std::max(at.x, at.y) >= kFarthestPlace;
  };
  return std::ranges::any_of(r.triangles, [&](const auto& t) { return std::ranges::any_of(t.v, is_beyond); });
}

// Whether a polygon's own corner lies at least half as far; where no polygon is handed out, one may.
bool may_reach_beyond_grid(const FrameFormat& frame, std::span<const ClipVertex<double>> corners) {
  const double farthest = kFarthestPlace / 2 / kSubpixel;  // [pixels]
  const auto is_beyond = [&](const ClipVertex<double>& v) {
    const glm::dvec2 at = 0.5 * glm::dvec2(frame.width, frame.height) * glm::abs(glm::dvec2(v.p_clip));
    return std::max(at.x, at.y) >= farthest * std::abs(v.p_clip.w);
  };
  return corners.empty() || std::ranges::any_of(corners, is_beyond);
}

glm::ivec2 snapped_place(const Vec3<double>& p_win, std::size_t record, const Conventions& conventions) {
  const glm::dvec2 steps = place_of(p_win);
  if (!(std::abs(steps.x) < kFarthestPlace && std::abs(steps.y) < kFarthestPlace)) {
    throw std::invalid_argument(
        fmt::format("window.snapped: left out, and the p_win of record {} is ({} {}): expected numbers within 2^22 "
                    "pixels, where no "
                    "polygon lies beyond them",
                    record, p_win.x, p_win.y));
  }
  return {snapped(conventions, 0, steps.x), snapped(conventions, 1, steps.y)};
}

Vec3<double> unit(const Vec3<double>& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : v;
}

// Whether a difference of positions is within 8 u of the terms of m p, as stage vertex allows.
bool is_of_roundings(const Vec3<double>& apart, const Mat4<double>& m, const Vec4<double>& p) {
  Vec4<double> terms(0);
  for (int column = 0; column < 4; ++column) terms += glm::abs(m[column] * p[column]);
  for (int k = 0; k < 3; ++k) {
    if (!(std::abs(apart[k]) <= 8 * 0x1p-24 * terms[k])) return false;
  }
  return true;
}

// Positions in eye space: by the matrices; NaN where these are lacking, as a renderer of one matrix has none. Of draws
// with a position varying: that of vertices, where it is shown and rounding alone tells it from the matrices'.
void derive_positions(const DrawIndex& draws, Records<double>& r) {
  const bool has_matrices = r.matrices.size() == draws.ranges().size() && r.vertices.size() == draws.vertices();
  if (!has_matrices) {
    for (Vertex<double>& v : r.vertices) v.p_eye = Vec4<double>(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const std::vector<Vec4<double>>& carried = r.varyings[Varying::position].vertices;
  for (std::size_t d = 0; d < draws.ranges().size(); ++d) {
    const Draw& draw = draws.scene().draws[d];
    const Mesh& mesh = draws.scene().meshes[draw.mesh];
    const bool are_carried = carries(draws.scene(), draw, Varying::position) && carried.size() == draws.vertices();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const std::size_t i = draws.ranges()[d].first_vertex + v;
      const Vec4<double> p_model(Vec3<double>(mesh.positions[v]), 1);
      Vec4<double>& p_eye = r.vertices[i].p_eye;
      p_eye = r.matrices[d].model_view * p_model;
      if (are_carried && is_of_roundings(Vec3<double>(carried[i] - p_eye), r.matrices[d].model_view, p_model))
        p_eye = Vec4<double>(Vec3<double>(carried[i]), p_eye.w);
    }
  }
}

// Normals by the matrices; NaN without these. Of draws lit per fragment: those that fragments' are interpolated from,
// where they are shown.
void derive_normals(const DrawIndex& draws, Records<double>& r) {
  const std::vector<Vec4<double>>& carried = r.varyings[Varying::normal].vertices;
  if (!r.matrices.empty() && r.matrices.size() != draws.ranges().size())
    throw std::invalid_argument("vertex.n_eye: left out, and matrices.* are not there for all draws");
  if (r.vertices.size() != draws.vertices())
    throw std::invalid_argument(
        fmt::format("vertex.*: expected {} vertices, as the scene has, found {}", draws.vertices(), r.vertices.size()));
  for (std::size_t d = 0; d < draws.ranges().size(); ++d) {
    const Draw& draw = draws.scene().draws[d];
    const Mesh& mesh = draws.scene().meshes[draw.mesh];
    const Mat3<double> by =
        r.matrices.empty() ? Mat3<double>(std::numeric_limits<double>::quiet_NaN()) : r.matrices[d].normal;
    const bool are_carried = carries(draws.scene(), draw, Varying::normal) && carried.size() == draws.vertices();
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
      if (are_carried) {
        const std::size_t i = draws.ranges()[d].first_vertex + v;
        r.vertices[i].n_eye = Vec3<double>(carried[i]);
        continue;
      }
      const Vec3<double> n = by * Vec3<double>(mesh.normals[v]);
      r.vertices[draws.ranges()[d].first_vertex + v].n_eye = draw.normals == Normals::normalize ? unit(n)
                                                             : draw.normals == Normals::rescale
                                                                 ? n / glm::length(by[2])  // OpenGL 2.1 spec, 2.11.3
                                                                 : n;
    }
  }
}

// Whether a corner is a copy of the vertex, up to four roundings by a renderer that stores clip positions in another
// form.
bool is_copy(const Vec4<double>& vertex, const Vec4<double>& corner) {
  const Vec4<double> apart = glm::abs(corner - vertex), size = glm::abs(vertex);
  const double error = 0x1p-22 * std::max({size.x, size.y, size.z, size.w});
  return apart.x <= error && apart.y <= error && apart.z <= error && apart.w <= error;
}

void derive_cut(const DrawIndex& draws, Records<double>& r) {
  if (r.vertices.empty()) {
    for (ClipVertex<double>& corner : r.polygons.vertices) corner.cut = true;
    return;
  }
  if (r.vertices.size() != draws.vertices() && !r.polygons.polygons.empty())
    throw std::invalid_argument("clip.cut: left out, and vertex.* are not there for all vertices");
  for (const ClipPolygon& polygon : r.polygons.polygons) {
    if (!draws.of_primitive(polygon.primitive))
      throw std::invalid_argument(
          fmt::format("clip.polygon.primitive: {}, which the scene does not have", polygon.primitive));
    const glm::uvec3 corners = draws.corners(polygon.primitive);
    bool found[3] = {false, false, false};  // a vertex is one corner: another one in its place was made by a cut
    for (std::size_t i = polygon.first; i < std::size_t{polygon.first} + polygon.count; ++i) {
      ClipVertex<double>& corner = r.polygons.vertices[i];
      corner.cut = true;
      for (int k = 0; k < 3 && corner.cut; ++k) {
        if (found[k] || !is_copy(r.vertices[corners[k]].p_clip, corner.p_clip)) continue;
        found[k] = true;
        corner.cut = false;
      }
    }
  }
}

// Side on which the triangle's third place lies of the line through the first two: 1 left of it, -1 right, 0 on it.
template <class Place>
int side_of(const WindowTriangle<double>& t, Place place) {
  const auto a = place(t.v[0]), e1 = place(t.v[1]) - a, e2 = place(t.v[2]) - a;
  return int{e1.x * e2.y > e1.y * e2.x} - int{e1.x * e2.y < e1.y * e2.x};
}
int unsnapped_side(const WindowTriangle<double>& t) {
  return side_of(t, [](const WindowVertex<double>& v) { return glm::vec<2, long double>(v.p_win); });
}

// Positions are below 2^30 (require_in_range()), differences below 2^31, products below 2^62.
int snapped_side(const WindowTriangle<double>& t, const Conventions& conventions) {
  if (conventions.subpixel_bits == Conventions::kFloat) return unsnapped_side(t);
  if (conventions.subpixel_bits <= 8)
    return side_of(t, [](const WindowVertex<double>& v) { return glm::i64vec2(v.snapped); });
  return side_of(t, [&](const WindowVertex<double>& v) {  // snapped is too coarse
    return glm::vec<2, long double>(on_grid(conventions, 0, v.p_win.x), on_grid(conventions, 1, v.p_win.y));
  });
}

// Whether the area by equation 3.6 (OpenGL 2.1) in float may have either sign: its six products and their sum round by
// 6 u of the products, and the positions by 2 u.
bool may_face_either_way(const WindowTriangle<double>& t) {
  long double area = 0, products = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec<2, long double> p(t.v[i].p_win), q(t.v[(i + 1) % 3].p_win);
    area += p.x * q.y - p.y * q.x;
    products += std::abs(p.x * q.y) + std::abs(p.y * q.x);
  }
  return std::abs(area) <= 8 * 0x1p-24L * products;
}

// Facing of a triangle that its draw has not culled: by the snapped corners, unless that face is culled, and the
// triangle has no area on the grid, or may have the other face without snapping.
bool faces_front(const WindowTriangle<double>& t, const Draw& draw, const Conventions& conventions) {
  const int side = snapped_side(t, conventions);
  const bool front = side > 0, is_culled = draw.cull == (front ? Cull::front : Cull::back);
  if (!is_culled) return front;
  const bool is_other = side == 0 || (unsnapped_side(t) > 0) != front || may_face_either_way(t);
  return is_other ? !front : front;
}

// Range check: |snapped| < 2^30, so that differences fit 32 bits and their products 64; width 1 to 64 [pixels].
void require_in_range(const WindowTriangle<double>& t, std::size_t record) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 30;  // [1/256 pixel]
  constexpr std::uint32_t kWidest = 64;
  for (const WindowVertex<double>& v : t.v) {
    const glm::i64vec2 p = glm::abs(glm::i64vec2(v.snapped));
    if (std::max(p.x, p.y) >= kFarthest)
      throw std::invalid_argument(
          fmt::format("window.snapped: record {} is at ({}, {}) [1/256 pixel]: expected numbers between {} and {}",
                      record, v.snapped.x, v.snapped.y, -kFarthest, kFarthest));
  }
  if (t.width < 1 || t.width > kWidest)
    throw std::invalid_argument(
        fmt::format("window.width: record {}: expected 1 to {}, found {}", record, kWidest, t.width));
}

void derive_window(const DrawIndex& draws, const Conventions& conventions, Capture& c) {
  const auto lacks = [&](const char* column) { return c.derived.contains(column); };
  for (std::size_t i = 0; i < c.records.triangles.size(); ++i) {
    WindowTriangle<double>& t = c.records.triangles[i];
    if (draws.draw(t.primitive) == nullptr)
      throw std::invalid_argument(
          fmt::format("window.primitive: record {} is of primitive {}, which the scene does not have", i, t.primitive));
    const Draw& draw = *draws.draw(t.primitive);
    const Topology topology = draws.scene().meshes[draw.mesh].topology;
    const bool filled = is_filled(draw);
    for (const char* column : {"window.front", "window.corners"}) {
      if (topology == Topology::triangles && !filled && lacks(column))
        throw std::invalid_argument(std::string(column) + ": left out, and a draw's polygons are not filled");
    }
    if (lacks("window.corners")) t.corners = corner_count(topology);
    if (lacks("window.width")) {
      t.width = static_cast<std::uint32_t>(t.corners == 3 ? 1 : t.corners == 2 ? draw.line_width : draw.point_size);
    }
    if (lacks("window.snapped")) {
      for (WindowVertex<double>& v : t.v) v.snapped = snapped_place(v.p_win, i, conventions);
    }
    require_in_range(t, i);
    if (lacks("window.front")) t.front = t.corners < 3 || faces_front(t, draw, conventions);
  }
}

// ---- depths

// Largest distance of a depth in [0,1] from code / (2^n - 1), where the depth was computed from the code, such as
// 1 - code' / (2^n - 1): 8 roundings, each of 2^-53 in double. From codes of 16 bits, depths may be computed in float:
// 8 roundings of 2^-24 are 1/32 of a code.
double code_roundings(double codes) { return codes < 0x1p20 ? 0x1p-21 : 0x1p-50; }

// Codes of depths that were floats in `range` when they were read. Depths that are not all floats of codes stay: they
// are not rounded yet.
void find_codes(double codes, Conventions::DepthRange range, std::span<double> depths) {
  const auto code = [=](double z) { return std::nearbyint(z * codes) / codes; };
  const auto is_float_of_code = [&](double z) { return rounded_in_range(range, code(z)) == z; };
  if (codes == 0 || !std::ranges::all_of(depths, is_float_of_code)) return;
  for (double& z : depths) z = code(z);
}

// ---- order

// Sorts all groups whose records belong to triangles, or to fragments, by the order; except coverage, from which the
// order of fragments was found.
struct Reordering {
  Per of;
  const Order& order;
  void group(Handed group, const auto&, auto& records) const {
    if (per(group.stage) == of && group.stage != Stage::coverage) reorder(records, order);
  }
  void plane(Handed, auto&) const {}
};

void sort_triangles(Capture& c) {
  Records<double>& r = c.records;
  const auto order = order_by(r.triangles, [&](std::size_t i) { return r.triangles[i].primitive; });
  if (!order) return;
  std::vector<std::uint32_t> now(order->size());
  for (std::size_t i = 0; i < order->size(); ++i) now[(*order)[i]] = static_cast<std::uint32_t>(i);
  visit_capture(Reordering{Per::triangle, *order}, c);
  for (Covered& covered : r.covered)
    covered.triangle = covered.triangle < now.size() ? now[covered.triangle] : covered.triangle;
}

void sort_fragments(Capture& c) {
  std::vector<Covered>& covered = c.records.covered;
  const auto order = order_by(covered, [&](std::size_t i) { return draw_order(covered[i]); });
  if (!order) return;
  visit_capture(Reordering{Per::fragment, *order}, c);
  reorder(covered, *order);
}

// ---- varyings

// Draw of each record of the owners; none: no such vertex or primitive in the scene, or an index that points outside.
std::vector<const Draw*> draws_of(const DrawIndex& draws, const Records<double>& r, Per per) {
  std::vector<const Draw*> out(owners_of(r, per).count, nullptr);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (per == Per::vertex) {
      const auto number = draws.of_vertex(i);
      out[i] = number ? &draws.scene().draws[*number] : nullptr;
    } else if (per == Per::triangle) {
      out[i] = draws.draw(r.triangles[i].primitive);
    } else if (per == Per::fragment && r.covered[i].triangle < r.triangles.size()) {
      out[i] = draws.draw(r.triangles[r.covered[i].triangle].primitive);
    }
  }
  for (const ClipPolygon& polygon : r.polygons.polygons) {
    const std::size_t end = std::min<std::size_t>(std::size_t{polygon.first} + polygon.count, out.size());
    for (std::size_t i = polygon.first; per == Per::clip_vertex && i < end; ++i) out[i] = draws.draw(polygon.primitive);
  }
  return out;
}

// Sets the varyings to 0 that a record's draw does not carry, whatever the renderer left there.
struct ClearUnused {
  const DrawIndex& draws;
  const Records<double>& all;
  void group(Handed group, const auto&, auto& records) const {
    if (!group.varying || records.empty()) return;
    const std::vector<const Draw*> of = draws_of(draws, all, group.per);
    for (std::size_t i = 0; i < std::min(of.size(), records.size()); ++i) {
      if (of[i] != nullptr && !carries(draws.scene(), *of[i], *group.varying)) records[i] = {};
    }
  }
  void plane(Handed, auto&) const {}
};

}  // namespace

void complete_records(const Scene& scene, Capture& capture, const Conventions& conventions, Depths depths) {
  const DrawIndex draws(scene);
  Records<double>& r = capture.records;
  std::ranges::stable_sort(r.polygons.polygons, {}, &ClipPolygon::primitive);
  if (capture.derived.contains("vertex.p_eye")) derive_positions(draws, r);
  if (capture.derived.contains("vertex.n_eye")) derive_normals(draws, r);
  if (capture.derived.contains("clip.cut")) derive_cut(draws, r);
  if (capture.derived.contains("texture.lod")) {
    for (Texel<double>& texel : r.texels) texel.lod = std::numeric_limits<double>::quiet_NaN();
  }
  const bool is_beyond = reaches_beyond_grid(r) && may_reach_beyond_grid(scene.frame, r.polygons.vertices);
  if (capture.derived.contains("window.snapped") && is_beyond) visit_capture(ClearFromWindow{}, capture);
  derive_window(draws, conventions, capture);
  sort_triangles(capture);
  sort_fragments(capture);
  visit_capture(ClearUnused{draws, r}, capture);
  if (capture.derived.contains("window.snapped")) capture.snapped_by = SnappedBy::conventions;
  capture.derived.clear();
  const DepthFormat format = depth_format_of(scene.frame, conventions);
  const double codes = depth_scale(format);
  if (depths == Depths::of_codes) {
    find_codes(codes, conventions.depth_range, capture.planes.depth.values());
    if (conventions.depth_rounding == Conventions::Rounding::nearest)
      find_codes(codes, conventions.depth_range, r.depth);
  }
  for (double& z : capture.planes.depth.values()) {
    const double code = codes > 0 ? std::nearbyint(z * codes) / codes : z;
    const bool is_float = capture.depth_in_float && depths == Depths::of_codes;
    if (is_float || std::abs(z - code) <= code_roundings(codes)) z = code;
    // A buffer of doubles holds the float, and more.
    if (format == DepthFormat::z32f && std::abs(z) <= static_cast<double>(std::numeric_limits<float>::max()))
      z = static_cast<double>(static_cast<float>(z));
  }
  capture.depth_in_float = false;
}

}  // namespace plumbline
