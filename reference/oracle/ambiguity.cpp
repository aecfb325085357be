// Edges. A pixel is ambiguous where its centre is within delta of a visible edge. Where centres are spread evenly,
// their expected number is the area of those bands: the integral of 2 delta along the visible edges. Each edge is
// sampled about once per pixel of its length, and a sample counts where its depth passes against that of its pixel's
// winner. An edge that drawn triangles share is counted once, by the largest delta among these triangles. Centres are
// not spread evenly about edges along rows, columns or diagonals of centres, which test scenes have: so the centres
// within the bands are counted, too, in each row or column that the edge crosses, and the larger figure is taken.
// Neither figure depends on depth intervals, groups or folding.
//
// Surfaces that meet. Two depths cannot be told apart where |z1 - z2| <= w, w the sum of the half intervals and a step;
// with s the slope of z1 - z2 that is a band of half width w/s along the line where the surfaces meet. That line passes
// at |z1 - z2|/s from the centre. A pixel whose centre is within r = max(1, w/s) pixels of the line has a share of the
// band of (w/s)/r: over all pixels within r, the shares sum to the band's area. Parallel surfaces have no such line:
// within w of each other they are ambiguous everywhere, except where both are clamped to the same end and where one
// triangle is drawn again, ties that the depth function settles. Bands along the near and far planes are computed
// likewise, w the half interval: for the winner, for surfaces that would win if they were not cut off, and for surfaces
// that stencil values count although their depth test never passes. Where a triangle has no reliable plane, the pixel
// is ambiguous. These lines, too, may run through a row of centres, and again the larger of the area and the number of
// centres in the bands is taken.
//
// Sides of the frame. A side that cuts a triangle is no edge of it, but floats may displace the cut by more than the
// half pixel between the side and the next samples, where corners are far outside the frame and near the eye. Pixels
// that have several legal answers, and a sample that is open by an edge of a cut alone, are counted as they are.
#include "reference/oracle/ambiguity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "capture/capture.h"
#include "capture/fragment_outcomes.h"
#include "reference/arithmetic/depth_format.h"

