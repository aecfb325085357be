#include "reference/arithmetic/project.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "capture/float_depth.h"
#include "reference/arithmetic/bounded.h"
#include "reference/arithmetic/color_error.h"
#include "reference/arithmetic/draw_ranges.h"
#include "reference/arithmetic/light.h"
#include "reference/arithmetic/matrices.h"
#include "reference/arithmetic/passes.h"
#include "reference/arithmetic/polygon_offset.h"
#include "reference/arithmetic/widths.h"

namespace plumbline::math {

namespace {

// Bounds on the error of float arithmetic against double. u = 2^-24; A = |P| |M| |p|, component by component.
//   rounding M's and P's entries to float: 1 + 1; the product P M, four products and three sums: 4 (of its terms'
//   sizes); times p: 4.  So a clip coordinate in float is within 10 u A of the one in double (P (M p): the same count),
//   and dividing by w and multiplying by the scale adds 2 u |X/W| <= 2 u A_X / W. With 2 spare: 14.
//   A cut vertex a + t (b - a) adds 3 u of its terms per cut, and at most three planes in a row cut an edge between two
//   mesh vertices: 9, with 1 spare 10, so 24. A convex combination of vertices, each within 14 u A of its place, is
//   within 14 u of the same combination of their A; a cut's errors are of the largest A, as near b rounds b - a of a
//   far a. An error of t moves a cut vertex along the edge: so cut edges obey the same bound.
// A point (X, Y, W) = w d that moves by (eX, eY, eW) moves in the window by (eX - x eW) / w, to first order.
constexpr double kRoundingsUncut = 14;
constexpr double kRoundingsOfCuts = 10;
constexpr double kRoundingsCut = kRoundingsUncut + kRoundingsOfCuts;
/// Roundings of the scaling and translation to the window, of the window's size: 2, and 2 spare.
constexpr double kWindowRoundings = 4;
/// Errors in float of inside_planes()' distances, for a corner of that size.
std::array<double, 6> plane_errors(const Projected& scene, const glm::dvec4& size, double margin, bool deep) {
  const glm::dvec4 error = kRoundingsCut * kFloatRounding * size;
  const double x = error.x + (0.5 * scene.width + margin) * error.w;
  const double y = error.y + (0.5 * scene.height + margin) * error.w;
  if (deep) return {error.w, 0, x, x, y, y};
  const double z = error.z + error.w;
  return {z, z, x, x, y, y};
}

/// A corner's signed distances from the view volume's planes (inside: positive; near and far first), each plus its
/// error in float. `deep`: the eye's plane for the near plane, no far plane.
std::array<double, 6> inside_planes(const Projected& scene, const Corner& c, double margin, bool deep) {
  const glm::dvec2 reach(0.5 * scene.width + margin, 0.5 * scene.height + margin);
  const glm::dvec2 at = glm::dvec2(c.v) + scene.to_frame * c.v.z;
  std::array<double, 6> inside{
      c.v.z + c.z,           c.v.z - c.z, reach.x * c.v.z - at.x, reach.x * c.v.z + at.x, reach.y * c.v.z - at.y,
      reach.y * c.v.z + at.y};
  if (deep) inside[0] = c.v.z, inside[1] = 1;  // the sides meet at the eye; no far plane, at cuts between as well
  const std::array<double, 6> error = plane_errors(scene, c.size, margin, deep);
  for (std::size_t p = 0; p < 6; ++p) inside[p] += error[p];
  return inside;
}

struct Polygon {
  std::array<glm::dvec3, kMostCorners> v;
  std::size_t count = 0;
};

/// The triangle's part inside the first `planes` planes of the view volume, in double.
Polygon part_inside(const Projected& scene, const std::array<const Corner*, 3>& corners, std::size_t planes,
                    bool& cut) {
  struct Vertex {
    glm::dvec3 v;
    std::array<double, 6> inside;
  };
  std::array<Vertex, kMostCorners> in, out;
  std::size_t count = 3;
  for (std::size_t i = 0; i < 3; ++i) in[i] = {corners[i]->v, inside_planes(scene, *corners[i], 0, scene.depth_clamp)};
  for (std::size_t plane = 0; plane < planes; ++plane) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vertex &a = in[i], &b = in[(i + 1) % count];
      if (a.inside[plane] >= 0) out[kept++] = a;
      if ((a.inside[plane] >= 0) == (b.inside[plane] >= 0)) continue;
      const double t = a.inside[plane] / (a.inside[plane] - b.inside[plane]);
      Vertex at{a.v + t * (b.v - a.v), {}};
      for (std::size_t p = 0; p < 6; ++p) at.inside[p] = a.inside[p] + t * (b.inside[p] - a.inside[p]);
      at.inside[plane] = 0;
      out[kept++] = at;
      cut = true;
    }
    std::copy_n(out.begin(), kept, in.begin());
    count = kept;
  }
  Polygon polygon;
  polygon.count = count;
  for (std::size_t i = 0; i < count; ++i) polygon.v[i] = in[i].v;
  return polygon;
}

