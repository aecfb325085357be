// Polygons as polygons: the vertices that a cut makes may slide along nearly parallel edges by more than any bound on
// coordinates would allow, so each is held to what defines it: its triangle, and the planes that it was cut by.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "check/bounds/units.h"
#include "check/compare/compare_records.h"
#include "check/compare/legal_polygon.h"
#include "check/compare/matched_by_primitive.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

using Vec8 = std::array<double, 8>;  // clip position over the scale, and colour

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

Vec8 joined(const Vec4<double>& p, const Vec4<double>& color, const Corners& c) {
  const double s = c.scale, k = c.color_scale;
  return {p.x / s, p.y / s, p.z / s, p.w / s, color.r / k, color.g / k, color.b / k, color.a / k};
}

double dot(const Vec8& a, const Vec8& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 8; ++i) sum += a[i] * b[i];
  return sum;
}
Vec8 minus(const Vec8& a, const Vec8& b, double times = 1) {
  Vec8 out;
  for (std::size_t i = 0; i < 8; ++i) out[i] = a[i] - times * b[i];
  return out;
}

double largest(const Vec8& v) {
  double out = 0;
  for (double value : v) out = std::max(out, std::isfinite(value) ? std::abs(value) : kInfinite);
  return out;
}

// How far a vertex (position and colour together) is from being a weighted mean of the three corners: what remains of
// it after the triangle's two directions are taken out (Gram-Schmidt), largest component.
double distance_from_triangle(const ClipVertex<double>& v, const Corners& c) {
  const Vec8 origin = joined(c.p_clip[0], c.color[0], c);
  Vec8 e1 = minus(joined(c.p_clip[1], c.color[1], c), origin);
  Vec8 e2 = minus(joined(c.p_clip[2], c.color[2], c), origin);
  if (dot(e2, e2) > dot(e1, e1)) std::swap(e1, e2);
  if (dot(e1, e1) > 0) e2 = minus(e2, e1, dot(e1, e2) / dot(e1, e1));
  Vec8 rest = minus(joined(v.p_clip, v.color, c), origin);
  if (dot(e1, e1) > 0) rest = minus(rest, e1, dot(rest, e1) / dot(e1, e1));
  if (dot(e2, e2) > 1e-24 * dot(e1, e1)) rest = minus(rest, e2, dot(rest, e2) / dot(e2, e2));
  return largest(rest);
}

// Distance from the line through two corners, likewise.
double distance_from_edge(const ClipVertex<double>& v, const Corners& c, std::size_t i) {
  const std::size_t j = (i + 1) % 3;
  const Vec8 origin = joined(c.p_clip[i], c.color[i], c);
  const Vec8 e = minus(joined(c.p_clip[j], c.color[j], c), origin);
  Vec8 rest = minus(joined(v.p_clip, v.color, c), origin);
  if (dot(e, e) > 0) rest = minus(rest, e, dot(rest, e) / dot(e, e));
  return largest(rest);
}

// The planes whose cuts rounding decides about: a corner lies on one, or an edge goes through the meeting of several,
// as the polygon has it.
void open_planes(const Corners& c, std::span<const ClipVertex<double>> polygon, double tolerance,
                 std::array<bool, 6>& open) {
  for (std::size_t p = 0; p < c.planes; ++p) {
    for (const Vec4<double>& corner : c.p_clip) open[p] |= std::abs(distances(corner)[p]) <= tolerance;
    for (const ClipVertex<double>& v : polygon) {
      std::size_t planes = 0;
      for (std::size_t q = 0; q < c.planes; ++q) planes += on_plane(v, q, tolerance) ? 1 : 0;
      double to_edge = kInfinite;
      for (std::size_t i = 0; i < 3; ++i) to_edge = std::min(to_edge, distance_from_edge(v, c, i));
      // Three planes meet in a corner of the view volume, its four sides in the eye: a triangle's plane may pass there.
      const bool open_meeting = planes > 2 || (planes > 1 && to_edge <= tolerance / c.scale);
      open[p] |= open_meeting && on_plane(v, p, tolerance);
    }
  }
}

std::span<const ClipVertex<double>> vertices_of(const ClipPolygon& polygon, const Records<double>& r) {
  return {r.polygons.vertices.data() + polygon.first, polygon.count};
}

