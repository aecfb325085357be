// Comparator of clip polygons. A cut vertex may slide along a nearly parallel edge farther than any bound on
// coordinates, so it is held to the plane of its triangle and to the clip planes that made it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "check/bounds/units.h"
#include "check/compare/clip_distances.h"
#include "check/compare/compare_records.h"
#include "check/compare/join_polygons.h"
#include "check/compare/legal_polygon.h"
#include "check/compare/matched_by_primitive.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

using Vertices = std::span<const ClipVertex<double>>;
using PolygonRun = std::span<const ClipPolygon>;

Corners corners_of(const DrawIndex& draws, std::uint32_t primitive, const Records<double>& r, bool flat_applies) {
  const glm::uvec3 corners = draws.corners(primitive);
  const bool flat = flat_applies && draws.draw(primitive)->shading == Shading::flat;
  Corners out{};
  out.color_scale = 1;
  out.planes = draws.scene().depth_clamp ? 4 : 6;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.p_clip[k] = r.vertices[corners[i]].p_clip;
    out.color[k] = r.lit[corners[flat ? 2 : i]].color;
    for (int c = 0; c < 4; ++c) {
      out.scale = std::max(out.scale, std::abs(out.p_clip[k][c]));
      out.color_scale = std::max(out.color_scale, std::abs(out.color[k][c]));
    }
  }
  return out;
}

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

Vertices vertices_of(const ClipPolygon& polygon, const Records<double>& r) {
  return {r.polygons.vertices.data() + polygon.first, polygon.count};
}

// Holds a vertex to the plane of its triangle and to the inside of the view volume, but for rounding. The triangle's
// edges are not checked.
template <class At>
void within_triangle(Meter& meter, const ClipVertex<double>& v, const Corners& corners, double factor, const At& at) {
  meter.value(distance_from_triangle(v, corners) / u, factor, at("off its triangle"), 0, 0);
  const auto d = distances(v.p_clip);
  for (std::size_t p = 0; p < corners.planes; ++p)
    meter.value(std::max(-d[p], 0.0) / (u * corners.scale), factor, at("outside a plane"), d[p], 0);
}

// Holds each vertex to within_triangle(), a cut vertex also to a clip plane (and, unless on two planes, to an edge),
// any other vertex to a corner of the triangle.
template <class At>
void within_rounding(Meter& meter, Vertices polygon, const Corners& corners, double factor, const At& at) {
  for (const ClipVertex<double>& v : polygon) {
    within_triangle(meter, v, corners, factor, at);
    const auto d = distances(v.p_clip);
    double nearest = kInfinite;
    int planes = 0;
    for (std::size_t p = 0; p < corners.planes; ++p) {
      nearest = std::min(nearest, std::abs(d[p]));
      planes += std::abs(d[p]) <= factor * u * corners.scale ? 1 : 0;
    }
    if (v.cut) {
      meter.value(nearest / (u * corners.scale), factor, at("off its plane"), nearest, 0);
      const double to_edge = distance_from_edges(v, corners);
      if (planes < 2) meter.value(to_edge / u, factor, at("off its edge"), to_edge, 0);
    } else {
      const bool corner = std::ranges::find(corners.p_clip, v.p_clip) != corners.p_clip.end();
      meter.value(corner ? 0 : kInfinite, 0, at("cut"), 0, 1);
    }
  }
}