void set_planes(const std::array<const Corner*, 3>& c, Triangle& t) {
  glm::dvec3 z_sum(0), w_sum(0);
  for (std::size_t i = 0; i < 3; ++i) {
    t.n[i] = glm::cross(c[(i + 1) % 3]->v, c[(i + 2) % 3]->v);
    const double slope = std::hypot(t.n[i].x, t.n[i].y);
    t.per_pixel[i] = slope > 0 ? 1 / slope : 0;
    z_sum += c[i]->z * t.n[i];
    w_sum += t.n[i];
    t.size = i == 0 ? c[i]->size : glm::max(t.size, c[i]->size);
  }
  const double det = glm::dot(c[0]->v, t.n[0]);
  t.sign = det > 0 ? 1 : det < 0 ? -1 : 0;
  t.z_plane = 0.5 / det * z_sum;
  t.w_plane = 1 / det * w_sum;
  // Below 1e-12 of its terms, the determinant is double's own rounding.
  const double terms = glm::dot(glm::abs(c[0]->v), glm::abs(t.n[0]));
  t.flat = !(std::abs(det) > 1e-12 * terms) || !std::isfinite(t.z_plane.z) || !std::isfinite(t.w_plane.z);
}

/// Sets the displacements of the triangle's points at a pixel beyond first order: `reach`, `growth` and `loose`.
/// - An error of e in w multiplies the displacement of a quotient by w / (w - e); from e = w/2 on, beside the eye, the
///   point may be anywhere.
/// - A point is displaced by C / w (float_displacement()), C the mean of the corners' C_i by b_i, plus a constant;
///   b_i / w = e_i / det and 1/w are affine in the window. With g the displacement's slope, it grows by up to g s over
///   s pixels from the point nearest to a pixel. A point at s reaches the pixel if s <= moved + g s: from 1 / (1 - g)
///   times as far. From g = 1/2 on the largest displacement is taken for all.
void set_growth(const Projected& scene, const std::array<const Corner*, 3>& c, Triangle& t) {
  const double of_w = kFloatRounding * t.roundings * t.size.w / t.w_min;
  const glm::dvec2 half(0.5 * scene.width, 0.5 * scene.height);
  const auto moved = [&](const glm::dvec4& size) { return glm::length(glm::dvec2(size) + half * size.w); };
  glm::dvec2 of_corners(0);
  for (std::size_t i = 0; i < 3; ++i) of_corners += moved(c[i]->size) * glm::dvec2(t.n[i]);
  const double grows =
      kFloatRounding * (kRoundingsUncut * glm::length(of_corners) / std::abs(glm::dot(c[0]->v, t.n[0])) +
                        (t.roundings - kRoundingsUncut) * moved(t.size) * glm::length(glm::dvec2(t.w_plane)));
  if (of_w < 0.5) {
    t.reach /= 1 - of_w;
    t.growth = grows < 0.5 ? 1 / (1 - grows) : kInfinity;
  } else {
    t.loose = t.flat = true;
    t.reach = scene.width + scene.height;
  }
}

/// edge_displacement() of the edges of a triangle's visible part; where steps_whole_box(), of all that is between the
/// near and far planes.
glm::dvec2 of_edges(const Projected& scene, const std::array<const Corner*, 3>& c, const Triangle& t,
                    std::span<const glm::dvec2> outline) {
  const glm::dvec2 frame(scene.width, scene.height), half = 0.5 * frame;
  WindowBox box(outline[0] + half);
  for (const glm::dvec2& p : outline) box.add(p + half);
  if (t.cut && steps_whole_box(scene.conventions)) {
    bool cut = false;
    const Polygon whole = part_inside(scene, c, 2, cut);
    for (std::size_t i = 0; i < whole.count; ++i)
      box.add(glm::dvec2(whole.v[i]) / std::max(whole.v[i].z, kFloatRounding * t.size.w) + half);
  }
  return edge_displacement(scene.conventions, box, frame);
}