// Vertices that rounding may make: of the triangle, on a plane that cuts them or a corner, and nowhere outside.
template <class At>
void within_rounding(Meter& meter, std::span<const ClipVertex<double>> polygon, const Corners& corners, double factor,
                     const At& at) {
  for (const ClipVertex<double>& v : polygon) {
    meter.value(distance_from_triangle(v, corners) / u, factor, at("off its triangle"), 0, 0);
    const auto d = distances(v.p_clip);
    double nearest = kInfinite;
    int planes = 0;
    for (std::size_t p = 0; p < corners.planes; ++p) {
      meter.value(std::max(-d[p], 0.0) / (u * corners.scale), factor, at("outside a plane"), d[p], 0);
      nearest = std::min(nearest, std::abs(d[p]));
      planes += std::abs(d[p]) <= factor * u * corners.scale ? 1 : 0;
    }
    if (v.cut) {
      meter.value(nearest / (u * corners.scale), factor, at("off its plane"), nearest, 0);
      double to_edge = kInfinite;
      for (std::size_t i = 0; i < 3; ++i) to_edge = std::min(to_edge, distance_from_edge(v, corners, i));
      if (planes < 2) meter.value(to_edge / u, factor, at("off its edge"), to_edge, 0);
    } else {
      const bool corner = std::ranges::find(corners.p_clip, v.p_clip) != corners.p_clip.end();
      meter.value(corner ? 0 : kInfinite, 0, at("cut"), 0, 1);
    }
  }
}

// Leaves out corners made by a cut that equal the next corner, colour included: where cuts meet, their order decides
// which of them makes the corner. `planes`: how many must meet there.
void drop_coincident(std::vector<ClipVertex<double>>& polygon, const Corners& corners, double factor, int planes) {
  const auto meet_at = [&](const ClipVertex<double>& v) {
    int count = 0;
    for (std::size_t p = 0; p < corners.planes; ++p) count += on_plane(v, p, factor * u * corners.scale) ? 1 : 0;
    return count >= planes;
  };
  for (std::size_t i = 0; i < polygon.size() && polygon.size() > 1;) {
    const ClipVertex<double>&v = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const Vec8 apart = minus(joined(v.p_clip, v.color, corners), joined(next.p_clip, next.color, corners));
    const bool coincide = largest(apart) <= factor * u;
    if (coincide && (v.cut || next.cut) && meet_at(v.cut ? v : next)) {
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(v.cut ? i : (i + 1) % polygon.size()));
    } else {
      ++i;
    }
  }
}

// Cyclic shift of `mine` that brings its corners nearest to those of `theirs`, which has as many.
std::size_t turn_of(std::span<const ClipVertex<double>> mine, std::span<const ClipVertex<double>> theirs,
                    const Corners& corners) {
  std::size_t best = 0;
  double least = kInfinite;
  for (std::size_t turn = 0; turn < mine.size(); ++turn) {
    double sum = 0;
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const ClipVertex<double>&v = mine[(i + turn) % mine.size()], &w = theirs[i];
      const Vec8 apart = minus(joined(v.p_clip, v.color, corners), joined(w.p_clip, w.color, corners));
      sum += std::sqrt(dot(apart, apart));
    }
    if (sum < least) best = turn;
    least = std::min(least, sum);
  }
  return best;
}

