#include "capture/complete_records.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>

#include "scene/draw_index.h"

namespace plumbline {

namespace {

using Order = std::vector<std::size_t>;

/// Numbers of the records, in the order of their keys; of equal keys as they are.
template <class Record>
Order order_by(const std::vector<Record>& records, auto key) {
  Order order(records.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return key(i); });
  return order;
}

/// A column that does not lie beside the records stays as it is.
template <class T>
void reorder(std::vector<T>& column, const Order& order) {
  if (column.size() != order.size()) return;
  std::vector<T> out;
  out.reserve(order.size());
  for (const std::size_t i : order) out.push_back(column[i]);
  column = std::move(out);
}

// ---- columns

void derive_normals(const DrawIndex& draws, Records<double>& r) {
  if (r.matrices.size() != draws.ranges().size()) return;
  for (std::size_t i = 0; i < std::min(r.vertices.size(), draws.vertices()); ++i) {
    const std::size_t d = draws.of_vertex(i).value();
    const Draw& draw = draws.scene().draws[d];
    const Mat3<double>& m = r.matrices[d].normal;
    const Vec3<double> n(draws.scene().meshes[draw.mesh].normals[i - draws.ranges()[d].first_vertex]);
    const double scale = draw.normals == Normals::normalize ? glm::length(m * n)
                         : draw.normals == Normals::rescale ? glm::length(glm::transpose(m)[2])
                                                            : 1;
    r.vertices[i].n_eye = scale > 0 ? m * n / scale : m * n;
  }
}

void derive_cuts(const DrawIndex& draws, Records<double>& r) {
  for (const ClipPolygon& polygon : r.polygons.polygons) {
    const glm::uvec3 corners = draws.corners(polygon.primitive);
    for (ClipVertex<double>& v : std::span(r.polygons.vertices).subspan(polygon.first, polygon.count)) {
      const auto stands_on = [&](int k) {
        return corners[k] < r.vertices.size() && r.vertices[corners[k]].p_clip == v.p_clip;
      };
      v.cut = !stands_on(0) && !stands_on(1) && !stands_on(2);
    }
  }
}

void derive_window(const DrawIndex& draws, Capture& c) {
  const auto lacks = [&](const char* column) { return c.derived.contains(column); };
  for (WindowTriangle<double>& t : c.records.triangles) {
    const Draw& draw = *draws.draw(t.primitive);
    const Topology topology = draws.scene().meshes[draw.mesh].topology;
    const bool filled = draw.front_mode == PolygonMode::fill && draw.back_mode == PolygonMode::fill;
    for (const char* column : {"window.front", "window.corners"}) {
      if (topology == Topology::triangles && !filled && lacks(column))
        throw std::invalid_argument(std::string(column) + ": left out, and a draw's polygons are not filled");
    }
    if (lacks("window.corners")) t.corners = corner_count(topology);
    if (lacks("window.width")) {
      t.width = static_cast<std::uint32_t>(t.corners == 3 ? 1 : t.corners == 2 ? draw.line_width : draw.point_size);
    }
    if (lacks("window.snapped")) {
      for (WindowVertex<double>& v : t.v) {
        const glm::dvec2 steps = (glm::dvec2(v.p_win) - 0.5) * double{kSubpixel};
        const bool fits = glm::length(steps) < 0x1p30;
        v.snapped = fits ? glm::ivec2(std::nearbyint(steps.x), std::nearbyint(steps.y)) : glm::ivec2(0);
      }
    }
    if (lacks("window.front")) {
      const glm::i64vec2 a(t.v[0].snapped), e1 = glm::i64vec2(t.v[1].snapped) - a,
                                            e2 = glm::i64vec2(t.v[2].snapped) - a;
      t.front = t.corners < 3 || e1.x * e2.y - e1.y * e2.x > 0;
    }
  }
}

// ---- order

/// Window positions of polygons' first corners.
class FirstCorners {
 public:
  FirstCorners(const DrawIndex& draws, const Records<double>& r)
      : draws_(draws), records_(r), known_(r.matrices.size() == draws.ranges().size()) {}

  /// Nothing where the primitive has no polygon.
  std::optional<Vec3<double>> of(std::uint32_t primitive) const {
    const auto& [vertices, polygons] = records_.polygons;
    const auto polygon = std::ranges::lower_bound(polygons, primitive, {}, &ClipPolygon::primitive);
    if (!known_ || polygon == polygons.end() || polygon->primitive != primitive) return std::nullopt;
    const Matrices<double>& m = records_.matrices[draws_.of_primitive(primitive).value()];
    const Vec4<double>& p_clip = vertices[polygon->first].p_clip;
    return Vec3<double>(p_clip) / p_clip.w * m.win_scale + m.win_translate;
  }

 private:
  const DrawIndex& draws_;
  const Records<double>& records_;
  bool known_;
};

/// Turned so that the corner nearest to its polygon's first is the last.
void turn_triangles(const FirstCorners& corners, Records<double>& r) {
  for (std::size_t i = 0; i < r.triangles.size(); ++i) {
    WindowTriangle<double>& t = r.triangles[i];
    const auto first = corners.of(t.primitive);
    if (t.corners != 3 || !first) continue;
    const auto distance = [&](std::size_t k) { return glm::distance(t.v[k].p_win, *first); };
    const std::size_t nearest = distance(0) < distance(1) ? 0 : 1;
    if (!(distance(nearest) < distance(2))) continue;
    const auto turn = static_cast<std::ptrdiff_t>(nearest) + 1;
    std::ranges::rotate(t.v, t.v.begin() + turn);
    for (const Varying v : kAllVaryings) {
      auto& column = r.varyings[v].triangles;
      if (i < column.size()) std::ranges::rotate(column[i], column[i].begin() + turn);
    }
  }
}

void sort_triangles(Records<double>& r) {
  const Order order = order_by(r.triangles, [&](std::size_t i) { return r.triangles[i].primitive; });
  std::vector<std::uint32_t> now(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) now[order[i]] = static_cast<std::uint32_t>(i);
  reorder(r.triangles, order);
  for (const Varying v : kAllVaryings) reorder(r.varyings[v].triangles, order);
  for (Covered& c : r.covered) c.triangle = c.triangle < now.size() ? now[c.triangle] : c.triangle;
}

void sort_fragments(Records<double>& r) {
  const auto key = [&](std::size_t i) {
    const Covered& c = r.covered[i];
    return std::tuple(c.triangle, c.y, c.x);
  };
  const Order order = order_by(r.covered, key);
  reorder(r.depth, order), reorder(r.attributes, order), reorder(r.texels, order);
  reorder(r.shaded, order), reorder(r.drawn, order);
  for (const Varying v : kAllVaryings) reorder(r.varyings[v].fragments, order);
  reorder(r.covered, order);
}

}  // namespace

void complete_records(const Scene& scene, Capture& capture) {
  const DrawIndex draws(scene);
  Records<double>& r = capture.records;
  std::ranges::stable_sort(r.polygons.polygons, {}, &ClipPolygon::primitive);
  if (capture.derived.contains("vertex.n_eye")) derive_normals(draws, r);
  if (capture.derived.contains("clip.cut")) derive_cuts(draws, r);
  derive_window(draws, capture);
  turn_triangles(FirstCorners(draws, r), r);
  sort_triangles(r);
  sort_fragments(r);
}

}  // namespace plumbline
