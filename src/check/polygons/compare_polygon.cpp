// A cut vertex may slide along a nearly parallel edge farther than any bound on coordinates, so it is held to the plane
// of its triangle and to the clip planes that made it.
#include "check/polygons/compare_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "check/bounds/units.h"

namespace plumbline::check {

double ComparedPrimitive::reach() const { return factor * u * corners.scale; }

namespace {

bool is_at_corner(const ClipVertex<double>& v, const Corners& corners, double most) {
  return std::ranges::any_of(corners.p_clip, [&](const Vec4<double>& corner) {
    const Vec4<double> off = glm::abs(v.p_clip - corner);
    return std::max({off.x, off.y, off.z, off.w}) <= most;
  });
}

}  // namespace

void within_triangle(Meter& meter, const ClipVertex<double>& v, const ComparedPrimitive& primitive) {
  const Corners& corners = primitive.corners;
  const double factor = primitive.factor;
  const double from_plane = distance_from_triangle(v, corners);
  meter.value(from_plane / u, factor, primitive.at("off its triangle"), from_plane, 0);
  const auto d = distances(v.p_clip);
  for (std::size_t p = 0; p < corners.planes; ++p)
    meter.value(std::max(-d[p], 0.0) / (u * corners.scale), factor, primitive.at("outside a plane"), d[p], 0);
}

void within_rounding(Meter& meter, Vertices polygon, const ComparedPrimitive& primitive) {
  const Corners& corners = primitive.corners;
  const double factor = primitive.factor;
  for (const ClipVertex<double>& v : polygon) {
    within_triangle(meter, v, primitive);
    const auto d = distances(v.p_clip);
    double nearest = kInfinite;
    int planes = 0;
    for (std::size_t p = 0; p < corners.planes; ++p) {
      nearest = std::min(nearest, std::abs(d[p]));
      planes += std::abs(d[p]) <= factor * u * corners.scale ? 1 : 0;
    }
    if (v.cut) {
      meter.value(nearest / (u * corners.scale), factor, primitive.at("off its plane"), nearest, 0);
      const double to_edge = distance_from_edges(v, corners);
      if (planes < 2) meter.value(to_edge / u, factor, primitive.at("off its edge"), to_edge, 0);
    } else {
      const bool is_copy = is_at_corner(v, corners, primitive.copies * u * corners.scale);
      meter.value(is_copy ? 0 : kInfinite, 0, primitive.at("cut"), 0, 1);
    }
  }
}

namespace {

using ListOfVertices = std::vector<ClipVertex<double>>;

// Marks in `open` the clip planes with an ambiguous cut: a corner of the triangle lies on the plane, or a vertex of the
// polygon lies on the plane and two others, or on the plane, one other and an edge of the triangle.
void open_planes(const Corners& c, Vertices polygon, double tolerance, std::array<bool, 6>& open) {
  for (std::size_t p = 0; p < c.planes; ++p) {
    for (const Vec4<double>& corner : c.p_clip) open[p] |= std::abs(distances(corner)[p]) <= tolerance;
    for (const ClipVertex<double>& v : polygon) {
      std::size_t planes = 0;
      for (std::size_t q = 0; q < c.planes; ++q) planes += on_plane(v, q, tolerance) ? 1 : 0;
      const double to_edge = distance_from_edges(v, c);
      // Three planes meet in a corner of the view volume, its four sides in the eye: a triangle's plane may pass there.
      const bool open_meeting = planes > 2 || (planes > 1 && to_edge <= tolerance / c.scale);
      open[p] |= open_meeting && on_plane(v, p, tolerance);
    }
  }
}

// Removes cut vertices that coincide with a neighbour, colour included: where cuts meet, the order of the cuts decides
// which of them makes the vertex. `planes`: least number of clip planes that must meet at a removed vertex.
void drop_coincident(std::vector<ClipVertex<double>>& polygon, const ComparedPrimitive& primitive, int planes) {
  const Corners& corners = primitive.corners;
  const double factor = primitive.factor;
  const auto meet_at = [&](const ClipVertex<double>& v) {
    int count = 0;
    for (std::size_t p = 0; p < corners.planes; ++p) count += on_plane(v, p, factor * u * corners.scale) ? 1 : 0;
    return count >= planes;
  };
  for (std::size_t i = 0; i < polygon.size() && polygon.size() > 1;) {
    const ClipVertex<double>&v = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const bool coincide = largest_difference(v, next, corners) <= factor * u;
    if (coincide && (v.cut || next.cut) && meet_at(v.cut ? v : next)) {
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(v.cut ? i : (i + 1) % polygon.size()));
    } else {
      ++i;
    }
  }
}

// Cyclic shift of `mine` that brings its corners nearest to those of `theirs`, which has as many. Colours tell corners
// of nearly one place apart: their differences count 2^-10 of those of positions.
std::size_t turn_of(Vertices mine, Vertices theirs, const Corners& corners) {
  std::size_t best = 0;
  double least = kInfinite;
  for (std::size_t turn = 0; turn < mine.size(); ++turn) {
    double sum = 0;
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const ClipVertex<double>&v = mine[(i + turn) % mine.size()], &w = theirs[i];
      sum += 0x1p10 * glm::distance(v.p_clip, w.p_clip) / corners.scale + distance_between(v, w, corners);
    }
    if (sum < least) best = turn;
    least = std::min(least, sum);
  }
  return best;
}

