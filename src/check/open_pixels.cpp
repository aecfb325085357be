#include "check/open_pixels.h"

#include <algorithm>
#include <cmath>

#include "check/fragment_bounds.h"
#include "check/ledger.h"
#include "scene/draw_of.h"
#include "stages/fragment_outcomes.h"

namespace plumbline::check {

bool tests_alpha(const Scene& scene) {
  return std::ranges::any_of(scene.draws, [](const Draw& d) { return d.alpha_test.has_value(); });
}

namespace {

// A product by 255 in float may bring a reference to another code where it lies between two (llvmpipe makes 76 of 0.3).
Outcomes theirs_of(AlphaTest test, ColorFormat format, double lo, double hi) {
  Outcomes out = alpha_outcomes(test, format, lo, hi);
  if (color_scale(format) == 0) return out;
  const float reference = test.reference;
  for (const float roundings : {-2.0f, 2.0f}) {
    test.reference = reference * (1 + roundings / 16777216.0f);
    const Outcomes near = alpha_outcomes(test, format, lo, hi);
    out = {out.may_pass || near.may_pass, out.may_fail || near.may_fail};
  }
  return out;
}

}  // namespace

Plane<std::uint8_t> open_by_alpha(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  ColorFormat theirs, double factor) {
  const Records<double>& r = candidate.records;
  Plane<std::uint8_t> open(scene.frame.width, scene.frame.height, 0);
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  const FragmentBounds bounds(scene, candidate, reference, factor);
  for (std::size_t i = 0; i < std::min(r.covered.size(), r.shaded.size()); ++i) {
    const Covered& c = r.covered[i];
    if (c.triangle >= r.triangles.size() || c.x >= open.width() || c.y >= open.height()) continue;
    const auto number = draw_of(ranges, r.triangles[c.triangle].primitive);
    if (!number || !scene.draws[*number].alpha_test) continue;
    const Draw& draw = scene.draws[*number];
    const double alpha = r.shaded[i].color.a;
    const FragmentBound bound = bounds.of_fragment(i);
    const double off = bound.color.a + std::abs(bound.along.a) + bound.apart.a;
    const bool mine = alpha_outcomes(*draw.alpha_test, scene.frame.color, alpha, alpha).may_pass;
    const Outcomes other =
        std::isfinite(off) ? theirs_of(*draw.alpha_test, theirs, alpha - off, alpha + off) : Outcomes{true, true};
    if (mine ? other.may_fail : other.may_pass) open(c.x, c.y) = 1;
  }
  return open;
}

namespace {

// How far a reference's depth of a fragment may be from the candidate's.
double depth_error(const Records<double>& r, const OffsetErrors& offsets, std::size_t fragment) {
  const Covered& c = r.covered[fragment];
  const WindowTriangle<double>& triangle = r.triangles[c.triangle];
  const PlaneBounds bounds = bounds_from_origin(triangle, c.x, c.y);
  double by_edge = 0;  // where edges of one triangle meet, either may be the fragment's
  if (triangle.corners == 2) {
    const auto edges = edge_values(r, static_cast<std::int32_t>(triangle.primitive), c.x, c.y);
    for (const EdgeValue& edge : edges) by_edge = std::max(by_edge, std::abs(edge.depth - edges.front().depth));
  }
  return tolerance("osmesa.depth").factor * kUnitRoundoff * (bounds.depth + offsets.of(triangle)) +
         std::abs(bounds.along_depth) + by_edge;
}

}  // namespace

Plane<std::uint8_t> open_by_depth(const Scene& scene, const Capture& candidate) {
  const Records<double>& r = candidate.records;
  const int width = scene.frame.width, height = scene.frame.height;
  Plane<std::uint8_t> open(width, height, 0);
  if (r.drawn.size() != r.covered.size() || r.depth.size() != r.covered.size()) return open;
  struct Held {
    double z, error;
  };
  Plane<Held> held(width, height, {scene.frame.clear_depth, 0});
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  const OffsetErrors offsets(scene);
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    const Covered& c = r.covered[i];
    if (c.triangle >= r.triangles.size() || c.x >= width || c.y >= height) continue;
    const auto number = draw_of(ranges, r.triangles[c.triangle].primitive);
    if (!number) continue;
    const Draw& draw = scene.draws[*number];
    Held& before = held(c.x, c.y);
    const double z = r.depth[i], error = depth_error(r, offsets, i);
    const bool compares = draw.depth_func != DepthFunc::always && draw.depth_func != DepthFunc::never;
    const double apart = std::abs(z - before.z);
    if (compares && !(apart > error + before.error + depth_step(scene.frame.depth, z))) open(c.x, c.y) = 1;
    if (r.drawn[i].drawn && draw.merge.depth_mask) before = {z, error};
  }
  return open;
}

namespace {

template <class T>
void settle(Plane<T>& theirs, const Plane<T>& mine, const Plane<std::uint8_t>& open) {
  if (theirs.size() != open.size() || mine.size() != open.size()) return;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open.values()[i] != 0) theirs.values()[i] = mine.values()[i];
  }
}

}  // namespace

std::uint64_t settle_alpha(const Scene& scene, const Capture& candidate, Stage stage, double factor,
                           Capture& reference) {
  const bool in_float = stage == Stage::attributes || stage == Stage::shade || scene.frame.color == ColorFormat::rgba12;
  const auto open =
      open_by_alpha(scene, candidate, reference, in_float ? ColorFormat::rgba32f : scene.frame.color, factor);
  Planes& theirs = reference.planes;
  settle(theirs.id, candidate.planes.id, open);
  settle(theirs.stencil, candidate.planes.stencil, open);
  settle(theirs.shaded, candidate.planes.shaded, open);
  settle(theirs.color, candidate.planes.color, open);
  settle(theirs.depth, candidate.planes.depth, open);
  return static_cast<std::uint64_t>(std::ranges::count(open.values(), std::uint8_t{1}));
}

}  // namespace plumbline::check