namespace plumbline::math {

namespace {

/// One sense: all depth functions keep the nearest surface, or all the farthest. Then only meetings with the winner
/// matter; else each function compares with the surface that the one before kept, and hidden surfaces matter, too.
/// (Under stencil tests hidden surfaces always matter: stencil values depend on them.)
template <class Range, class FuncOf>
bool one_sense(const Range& range, FuncOf func_of) {
  const auto all = [&](DepthFunc func, DepthFunc or_equal) {
    return std::all_of(range.begin(), range.end(),
                       [&](const auto& item) { return func_of(item) == func || func_of(item) == or_equal; });
  };
  return all(DepthFunc::less, DepthFunc::less_equal) || all(DepthFunc::greater, DepthFunc::greater_equal);
}

struct Edge {
  std::uint32_t from, to;  // Corner::point of the ends, from < to
  std::uint32_t j, k;      // corners
  std::uint32_t primitive;
  std::uint32_t loosest;  // the primitive of the largest reach among those that share the edge
};

/// The edges of all drawn triangles, shared ones once.
std::vector<Edge> drawn_edges(const Projected& projected) {
  std::vector<Edge> edges;
  for (std::uint32_t primitive = 0; primitive < projected.triangles.size(); ++primitive) {
    const Triangle& t = projected.triangles[primitive];
    if (!t.drawn) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t j = t.corner[i], k = t.corner[(i + 1) % 3];
      const std::uint32_t from = projected.corners[j].point, to = projected.corners[k].point;
      edges.push_back({std::min(from, to), std::max(from, to), j, k, primitive, primitive});
    }
  }
  const auto key = [](const Edge& e) { return std::array{e.from, e.to, e.primitive}; };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  std::vector<Edge> out;
  for (const Edge& e : edges) {
    if (out.empty() || out.back().from != e.from || out.back().to != e.to) {
      out.push_back(e);
    } else if (projected.triangles[e.primitive].reach > projected.triangles[out.back().loosest].reach) {
      out.back().loosest = e.primitive;
    }
  }
  return out;
}

double z_at(const Triangle& t, glm::dvec3 d) {
  return std::clamp(to_window(t, 0.5 + glm::dot(t.z_plane, d)), 0.0, 1.0);
}
double slope_of(const Triangle& t) { return range_scale(t) * (std::abs(t.z_plane.x) + std::abs(t.z_plane.y)); }

/// Visibility of a point of `primitive` at depth z, at a pixel whose winner is `winner`. Depths count as equal within
/// both surfaces' change of depth over a pixel.
bool seen(const Scene& scene, const Projected& projected, std::uint32_t primitive, std::int32_t winner, glm::dvec3 d,
          double z) {
  const Triangle& t = projected.triangles[primitive];
  double held = scene.frame.clear_depth, slack = t.flat ? 0 : slope_of(t);
  if (winner != kBackground) {
    const Triangle& w = projected.triangles[static_cast<std::size_t>(winner)];
    if (static_cast<std::uint32_t>(winner) == primitive || w.flat) return true;
    // A winner that does not write depth hides nothing that is drawn after it.
    if (static_cast<std::uint32_t>(winner) < primitive && !scene.draws[w.draw].merge.depth_mask) return true;
    held = z_at(w, d);
    slack += slope_of(w);
  }
  const DepthFunc func = scene.draws[t.draw].depth_func;
  const bool nearest = func == DepthFunc::less || func == DepthFunc::less_equal;
  return nearest ? z <= held + slack : z >= held - slack;
}

/// The bands along the edges.
struct Bands {
  bool all_seen = false;  ///< hidden edges count as well
  double area = 0;        ///< [pixels]
  Plane<char> near;       ///< 1: the pixel's centre is in a band
};

/// Length of the part of p + t n, t in [-delta, delta], that is within the window of this size.
double within_window(glm::dvec2 p, glm::dvec2 n, double delta, glm::dvec2 window) {
  double from = -delta, to = delta;
  for (int axis = 0; axis < 2; ++axis) {
    if (n[axis] == 0) {
      if (p[axis] < 0 || p[axis] > window[axis]) return 0;
      continue;
    }
    const auto [first, last] = std::minmax({-p[axis] / n[axis], (window[axis] - p[axis]) / n[axis]});
    from = std::max(from, first);
    to = std::min(to, last);
  }
  return std::max(to - from, 0.0);
}

void add_band(const Scene& scene, const Projected& projected, const Edge& edge, const Plane<std::int32_t>& id,
              Bands& bands) {
  const Triangle& t = projected.triangles[edge.primitive];
  const Triangle& loosest = projected.triangles[edge.loosest];
  const Corner &j = projected.corners[edge.j], &k = projected.corners[edge.k];
  const glm::dvec2 window(id.width(), id.height()), half = 0.5 * window;
  // The band of an edge outside the window may reach into the window.
  const Piece piece = visible_piece(projected, j, k, std::min(loosest.reach, window.x + window.y));
  if (piece.from > piece.to) return;
  const auto homogeneous = [&](double at) { return glm::dvec4(j.v, j.z) + at * glm::dvec4(k.v - j.v, k.z - j.z); };
  const glm::dvec4 a = homogeneous(piece.from), b = homogeneous(piece.to);
  if (!(a.z > 0 && b.z > 0)) return;
  const glm::dvec3 from(a.x / a.z, a.y / a.z, 1), to(b.x / b.z, b.y / b.z, 1);
  const glm::dvec3 along = to - from;
  // The point from + s * along in the window, whether it is visible at the nearest pixel, and delta there.
  struct Sample {
    bool seen;
    glm::dvec2 p_win;
    double delta;
  };
  const auto sample = [&](double s) {
    const glm::dvec3 d = from + s * along;
    const glm::dvec2 p_win = glm::dvec2(d) + half;
    const double inv_w = (1 - s) / a.z + s / b.z, z_view = 0.5 + 0.5 * ((1 - s) * a.w / a.z + s * b.w / b.z);
    const auto nearest = glm::ivec2(glm::clamp(p_win, glm::dvec2(0), window - 1.0));
    const double z = std::clamp(to_window(t, z_view), 0.0, 1.0);
    return Sample{bands.all_seen || seen(scene, projected, edge.primitive, id(nearest.x, nearest.y), d, z), p_win,
                  displacement(projected, loosest, d, 1 / inv_w)};
  };
  const double length = glm::length(along);
  if (!(length > 0)) return;
  const glm::dvec2 normal = glm::dvec2(-along.y, along.x) / length;
  const int samples = 1 + static_cast<int>(std::min(length, 65536.0));
  for (int i = 0; i < samples; ++i) {
    const Sample at = sample((i + 0.5) / samples);
    if (at.seen) bands.area += length / samples * within_window(at.p_win, normal, at.delta, window);
  }
  const int major = std::abs(along.x) >= std::abs(along.y) ? 0 : 1, minor = 1 - major;
  const double cosine = std::abs(along[major]) / length;
  // The piece may leave the window by rounding and by its margin, which may be large.
  const auto in_window = [&](double at) { return std::clamp(at + half[major], 0.0, window[major]); };
  const double lo = in_window(std::min(from[major], to[major])), hi = in_window(std::max(from[major], to[major]));
  for (double centre = std::ceil(lo - 0.5) + 0.5; centre <= hi; centre += 1) {
    const double s = (centre - half[major] - from[major]) / along[major];
    const Sample at = sample(std::clamp(s, 0.0, 1.0));
    if (!at.seen) continue;
    const double across = from[minor] + s * along[minor] + half[minor], band = at.delta / cosine;
    const double first = std::max(std::ceil(across - band - 0.5), 0.0),
                 last = std::min(std::floor(across + band - 0.5), window[minor] - 1);
    for (double other = first; other <= last; other += 1) {
      glm::ivec2 pixel(0);
      pixel[major] = std::min(static_cast<int>(centre), static_cast<int>(window[major]) - 1);
      pixel[minor] = static_cast<int>(other);
      bands.near(pixel.x, pixel.y) = 1;
    }
  }
}

}  // namespace

