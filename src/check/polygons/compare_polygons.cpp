#include "check/polygons/compare_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/bounds/matched_by_primitive.h"
#include "check/bounds/units.h"
#include "check/polygons/compare_polygon.h"
#include "check/polygons/join_polygons.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

using PolygonRun = std::span<const ClipPolygon>;

Corners corners_of(const DrawIndex& draws, std::uint32_t primitive, const Records<double>& r, FlatColors of_flat) {
  const glm::uvec3 corners = draws.corners(primitive);
  const bool flat = of_flat == FlatColors::provoking && draws.draw(primitive)->shading == Shading::flat;
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

Vertices vertices_of(const ClipPolygon& polygon, const Records<double>& r) {
  return {r.polygons.vertices.data() + polygon.first, polygon.count};
}

bool is_cut(Vertices polygon) {
  return std::ranges::any_of(polygon, [](const ClipVertex<double>& v) { return v.cut; });
}

// Whether a corner lies on a plane, as far as rounding goes.
bool may_cut_otherwise(const ComparedPrimitive& primitive) {
  const auto on_any = [&](const Vec4<double>& corner) {
    const auto d = distances(corner);
    return std::any_of(d.begin(), d.begin() + static_cast<std::ptrdiff_t>(primitive.corners.planes),
                       [&](double distance) { return std::abs(distance) <= primitive.reach(); });
  };
  return std::ranges::any_of(primitive.corners.p_clip, on_any);
}

// Whether the polygons differ if it is certain which planes cut them.
bool differ_strictly(Vertices mine, Vertices theirs, const ComparedPrimitive& primitive) {
  Meter trial("u");
  compare_polygon(trial, mine, theirs, primitive, Cuts::certain);
  trial.item();
  return trial.done().differing > 0;
}

// All polygons of one primitive, joined to one. Each vertex may be off by `factor` u, so vertices of two parts that
// coincide may be 2 `factor` u apart.
class WholePolygon {
 public:
  WholePolygon(PolygonRun run, const Records<double>& records, const ComparedPrimitive& primitive)
      : corners_(primitive.corners), apart_(2 * primitive.factor * u) {
    for (const ClipPolygon& polygon : run) parts_.push_back(vertices_of(polygon, records));
    if (parts_.size() > 1) joined_ = join_polygons(parts_, corners_, apart_);
  }
  std::span<const Vertices> parts() const { return parts_; }
  bool empty() const { return parts_.empty(); }
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
void within_whole(Meter& meter, std::span<const Vertices> parts, Vertices whole, const ComparedPrimitive& primitive) {
  const double unit = u * primitive.corners.scale;
  for (const Vertices part : parts) {
    for (const ClipVertex<double>& v : part)
      meter.value(distance_to_polygon(v.p_clip, whole) / unit, 2 * primitive.factor, primitive.at("outside"), 0, 0);
  }
}

// Compares parts that do not join with an expected polygon of which some vertices coincide: each expected vertex must
// lie within 2 `factor` u of a part, and each vertex of the parts within 2 `factor` u of the expected polygon.
void compare_parts(Meter& meter, std::span<const Vertices> parts, Vertices whole, const ComparedPrimitive& primitive) {
  const double unit = u * primitive.corners.scale;
  meter.ambiguous();
  for (const ClipVertex<double>& v : whole) {
    double least = kInfinite;
    for (const Vertices part : parts) least = std::min(least, distance_to_polygon(v.p_clip, part));
    meter.value(least / unit, 2 * primitive.factor, primitive.at("cut off"), 0, 0);
  }
  within_whole(meter, parts, whole, primitive);
}

// Compares where a side's polygons do not join to one.
void compare_unjoined(Meter& meter, const WholePolygon& mine, const WholePolygon& theirs,
                      const ComparedPrimitive& primitive) {
  if (theirs.is_one() && !theirs.is_distinct()) {
    compare_parts(meter, mine.parts(), theirs.vertices(), primitive);
  } else {
    meter.value(kInfinite, 0, primitive.at("polygons that do not join"), static_cast<double>(mine.parts().size()),
                static_cast<double>(theirs.parts().size()));
  }
}

void compare_joined(Meter& meter, Vertices mine, Vertices theirs, const ComparedPrimitive& primitive) {
  // Equal counts may still be different vertices: of a triangle in a clip plane, the order of cuts decides.
  const bool may_differ = mine.size() > 2 && is_cut(mine) && may_cut_otherwise(primitive);
  const bool are_open = mine.size() != theirs.size() || (may_differ && differ_strictly(mine, theirs, primitive));
  compare_polygon(meter, mine, theirs, primitive, are_open ? Cuts::open : Cuts::certain);
}

// Compares where one side has no polygon of the primitive: legal if rounding may leave nothing of it.
void compare_lacking(Meter& meter, const WholePolygon& mine, const WholePolygon& theirs,
                     const ComparedPrimitive& primitive) {
  const Corners& corners = primitive.corners;
  if (primitive.is_flat && mine.empty()) return meter.ambiguous();
  const std::vector<ClipVertex<double>> widest =
      mine.empty() ? std::vector<ClipVertex<double>>() : clipped(corners, -primitive.reach());
  const Vertices left = mine.empty() ? theirs.vertices() : std::span(widest);
  if (needs_no_cut(corners) || !may_vanish(left, corners.planes, primitive.reach())) {
    meter.value(kInfinite, 0, primitive.at(mine.empty() ? "polygon lacking" : "polygon extra"), 0, 0);
    return;
  }
  meter.ambiguous();
  if (mine.parts().size() > 1) {
    within_whole(meter, mine.parts(), widest, primitive);
  } else {
    within_rounding(meter, mine.vertices(), primitive);
  }
}

void compare_primitive(Meter& meter, const WholePolygon& mine, const WholePolygon& theirs,
                       const ComparedPrimitive& primitive) {
  for (const Vertices part : mine.parts()) {
    for (const ClipVertex<double>& v : part) {
      if (mine.parts().size() > 1 && v.cut) within_triangle(meter, v, primitive);
    }
  }
  if (mine.empty() || theirs.empty()) {
    compare_lacking(meter, mine, theirs, primitive);
  } else if (primitive.is_flat && mine.vertices().size() != theirs.vertices().size()) {
    meter.ambiguous();
    within_whole(meter, mine.parts(), clipped(primitive.corners, -primitive.reach()), primitive);
  } else if (mine.is_one() && theirs.is_one()) {
    compare_joined(meter, mine.vertices(), theirs.vertices(), primitive);
  } else {
    compare_unjoined(meter, mine, theirs, primitive);
  }
}

// Why the polygons cannot be compared primitive by primitive; empty: they can.
std::string misfit(const DrawIndex& draws, const Records<double>& candidate, const Records<double>& reference) {
  for (const auto* list : {&candidate.polygons.polygons, &reference.polygons.polygons}) {
    const bool fits =
        std::all_of(list->begin(), list->end(), [&](const auto& p) { return p.primitive < draws.primitives(); });
    if (!fits) return "a polygon of a primitive that the scene does not have";
    const auto before = [](const ClipPolygon& a, const ClipPolygon& b) { return a.primitive < b.primitive; };
    if (!std::is_sorted(list->begin(), list->end(), before)) return "not in draw order";
  }
  const bool is_whole = candidate.vertices.size() == draws.vertices() && candidate.lit.size() == draws.vertices();
  return is_whole ? "" : "not one vertex and colour for each of the scene's";
}

}  // namespace

Measurement compare_polygons(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double factor, FlatColors of_flat, double copies) {
  const DrawIndex draws(scene);
  const PolygonRun all_mine(candidate.polygons.polygons), all_theirs(reference.polygons.polygons);
  if (std::string why = misfit(draws, candidate, reference); !why.empty())
    return mismatch("u", std::move(why), std::max(all_mine.size(), all_theirs.size()));
  Meter meter("u");
  matched_by_primitive(all_mine, all_theirs, [&](PolygonRun mine, PolygonRun theirs) {
    const std::uint32_t number = (mine.empty() ? theirs : mine).front().primitive;
    ComparedPrimitive primitive{number, corners_of(draws, number, candidate, of_flat), factor, copies, false};
    const bool is_triangle = scene.meshes[draws.draw(number)->mesh].topology == Topology::triangles;
    primitive.is_flat = copies > 0 && is_triangle && is_flat(primitive.corners, primitive.reach());
    compare_primitive(meter, {mine, candidate, primitive}, {theirs, reference, primitive}, primitive);
    meter.item();
  });
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

namespace {

using Polygon = std::vector<ClipVertex<double>>;

constexpr std::size_t kSides = 4;  // the first of distances()

double largest(double so_far, const Vec4<double>& p) {
  for (int c = 0; c < 4; ++c) so_far = std::max(so_far, std::abs(p[c]));
  return so_far;
}

// Largest coordinate of the primitive's corners; of the polygon alone, where the records lack them.
double scale_of(const DrawIndex& draws, std::uint32_t primitive, const Records<double>& r, const Polygon& polygon) {
  double out = 0;
  if (primitive >= draws.primitives() || r.vertices.size() != draws.vertices()) {
    for (const ClipVertex<double>& v : polygon) out = largest(out, v.p_clip);
    return out;
  }
  const glm::uvec3 corners = draws.corners(primitive);
  for (int i = 0; i < 3; ++i) out = largest(out, r.vertices[corners[i]].p_clip);
  return out;
}

}  // namespace

Records<double> cut_at_sides(const Scene& scene, Records<double> records, double factor) {
  const DrawIndex draws(scene);
  ClipPolygons<double> out;
  for (const ClipPolygon& of : records.polygons.polygons) {
    const auto first = records.polygons.vertices.begin() + static_cast<std::ptrdiff_t>(of.first);
    Polygon polygon(first, first + static_cast<std::ptrdiff_t>(of.count));
    const bool is_ahead = std::ranges::all_of(polygon, [](const auto& v) { return v.p_clip.w > 0; });
    const double unit = u * scale_of(draws, of.primitive, records, polygon);
    for (std::size_t side = 0; side < kSides && of.count > 2 && is_ahead; ++side) {
      const auto is_beyond = [&](const ClipVertex<double>& v) {
        return distances(v.p_clip)[side] < -(kCopiedVertices + (v.cut ? factor : 0)) * unit;
      };
      if (std::ranges::any_of(polygon, is_beyond)) polygon = cut_by(polygon, side, 0);
    }
    if (polygon.empty()) continue;
    out.polygons.push_back(
        {of.primitive, static_cast<std::uint32_t>(out.vertices.size()), static_cast<std::uint32_t>(polygon.size())});
    out.vertices.insert(out.vertices.end(), polygon.begin(), polygon.end());
  }
  records.polygons = std::move(out);
  return records;
}

}  // namespace plumbline::check