// `loosely`: vertices on planes whose cuts rounding decides about are held to the triangle and the planes alone.
void compare_polygon(Meter& meter, const ClipPolygon& a, const ClipPolygon& b, const Records<double>& candidate,
                     const Records<double>& reference, const Corners& corners, double factor, bool loosely) {
  const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(a.primitive), field, true}; };
  const double unit = u * corners.scale;
  std::vector<ClipVertex<double>> mine, theirs;  // without those that rounding decides about, where the numbers differ
  const auto all_mine = vertices_of(a, candidate), all_theirs = vertices_of(b, reference);
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
  if (a.count > 2 && (!loosely || mine.size() != theirs.size())) {
    std::vector<ClipVertex<double>> fewer_mine = mine, fewer_theirs = theirs;
    drop_coincident(fewer_mine, corners, factor, loosely ? 2 : 1);
    drop_coincident(fewer_theirs, corners, factor, loosely ? 2 : 1);
    // A cut along a nearly parallel edge slides: its neighbours may coincide on one side alone. Then each of the
    // vertices, where there are as many, is held to its counterpart's planes and edge.
    if (fewer_mine.size() == fewer_theirs.size()) mine.swap(fewer_mine), theirs.swap(fewer_theirs);
  }
  // Where cuts are open, so are the corners that they make; the checks above have held `mine` to its limits.
  if (mine.size() != theirs.size() && std::ranges::find(open, true) != open.end()) return meter.ambiguous();
  if (mine.size() != theirs.size()) {
    meter.value(kInfinite, 0, at("vertices"), a.count, b.count);
    return;
  }
  if (loosely) meter.ambiguous();
  // A polygon may begin at any of its corners; a line runs from its first to its last.
  if (a.count > 2)
    std::rotate(mine.begin(), mine.begin() + static_cast<std::ptrdiff_t>(turn_of(mine, theirs, corners)), mine.end());
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const ClipVertex<double>&v = mine[i], &w = theirs[i];
    if (v.cut != w.cut && a.count < 3 && may_end_in(v, corners, i, factor * unit)) {
      meter.ambiguous();
      within_rounding(meter, std::span(&v, 1), corners, factor, at);
      meter.value(distance_from_edge(v, corners, 0) / u, factor, at("off its edge"), 0, 0);
      continue;
    }
    meter.value(v.cut == w.cut ? 0 : kInfinite, 0, at("cut"), v.cut, w.cut);
    if (!w.cut) {
      for (int c = 0; c < 4; ++c) {
        meter.value(difference(v.p_clip[c], w.p_clip[c]) / unit, 0, at("p_clip"), v.p_clip[c], w.p_clip[c]);
        meter.value(difference(v.color[c], w.color[c]) / u, 0, at("color"), v.color[c], w.color[c]);
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

bool is_cut(std::span<const ClipVertex<double>> polygon) {
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

// visit(mine, theirs) of each primitive's polygon, null on the side that lacks it.
template <class Visit>
void each_polygon(const Records<double>& candidate, const Records<double>& reference, Visit visit) {
  using Run = std::span<const ClipPolygon>;
  matched_by_primitive(Run(candidate.polygons.polygons), Run(reference.polygons.polygons), [&](Run mine, Run theirs) {
    for (std::size_t i = 0; i < std::max(mine.size(), theirs.size()); ++i)
      visit(i < mine.size() ? &mine[i] : nullptr, i < theirs.size() ? &theirs[i] : nullptr);
  });
}

}  // namespace

Measurement compare_polygons(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double factor, bool flat_applies) {
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
  each_polygon(candidate, reference, [&](const ClipPolygon* a, const ClipPolygon* b) {
    const std::uint32_t primitive = a != nullptr ? a->primitive : b->primitive;
    const Corners corners = corners_of(draws, primitive, candidate, flat_applies);
    if (a != nullptr && b != nullptr) {
      const auto compare = [&](Meter& to, bool loosely) {
        compare_polygon(to, *a, *b, candidate, reference, corners, factor, loosely);
      };
      // Vertices of the same number may be others: of a triangle that lies in a plane, the order of cuts decides.
      const bool loosely = a->count != b->count || (a->count > 2 && is_cut(vertices_of(*a, candidate)) &&
                                                    may_cut_otherwise(corners, factor) && fails(compare));
      compare(meter, loosely);
    } else {
      const auto at = [&](const char* field) { return Place{-1, -1, primitive, field, true}; };
      const double tolerance = factor * u * corners.scale;
      const std::vector<ClipVertex<double>> widest =
          a != nullptr ? clipped(corners, -tolerance) : std::vector<ClipVertex<double>>();
      if (!needs_no_cut(corners) &&
          may_vanish(a != nullptr ? std::span(widest) : vertices_of(*b, reference), corners.planes, tolerance)) {
        meter.ambiguous();
        if (a != nullptr) within_rounding(meter, vertices_of(*a, candidate), corners, factor, at);
      } else {
        meter.value(kInfinite, 0, at(a == nullptr ? "polygon lacking" : "polygon extra"), 0, 0);
      }
    }
    meter.item();
  });
  return meter.done();
}

Measurement compare_polygon_positions(const Records<double>& candidate, const Records<double>& reference,
                                      double factor) {
  Meter meter("u");
  each_polygon(candidate, reference, [&](const ClipPolygon* a, const ClipPolygon* b) {
    const ClipPolygon& any = a != nullptr ? *a : *b;
    const auto at = [&](const char* field) {
      return Place{-1, -1, static_cast<std::int64_t>(any.primitive), field, true};
    };
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
  });
  return meter.done();
}

}  // namespace plumbline::check