double ambiguous_by_edges(const Scene& scene, const Projected& projected, const Plane<std::int32_t>& id) {
  const bool counted = std::ranges::any_of(scene.draws, [](const Draw& draw) { return draw.stencil.has_value(); });
  const bool all_seen = counted || !one_sense(scene.draws, [](const Draw& draw) { return draw.depth_func; });
  Bands bands{all_seen, 0, {id.width(), id.height(), 0}};
  for (const Edge& edge : drawn_edges(projected)) add_band(scene, projected, edge, id, bands);
  const auto centres = std::count(bands.near.values().begin(), bands.near.values().end(), char{1});
  return std::max(std::min(bands.area, static_cast<double>(id.size())), static_cast<double>(centres));
}

namespace {

constexpr double kBandReach = 1;  // r, in pixels

void operator+=(DepthShare& a, const DepthShare& b) {
  a.area = std::min(1.0, a.area + b.area);
  a.centre = a.centre || b.centre;
}

/// A surface at a pixel, or the cleared depth buffer.
struct Surface {
  std::int64_t order;
  DepthFunc func;
  PixelDepth win, view;
  std::int32_t number = kNoSurface;  ///< Hit::surface
};

/// Share of the pixel in the band where two surfaces meet.
DepthShare meeting(const FrameFormat& frame, const Surface& a, const Surface& b) {
  const DepthFunc later = a.order > b.order ? a.func : b.func;  // the function that compares the two
  if (later == DepthFunc::always || later == DepthFunc::never) return {};
  if (a.number != kNoSurface && a.number == b.number) return {};
  const PixelDepth& held = a.order > b.order ? b.win : a.win;
  if (held.half == 0 && passes_all_over(later, held.z)) return {};
  const double step = depth_step(frame.depth, std::clamp(std::max(a.win.z, b.win.z), 0.0, 1.0));
  const double width = a.win.half + b.win.half + step;
  const double apart = std::abs(a.win.z - b.win.z), slope = glm::length(a.win.slope - b.win.slope);
  const bool clamped = a.win.half == 0 && b.win.half == 0 && (a.win.z == 0 || a.win.z == 1);
  if (clamped && apart == 0) return {};
  const bool within = apart <= width;
  if (slope * kBandReach <= width) return {within ? 1.0 : 0.0, within};
  return {apart <= kBandReach * slope ? width / slope / kBandReach : 0, within};
}

/// Share of the pixel in the band where the near or far plane, at depth `plane`, cuts the surface. The surface is a hit
/// only on the visible side, so each such pixel has the other side's share, too.
DepthShare cut(const PixelDepth& surface, double plane) {
  const double apart = std::abs(surface.z - plane), slope = glm::length(surface.slope);
  const bool within = apart <= surface.half;
  if (slope * kBandReach <= surface.half) return {within ? 1.0 : 0.0, within};
  const bool visible = surface.z >= 0 && surface.z <= 1;
  return {visible && apart <= kBandReach * slope ? 2 * surface.half / slope / kBandReach : 0, within};
}

/// Sum of meeting() over all pairs for which counts(a, b) holds. Surfaces are sorted by depth, and pairs too far apart
/// to meet within their slopes are skipped.
template <class Counts>
DepthShare meetings(const FrameFormat& frame, std::vector<Surface> surfaces, Counts counts) {
  std::ranges::sort(surfaces, {}, [](const Surface& s) { return s.win.z; });
  const auto reach = [](const Surface& s) { return s.win.half + kBandReach * glm::length(s.win.slope); };
  double most = 0;
  for (const Surface& s : surfaces) most = std::max(most, reach(s));
  DepthShare share;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& a = surfaces[i];
    for (std::size_t j = i + 1; j < surfaces.size(); ++j) {
      const Surface& b = surfaces[j];
      const double step = depth_step(frame.depth, std::clamp(b.win.z, 0.0, 1.0));
      if (b.win.z - a.win.z > reach(a) + most + step) break;
      if (counts(a, b)) share += meeting(frame, a, b);
      if (share.area >= 1 && share.centre) return share;
    }
  }
  return share;
}

}  // namespace