/// Sets `guarded`: the pieces of a renderer that does not clip at the sides.
void set_guarded(const Projected& scene, const std::array<const Corner*, 3>& c, Triangle& t) {
  bool cut = false;
  const Polygon part = part_inside(scene, c, 2, cut);
  std::array<glm::dvec2, kMostCorners> p_window{};
  glm::dvec2 farthest(0.5 * scene.width, 0.5 * scene.height);
  double w_min = kInfinity;
  for (std::size_t i = 0; i < part.count; ++i) {
    const double w = std::max(part.v[i].z, kFloatRounding * t.size.w);
    w_min = std::min(w_min, w);
    p_window[i] = glm::dvec2(part.v[i]) / w;
    farthest = glm::max(farthest, glm::abs(p_window[i]));
  }
  const std::span corners = std::span(p_window).first(part.count);
  t.guarded = {widths(corners).pieces, {corners.begin(), corners.end()}, 2.0 * farthest, w_min};
}

std::array<const Corner*, 3> corners_of(const Projected& scene, const Triangle& t) {
  return {&scene.corners[t.corner[0]], &scene.corners[t.corner[1]], &scene.corners[t.corner[2]]};
}

/// How far [pixels] from a corner a cut of the edge from there to `to` may lie; `inside`, `error` of the corner and
/// `inside_to` by one plane. 0: the plane does not cut the corner off, or the whole edge lies about the plane. A corner
/// on the plane in double is taken to be on it in float.
double reach_of_cut(const Corner& corner, const Corner& to, double inside, double error, double inside_to) {
  const double by = 2 * error - inside;
  if (inside < 0 || by <= 0 || inside == error || inside_to < 4 * error) return 0;
  const glm::dvec3 cut = corner.v + by / (by + inside_to - 2 * error) * (to.v - corner.v);
  return corner.v.z > 0 && cut.z > 0 ? glm::distance(glm::dvec2(corner.v) / corner.v.z, glm::dvec2(cut) / cut.z) : 0;
}

/// Sets `cuts` and `cut` by the planes that may cut off a corner (a plane through a corner may), and `may_be_cut_off`.
/// Returns true if the near or the far plane is among these planes.
bool set_cuts(const Projected& scene, const std::array<const Corner*, 3>& c, Triangle& t) {
  std::array<bool, 6> may_cut{};
  const auto inside_of = [&](std::size_t i) { return inside_planes(scene, *c[i], 0, scene.depth_clamp); };
  const std::array inside{inside_of(0), inside_of(1), inside_of(2)};
  const bool has_slivers = scene.conventions.subpixel_bits == Conventions::kFloat;
  for (std::size_t i = 0; i < 3; ++i) {
    double reach = 0;
    const auto error = plane_errors(scene, c[i]->size, 0, scene.depth_clamp);
    for (std::size_t p = 0; p < 6; ++p) {
      may_cut[p] |= inside[i][p] < 4 * error[p];
      for (const std::size_t to : {(i + 1) % 3, (i + 2) % 3})
        if (has_slivers) reach = std::max(reach, reach_of_cut(*c[i], *c[to], inside[i][p], error[p], inside[to][p]));
    }
    if (reach > 0) t.may_be_cut_off.push_back({glm::dvec2(c[i]->v) / c[i]->v.z, reach});
  }
  t.cuts = static_cast<int>(std::ranges::count(may_cut, true));
  t.cut |= t.cuts > 0;
  return may_cut[0] || may_cut[1];
}

/// Copies of a scene's corners on the grid, made when they are first asked for.
class CornersOnGrid {
 public:
  explicit CornersOnGrid(Projected& scene) : scene_(scene), copies_(scene.corners.size()) {}
  /// Index of the corner's copy in the scene; nullopt: the corner may be snapped to several places.
  std::optional<std::uint32_t> of(std::uint32_t corner) {
    Copy& copy = copies_[corner];
    if (!std::exchange(copy.is_asked_for, true)) {
      if (const auto placed = on_grid(scene_, scene_.corners[corner])) {
        copy.index = static_cast<std::uint32_t>(scene_.corners.size());
        scene_.corners.push_back(*placed);
      }
    }
    return copy.index;
  }