// Removes cut vertices that coincide with a neighbour, colour included: where cuts meet, the order of the cuts decides
// which of them makes the vertex. `planes`: least number of clip planes that must meet at a removed vertex.
void drop_coincident(std::vector<ClipVertex<double>>& polygon, const Corners& corners, double factor, int planes) {
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

// Cyclic shift of `mine` that brings its corners nearest to those of `theirs`, which has as many.
std::size_t turn_of(Vertices mine, Vertices theirs, const Corners& corners) {
  std::size_t best = 0;
  double least = kInfinite;
  for (std::size_t turn = 0; turn < mine.size(); ++turn) {
    double sum = 0;
    for (std::size_t i = 0; i < mine.size(); ++i)
      sum += distance_between(mine[(i + turn) % mine.size()], theirs[i], corners);
    if (sum < least) best = turn;
    least = std::min(least, sum);
  }
  return best;
}

bool is_at_corner(const ClipVertex<double>& v, const Corners& corners, double most) {
  return std::ranges::any_of(corners.p_clip, [&](const Vec4<double>& corner) {
    const Vec4<double> off = glm::abs(v.p_clip - corner);
    return std::max({off.x, off.y, off.z, off.w}) <= most;
  });
}

// Compares two polygons of one primitive. `loosely`: a vertex on a plane whose cut rounding decides (open_planes()) is
// held by within_rounding() alone, not to a counterpart.
template <class At>
void compare_polygon(Meter& meter, Vertices all_mine, Vertices all_theirs, const Corners& corners, double factor,
                     double copies, bool loosely, const At& at) {
  const double unit = u * corners.scale;
  std::vector<ClipVertex<double>> mine, theirs;  // loosely: without vertices on planes whose cut rounding decides
  std::array<bool, 6> open{};
  if (loosely) {
    for (const auto& polygon : {all_mine, all_theirs}) open_planes(corners, polygon, factor * unit, open);
    within_rounding(meter, all_mine, corners, factor, at);
    // Vertices that rounding cannot cut off must be there; an edge may be off by `factor` u in each coordinate.
    for (const ClipVertex<double>& v : clipped(corners, factor * unit)) {
      meter.value(distance_to_polygon(v.p_clip, all_mine) / unit, 2 * factor, at("cut off"), 0, 0);
    }
  }
  const auto settled = [&](const ClipVertex<double>& v) {
    for (std::size_t p = 0; p < 6; ++p) {
      if (open[p] && on_plane(v, p, factor * unit)) return false;
    }
    return true;
  };
  std::copy_if(all_mine.begin(), all_mine.end(), std::back_inserter(mine), settled);
  std::copy_if(all_theirs.begin(), all_theirs.end(), std::back_inserter(theirs), settled);
  if (all_mine.size() > 2 && (!loosely || mine.size() != theirs.size())) {
    std::vector<ClipVertex<double>> fewer_mine = mine, fewer_theirs = theirs;
    drop_coincident(fewer_mine, corners, factor, loosely ? 2 : 1);
    drop_coincident(fewer_theirs, corners, factor, loosely ? 2 : 1);
    // Vertices may coincide on one side alone, because a cut slides along a nearly parallel edge. Coincident vertices
    // are removed only if both sides then have equally many; else all vertices are compared.
    if (fewer_mine.size() == fewer_theirs.size()) mine.swap(fewer_mine), theirs.swap(fewer_theirs);
  }
  // Different numbers of vertices are ambiguous where a cut is open; within_rounding() above has checked `mine`.
  if (mine.size() != theirs.size() && std::ranges::find(open, true) != open.end()) return meter.ambiguous();
  if (mine.size() != theirs.size()) {
    meter.value(kInfinite, 0, at("vertices"), static_cast<double>(all_mine.size()),
                static_cast<double>(all_theirs.size()));
    return;
  }
  if (loosely) meter.ambiguous();
  // A polygon may begin at any of its corners; a line runs from its first to its last.
  if (all_mine.size() > 2)
    std::rotate(mine.begin(), mine.begin() + static_cast<std::ptrdiff_t>(turn_of(mine, theirs, corners)), mine.end());
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const ClipVertex<double>&v = mine[i], &w = theirs[i];
    if (v.cut != w.cut && all_mine.size() < 3 && may_end_in(v, corners, i, factor * unit)) {
      meter.ambiguous();
      within_rounding(meter, std::span(&v, 1), corners, factor, at);
      meter.value(distance_from_edge(v, corners, 0) / u, factor, at("off its edge"), 0, 0);
      continue;
    }
    // A cut vertex within rounding of a corner counts as the corner (`copies`).
    const bool as_copy = copies > 0 && v.cut != w.cut && is_at_corner(w, corners, (copies + factor) * unit);
    meter.value(v.cut == w.cut || as_copy ? 0 : kInfinite, 0, at("cut"), v.cut, w.cut);
    if (!w.cut || as_copy) {
      for (int c = 0; c < 4; ++c) {
        meter.value(difference(v.p_clip[c], w.p_clip[c]) / unit, copies, at("p_clip"), v.p_clip[c], w.p_clip[c]);
        meter.value(difference(v.color[c], w.color[c]) / u, copies * corners.color_scale, at("color"), v.color[c],
                    w.color[c]);
      }
      continue;
    }
    meter.value(distance_from_triangle(v, corners) / u, factor, at("off its triangle"), 0, 0);
    const auto d = distances(v.p_clip), d_ref = distances(w.p_clip);
    int planes = 0;
    for (std::size_t p = 0; p < corners.planes; ++p) {
      const bool on = std::abs(d_ref[p]) <= 1e-12 * corners.scale;
      planes += on ? 1 : 0;
      const double off = on ? std::abs(d[p]) : std::max(-d[p], 0.0);
      meter.value(off / unit, factor, at(on ? "off its plane" : "outside a plane"), d[p], d_ref[p]);
    }
    if (planes > 1) continue;
    // The vertex lies where one plane cuts an edge: the edge nearest to its counterpart.
    std::size_t edge = 0;
    for (std::size_t i_edge : {1u, 2u}) {
      if (distance_from_edge(w, corners, i_edge) < distance_from_edge(w, corners, edge)) edge = i_edge;
    }
    const double off = distance_from_edge(v, corners, edge);
    meter.value(off / u, factor, at("off its edge"), off, distance_from_edge(w, corners, edge));
  }
}