DepthShare ambiguous_by_depth(const Scene& scene, std::span<const PixelHit> hits, std::int32_t winner) {
  std::vector<Surface> others, never_drawn;
  const PixelDepth cleared{scene.frame.clear_depth, 0, glm::dvec2(0)};
  Surface won{kBackground, DepthFunc::always, cleared, cleared};
  bool won_writes = true;
  for (const PixelHit& h : hits) {
    const bool never = h.hit.depth_func == DepthFunc::never;
    if ((never && h.hit.stencil == nullptr) || !h.hit.alpha_passes) continue;
    if (!std::isfinite(h.win.half) || h.hit.alpha_fails) return {1, true};
    const bool clamped = h.hit.z_lo == h.hit.z_hi;  // however it is rounded
    const PixelDepth win = clamped ? PixelDepth{h.hit.z_lo, 0, glm::dvec2(0)} : h.win;
    const Surface surface{h.hit.primitive, h.hit.depth_func, win, h.view, h.hit.surface};
    if (never) {
      never_drawn.push_back(surface);
    } else if (static_cast<std::int32_t>(h.hit.primitive) == winner) {
      others.push_back(won);
      won = surface;
      won_writes = h.hit.depth_mask;
    } else {
      others.push_back(surface);
    }
  }
  DepthShare share;
  for (const Surface& other : others) share += meeting(scene.frame, won, other);
  const bool counted = std::ranges::any_of(hits, [](const PixelHit& h) { return h.hit.stencil != nullptr; });
  const bool all_count = counted || !one_sense(hits, [](const PixelHit& h) { return h.hit.depth_func; });
  // After a winner that does not write depth, surfaces are compared with those that the winner hides.
  const auto after = [&](const Surface& s) { return s.order > won.order; };
  if (all_count || !won_writes) {  // else no pair counts
    share += meetings(scene.frame, others,
                      [&](const Surface& a, const Surface& b) { return all_count || after(a) || after(b); });
  }
  if (scene.depth_clamp) return share;
  const auto add_cuts = [&](const Surface& of) {
    share += cut(of.view, 0);
    share += cut(of.view, 1);
  };
  for (const Surface& other : others) {
    const double z = std::clamp(other.win.z, 0.0, 1.0);    // in the near plane, rounding may take it below 0
    const bool is_over_won = !won_writes && after(other);  // no depth of the winner hides it
    if (other.order != kBackground && (counted || is_over_won || passes(other.func, z, won.win.z))) add_cuts(other);
  }
  for (const Surface& of : never_drawn) add_cuts(of);
  if (won.order != kBackground) add_cuts(won);
  return share;
}

}  // namespace plumbline::math