// Vertices of both polygons that have counterparts: not those on planes whose cuts are open; where vertices coincide,
// one of them.
std::pair<ListOfVertices, ListOfVertices> with_counterparts(Vertices all_mine, Vertices all_theirs,
                                                            const ComparedPrimitive& primitive, Cuts cuts,
                                                            const std::array<bool, 6>& open) {
  const auto settled = [&](const ClipVertex<double>& v) {
    for (std::size_t p = 0; p < 6; ++p) {
      if (open[p] && on_plane(v, p, primitive.reach())) return false;
    }
    return true;
  };
  ListOfVertices mine, theirs;
  std::copy_if(all_mine.begin(), all_mine.end(), std::back_inserter(mine), settled);
  std::copy_if(all_theirs.begin(), all_theirs.end(), std::back_inserter(theirs), settled);
  if (all_mine.size() > 2 && (cuts == Cuts::certain || mine.size() != theirs.size())) {
    ListOfVertices fewer_mine = mine, fewer_theirs = theirs;
    drop_coincident(fewer_mine, primitive, cuts == Cuts::open ? 2 : 1);
    drop_coincident(fewer_theirs, primitive, cuts == Cuts::open ? 2 : 1);
    // Vertices may coincide on one side alone, because a cut slides along a nearly parallel edge. Coincident vertices
    // are removed only if both sides then have equally many; else all vertices are compared.
    if (fewer_mine.size() == fewer_theirs.size()) mine.swap(fewer_mine), theirs.swap(fewer_theirs);
  }
  return {std::move(mine), std::move(theirs)};
}

// Compares a vertex of the mesh, or one that stands for it.
void compare_copy(Meter& meter, const ClipVertex<double>& v, const ClipVertex<double>& w,
                  const ComparedPrimitive& primitive) {
  const double unit = u * primitive.corners.scale, copies = primitive.copies;
  for (int c = 0; c < 4; ++c) {
    meter.value(difference(v.p_clip[c], w.p_clip[c]) / unit, copies, primitive.at("p_clip"), v.p_clip[c], w.p_clip[c]);
    meter.value(difference(v.color[c], w.color[c]) / u, copies * primitive.corners.color_scale, primitive.at("color"),
                v.color[c], w.color[c]);
  }
}