bool is_cut(Vertices polygon) {
  return std::ranges::any_of(polygon, [](const ClipVertex<double>& v) { return v.cut; });
}

// Whether a corner lies on a plane, as far as rounding goes.
bool may_cut_otherwise(const Corners& corners, double factor) {
  const auto on_any = [&](const Vec4<double>& corner) {
    const auto d = distances(corner);
    return std::any_of(d.begin(), d.begin() + static_cast<std::ptrdiff_t>(corners.planes),
                       [&](double distance) { return std::abs(distance) <= factor * u * corners.scale; });
  };
  return std::ranges::any_of(corners.p_clip, on_any);
}

bool fails(auto compare_strictly) {
  Meter trial("u");
  compare_strictly(trial, false);
  trial.item();
  return trial.done().differing > 0;
}

// All polygons of one primitive, joined to one. Each vertex may be off by `factor` u, so vertices of two parts that
// coincide may be 2 `factor` u apart.
class WholePolygon {
 public:
  WholePolygon(PolygonRun run, const Records<double>& records, const Corners& corners, double factor)
      : corners_(corners), apart_(2 * factor * u) {
    for (const ClipPolygon& polygon : run) parts_.push_back(vertices_of(polygon, records));
    if (parts_.size() > 1) joined_ = join_polygons(parts_, corners_, apart_);
  }
  std::span<const Vertices> parts() const { return parts_; }
  bool is_one() const { return parts_.size() < 2 || !joined_.empty(); }
  Vertices vertices() const { return parts_.size() == 1 ? parts_.front() : Vertices(joined_); }
  // Whether rounding merges no vertices.
  bool is_distinct() const {
    return join_polygons(std::array{vertices()}, corners_, apart_).size() == vertices().size();
  }

 private:
  const Corners& corners_;
  double apart_;
  std::vector<Vertices> parts_;
  std::vector<ClipVertex<double>> joined_;
};

// Holds each vertex of the parts to the polygon `whole`, within 2 `factor` u.
template <class At>
void within_whole(Meter& meter, std::span<const Vertices> parts, Vertices whole, const Corners& corners, double factor,
                  const At& at) {
  for (const Vertices part : parts) {
    for (const ClipVertex<double>& v : part)
      meter.value(distance_to_polygon(v.p_clip, whole) / (u * corners.scale), 2 * factor, at("outside"), 0, 0);
  }
}

// Compares parts that do not join with an expected polygon of which some vertices coincide: each expected vertex must
// lie within 2 `factor` u of a part, and each vertex of the parts within 2 `factor` u of the expected polygon.
template <class At>
void compare_parts(Meter& meter, std::span<const Vertices> parts, Vertices whole, const Corners& corners, double factor,
                   const At& at) {
  meter.ambiguous();
  for (const ClipVertex<double>& v : whole) {
    double least = kInfinite;
    for (const Vertices part : parts) least = std::min(least, distance_to_polygon(v.p_clip, part));
    meter.value(least / (u * corners.scale), 2 * factor, at("cut off"), 0, 0);
  }
  within_whole(meter, parts, whole, corners, factor, at);
}

}  // namespace