 private:
  struct Copy {
    bool is_asked_for = false;
    std::optional<std::uint32_t> index;
  };
  Projected& scene_;
  std::vector<Copy> copies_;
};

/// Sets what follows from a triangle's planes and its visible part.
void set_extent(const Projected& scene, const Draw& draw, const std::array<const Corner*, 3>& c, const Polygon& part,
                bool cut_in_depth, Triangle& t) {
  t.roundings = t.cut ? kRoundingsCut : kRoundingsUncut;
  t.ahead = true;
  t.z_min = kInfinity;
  t.z_max = -t.z_min;
  for (const Corner* corner : c) {
    t.ahead &= corner->v.z > 0;
    t.z_min = std::min(t.z_min, 0.5 + 0.5 * corner->z / corner->v.z);
    t.z_max = std::max(t.z_max, 0.5 + 0.5 * corner->z / corner->v.z);
  }
  std::array<glm::dvec2, kMostCorners> p_window{};
  t.w_min = kInfinity;
  glm::dvec3 farthest(0, 0, 1);
  for (std::size_t i = 0; i < part.count; ++i) {
    // A near plane closer to the eye than w's error lets w reach 0: then the triangle may be anywhere.
    const double w = std::max(part.v[i].z, kFloatRounding * t.size.w);
    t.w_min = std::min(t.w_min, w);
    t.w_max = std::max(t.w_max, w);
    p_window[i] = glm::dvec2(part.v[i]) / w;
    farthest = glm::max(farthest, glm::abs(part.v[i] / w));
  }
  t.stepped = of_edges(scene, c, t, std::span(p_window).first(part.count));
  t.reach = displacement(scene, t, farthest, t.w_min);
  set_growth(scene, c, t);
  const std::span corners = std::span(p_window).first(part.count);
  const Widths width = widths(corners);
  t.altitude = t.cut ? width.pieces : width.whole;
  if (t.cut) t.outline.assign(corners.begin(), corners.end());
  if (cut_in_depth) set_guarded(scene, c, t);
  t.offset = polygon_offset(scene, t, draw.polygon_offset);
  t.thin = t.flat || width.whole <= 2 * t.reach;
  const bool front = t.sign > 0;
  t.facing_kept = draw.cull == Cull::none || front == (draw.cull == Cull::back);
  t.drawn = t.facing_kept || t.thin;
}

void set_up(const Projected& scene, const Draw& draw, Triangle& t) {
  const std::array<const Corner*, 3> c = corners_of(scene, t);
  // Two corners at one place: zero area in every renderer.
  if (c[0]->point == c[1]->point || c[1]->point == c[2]->point || c[2]->point == c[0]->point) return;
  const Polygon part = part_inside(scene, c, 6, t.cut);
  if (part.count < 3) return;
  set_planes(c, t);
  const bool cut_in_depth = set_cuts(scene, c, t);
  set_extent(scene, draw, c, part, cut_in_depth, t);
}

/// Copy of the triangle between its corners' places on the grid, for a renderer that interpolates between these places.
/// nullopt: a place is open, a plane may cut the triangle, or float or the grid may change its area or facing.
std::optional<Triangle> on_grid(const Projected& scene, const Draw& draw, CornersOnGrid& copies, const Triangle& t) {
  const Conventions& conventions = scene.conventions;
  const bool goes_by_grid = conventions.attribute_corners == Conventions::Corners::snapped && settles_grid(conventions);
  const bool has_area = t.drawn && !t.flat && t.altitude > 2 * (t.reach - t.snap);
  if (!goes_by_grid || t.cut || !has_area) return std::nullopt;
  Triangle out = t;
  out.step = out.snap = 0;
  for (std::uint32_t& corner : out.corner) {
    const auto copy = copies.of(corner);
    if (!copy) return std::nullopt;
    corner = *copy;
  }
  const std::array<const Corner*, 3> c = corners_of(scene, out);
  set_planes(c, out);
  if (out.flat || out.sign != t.sign) return std::nullopt;
  set_extent(scene, draw, c, {{c[0]->v, c[1]->v, c[2]->v}, 3}, false, out);
  return out.thin ? std::nullopt : std::optional(out);
}

}  // namespace