// Compares a vertex that a cut made: with the planes, and where there is one plane with the edge, of its counterpart.
void compare_cut(Meter& meter, const ClipVertex<double>& v, const ClipVertex<double>& w,
                 const ComparedPrimitive& primitive) {
  const Corners& corners = primitive.corners;
  const double factor = primitive.factor;
  const double from_plane = distance_from_triangle(v, corners);
  meter.value(from_plane / u, factor, primitive.at("off its triangle"), from_plane, 0);
  const auto d = distances(v.p_clip), d_ref = distances(w.p_clip);
  int planes = 0;
  for (std::size_t p = 0; p < corners.planes; ++p) {
    const bool on = std::abs(d_ref[p]) <= 1e-12 * corners.scale;
    planes += on ? 1 : 0;
    const double off = on ? std::abs(d[p]) : std::max(-d[p], 0.0);
    meter.value(off / (u * corners.scale), factor, primitive.at(on ? "off its plane" : "outside a plane"), d[p],
                d_ref[p]);
  }
  if (planes > 1) return;
  // The vertex lies where one plane cuts an edge: the edge nearest to its counterpart.
  std::size_t edge = 0;
  for (std::size_t i : {1u, 2u}) {
    if (distance_from_edge(w, corners, i) < distance_from_edge(w, corners, edge)) edge = i;
  }
  const double off = distance_from_edge(v, corners, edge);
  meter.value(off / u, factor, primitive.at("off its edge"), off, distance_from_edge(w, corners, edge));
}

void compare_vertex(Meter& meter, const ClipVertex<double>& v, const ClipVertex<double>& w,
                    const ComparedPrimitive& primitive) {
  const Corners& corners = primitive.corners;
  const double most = (primitive.copies + primitive.factor) * u * corners.scale;
  // A cut vertex within rounding of a corner counts as the corner (`copies`).
  const bool as_copy = primitive.copies > 0 && v.cut != w.cut && is_at_corner(w, corners, most);
  meter.value(v.cut == w.cut || as_copy ? 0 : kInfinite, 0, primitive.at("cut"), v.cut, w.cut);
  if (!w.cut || as_copy) {
    compare_copy(meter, v, w, primitive);
  } else {
    compare_cut(meter, v, w, primitive);
  }
}

// Holds the end of a line that is cut on one side alone to its edge.
void compare_open_end(Meter& meter, const ClipVertex<double>& v, const ComparedPrimitive& primitive) {
  meter.ambiguous();
  within_rounding(meter, std::span(&v, 1), primitive);
  meter.value(distance_from_edge(v, primitive.corners, 0) / u, primitive.factor, primitive.at("off its edge"), 0, 0);
}

}  // namespace

void compare_polygon(Meter& meter, Vertices all_mine, Vertices all_theirs, const ComparedPrimitive& primitive,
                     Cuts cuts) {
  const Corners& corners = primitive.corners;
  const double factor = primitive.factor, unit = u * corners.scale;
  std::array<bool, 6> open{};
  if (cuts == Cuts::open) {
    for (const auto& polygon : {all_mine, all_theirs}) open_planes(corners, polygon, primitive.reach(), open);
    within_rounding(meter, all_mine, primitive);
    // Vertices that rounding cannot cut off must be there; an edge may be off by `factor` u in each coordinate.
    for (const ClipVertex<double>& v : clipped(corners, primitive.reach())) {
      meter.value(distance_to_polygon(v.p_clip, all_mine) / unit, 2 * factor, primitive.at("cut off"), 0, 0);
    }
  }
  auto [mine, theirs] = with_counterparts(all_mine, all_theirs, primitive, cuts, open);
  // Different numbers of vertices are ambiguous where a cut is open; within_rounding() above has checked `mine`.
  if (mine.size() != theirs.size() && std::ranges::find(open, true) != open.end()) return meter.ambiguous();
  if (mine.size() != theirs.size()) {
    meter.value(kInfinite, 0, primitive.at("vertices"), static_cast<double>(all_mine.size()),
                static_cast<double>(all_theirs.size()));
    return;
  }
  if (cuts == Cuts::open) meter.ambiguous();
  // A polygon may begin at any of its corners; a line runs from its first to its last.
  const bool is_line = all_mine.size() < 3;
  if (!is_line)
    std::rotate(mine.begin(), mine.begin() + static_cast<std::ptrdiff_t>(turn_of(mine, theirs, corners)), mine.end());
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const ClipVertex<double>&v = mine[i], &w = theirs[i];
    if (is_line && v.cut != w.cut && may_end_in(v, corners, i, primitive.reach())) {
      compare_open_end(meter, v, primitive);
    } else {
      compare_vertex(meter, v, w, primitive);
    }
  }
}

}  // namespace plumbline::check