Measurement compare_polygons(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double factor, bool flat_applies, double copies) {
  const DrawIndex draws(scene);
  for (const auto* list : {&candidate.polygons.polygons, &reference.polygons.polygons}) {
    const bool fits =
        std::all_of(list->begin(), list->end(), [&](const auto& p) { return p.primitive < draws.primitives(); });
    if (!fits) return mismatch("u", "a polygon of a primitive that the scene does not have", list->size());
    const auto before = [](const ClipPolygon& a, const ClipPolygon& b) { return a.primitive < b.primitive; };
    if (!std::is_sorted(list->begin(), list->end(), before)) return mismatch("u", "not in draw order", list->size());
  }
  if (candidate.vertices.size() != draws.vertices() || candidate.lit.size() != draws.vertices()) {
    return mismatch("u", "not one vertex and colour for each of the scene's", reference.polygons.polygons.size());
  }
  Meter meter("u");
  const auto compare_run = [&](PolygonRun mine, PolygonRun theirs) {
    const std::uint32_t primitive = (mine.empty() ? theirs : mine).front().primitive;
    const Corners corners = corners_of(draws, primitive, candidate, flat_applies);
    const auto at = [&](const char* field) { return Place{-1, -1, primitive, field, true}; };
    const WholePolygon a(mine, candidate, corners, factor), b(theirs, reference, corners, factor);
    for (const Vertices part : a.parts()) {
      for (const ClipVertex<double>& v : part) {
        if (a.parts().size() > 1 && v.cut) within_triangle(meter, v, corners, factor, at);
      }
    }
    if (!mine.empty() && !theirs.empty() && !(a.is_one() && b.is_one())) {
      if (b.is_one() && !b.is_distinct()) {
        compare_parts(meter, a.parts(), b.vertices(), corners, factor, at);
      } else {
        meter.value(kInfinite, 0, at("polygons that do not join"), static_cast<double>(mine.size()),
                    static_cast<double>(theirs.size()));
      }
    } else if (!mine.empty() && !theirs.empty()) {
      const auto compare = [&](Meter& to, bool loosely) {
        compare_polygon(to, a.vertices(), b.vertices(), corners, factor, copies, loosely, at);
      };
      // Equal counts may still be different vertices: of a triangle in a clip plane, the order of cuts decides.
      const std::size_t count = a.vertices().size();
      const bool loosely = count != b.vertices().size() ||
                           (count > 2 && is_cut(a.vertices()) && may_cut_otherwise(corners, factor) && fails(compare));
      compare(meter, loosely);
    } else {
      const double tolerance = factor * u * corners.scale;
      const std::vector<ClipVertex<double>> widest =
          mine.empty() ? std::vector<ClipVertex<double>>() : clipped(corners, -tolerance);
      if (!needs_no_cut(corners) &&
          may_vanish(mine.empty() ? b.vertices() : std::span(widest), corners.planes, tolerance)) {
        meter.ambiguous();
        if (a.parts().size() > 1) {
          within_whole(meter, a.parts(), widest, corners, factor, at);
        } else {
          within_rounding(meter, a.vertices(), corners, factor, at);
        }
      } else {
        meter.value(kInfinite, 0, at(mine.empty() ? "polygon lacking" : "polygon extra"), 0, 0);
      }
    }
    meter.item();
  };
  matched_by_primitive(PolygonRun(candidate.polygons.polygons), PolygonRun(reference.polygons.polygons), compare_run);
  return meter.done();
}

Measurement compare_polygon_positions(const Records<double>& candidate, const Records<double>& reference,
                                      double factor) {
  Meter meter("u");
  const auto compare = [&](std::uint32_t primitive, const ClipPolygon* a, const ClipPolygon* b) {
    const auto at = [&](const char* field) { return Place{-1, -1, primitive, field, true}; };
    if (a == nullptr || b == nullptr) {
      meter.value(kInfinite, 0, at(a == nullptr ? "polygon lacking" : "polygon extra"), 0, 0);
    } else if (a->count != b->count) {
      meter.value(kInfinite, 0, at("vertices"), a->count, b->count);
    } else {
      // Either may begin at any vertex: the turn that fits best counts.
      const auto largest = [&](std::uint32_t turn) {
        double most = 0;
        for (std::uint32_t i = 0; i < a->count; ++i) {
          const Vec4<double>& p = candidate.polygons.vertices[a->first + i].p_clip;
          const Vec4<double>& q = reference.polygons.vertices[b->first + (i + turn) % a->count].p_clip;
          for (int c = 0; c < 4; ++c) {
            const double diff = difference(p[c], q[c]);
            const double ratio = diff == 0 ? 0 : diff / (u * (std::abs(q[c]) + std::abs(q.w)));
            most = std::isnan(ratio) ? kInfinite : std::max(most, ratio);
          }
        }
        return most;
      };
      double least = kInfinite;
      for (std::uint32_t turn = 0; turn < a->count; ++turn) least = std::min(least, largest(turn));
      meter.value(least, factor, at("p_clip"), 0, 0);
    }
    meter.item();
  };
  matched_by_primitive(PolygonRun(candidate.polygons.polygons), PolygonRun(reference.polygons.polygons),
                       [&](PolygonRun mine, PolygonRun theirs) {
                         const std::uint32_t primitive = (mine.empty() ? theirs : mine).front().primitive;
                         for (std::size_t i = 0; i < std::max(mine.size(), theirs.size()); ++i)
                           compare(primitive, i < mine.size() ? &mine[i] : nullptr,
                                   i < theirs.size() ? &theirs[i] : nullptr);
                       });
  return meter.done();
}

}  // namespace plumbline::check