glm::dvec4 clip_error(const Projected& scene, const Triangle& t, glm::dvec3 d) {
  const glm::dvec3 e =
      glm::max(t.sign * glm::dvec3(glm::dot(t.n[0], d), glm::dot(t.n[1], d), glm::dot(t.n[2], d)), 0.0);
  const double sum = e.x + e.y + e.z;
  if (t.flat || !(sum > 0)) return kFloatRounding * t.roundings * t.size;
  glm::dvec4 of_corners(0);
  for (glm::length_t i = 0; i < 3; ++i)
    of_corners += e[i] / sum * scene.corners[t.corner[static_cast<std::size_t>(i)]].size;
  return kFloatRounding * (kRoundingsUncut * of_corners + (t.roundings - kRoundingsUncut) * t.size);
}

glm::dvec2 float_displacement(const Projected& scene, const glm::dvec4& error, glm::dvec3 d, double w) {
  const glm::dvec2 from_middle = glm::abs(glm::dvec2(d)) + glm::abs(scene.sample);
  return (glm::dvec2(error) + from_middle * error.w) / w +
         kFloatRounding * kWindowRoundings * glm::dvec2(scene.width, scene.height);
}

glm::dvec2 corner_displacement(const Projected& scene, const Corner& c) {
  const double w = c.v.z, of_w = kRoundingsUncut * kFloatRounding * c.size.w / w;
  if (!(w > 0) || !(of_w < 0.5)) return glm::dvec2(kInfinity);
  return float_displacement(scene, kFloatRounding * kRoundingsUncut * c.size, c.v / w, w) /
         (1 - of_w);  // as set_growth() has it
}

double displacement(const Projected& scene, const Triangle& t, glm::dvec3 d, double w) {
  return t.snap + glm::length(float_displacement(scene, kFloatRounding * t.roundings * t.size, d, w) + t.stepped);
}

namespace {

Piece piece_inside(const std::array<double, 6>& a, const std::array<double, 6>& b) {
  Piece piece;
  for (std::size_t p = 0; p < 6; ++p) {
    if (a[p] < 0 && b[p] < 0) return {1, 0};
    const double t = a[p] / (a[p] - b[p]);
    if (a[p] < 0) piece.from = std::max(piece.from, t);
    if (b[p] < 0) piece.to = std::min(piece.to, t);
  }
  return piece;
}

}  // namespace

Piece visible_piece(const Projected& scene, const Corner& j, const Corner& k, double margin) {
  const bool deep = scene.depth_clamp;
  return piece_inside(inside_planes(scene, j, margin, deep), inside_planes(scene, k, margin, deep));
}

Piece piece_in_window(const Projected& scene, const Corner& j, const Corner& k, double margin) {
  return piece_inside(inside_planes(scene, j, margin, true), inside_planes(scene, k, margin, true));
}

Projected project(const Scene& scene, const Conventions& conventions) {
  Projected out;
  out.conventions = conventions;
  out.step = snapping_step(conventions);
  out.snap = std::sqrt(2.0) * out.step;
  out.width = scene.frame.width;
  out.height = scene.frame.height;
  out.lights = light_sources(scene);
  out.light_errors = light_errors(scene, view_matrix(scene));
  out.depth_clamp = scene.depth_clamp;
  out.depth = scene.frame.depth;
  out.sample = sample_offset(scene.frame);
  out.to_frame = out.sample - (0.5 - conventions.sample);
  out.perspective = !std::holds_alternative<Orthographic>(scene.projection);
  for (const Draw& draw : scene.draws) add_corners(scene, draw, out);
  CornersOnGrid copies(out);
  const std::vector<DrawRange> ranges = ranges_of_draws(scene);
  for (std::uint32_t d = 0; d < scene.draws.size(); ++d) {
    const Draw& draw = scene.draws[d];
    for (const glm::uvec3& indices : scene.meshes[draw.mesh].triangles) {
      Triangle t{};
      for (std::size_t i = 0; i < 3; ++i) {
        t.corner[i] = ranges[d].first_vertex + indices[static_cast<glm::length_t>(i)];
      }
      t.draw = d;
      t.step = out.step, t.snap = out.snap;
      t.range = draw.depth_range;
      set_up(out, draw, t);
      if (auto copy = on_grid(out, draw, copies, t)) {
        t.on_grid = static_cast<std::uint32_t>(out.on_grid.size());
        out.on_grid.push_back(std::move(*copy));
      }
      out.triangles.push_back(t);
    }
  }
  return out;
}

}  // namespace plumbline::math
