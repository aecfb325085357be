#include "check/bounds/open_pixels.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "capture/fragment_outcomes.h"
#include "check/bounds/fragment_bounds.h"
#include "check/verdict/ledger.h"

namespace plumbline::check {

bool tests_alpha(const Scene& scene) {
  return std::ranges::any_of(scene.draws, [](const Draw& d) { return d.alpha_test.has_value(); });
}

bool knows_no_color(const Legal& legal) {
  constexpr float kHalfOfRange = 0.5f;
  if (legal.empty()) return false;
  bool has_surface = false;
  for (int y = 0; y < legal.certain.height(); ++y) {
    for (int x = 0; x < legal.certain.width(); ++x) {
      const std::span<const LegalAnswer> answers = legal.at(x, y);
      const auto is_drawn = [](const LegalAnswer& a) { return a.primitive != kBackground; };
      if (std::ranges::none_of(answers, is_drawn)) continue;
      if (!legal.color_lo.empty()) {
        const glm::vec4 range = legal.color_hi(x, y) - legal.color_lo(x, y);
        if (glm::all(glm::lessThan(range, glm::vec4(2 * kHalfOfRange)))) return false;
      } else if (std::ranges::all_of(answers, [](const LegalAnswer& a) { return a.color_bound < kHalfOfRange; })) {
        return false;
      }
      has_surface = true;
    }
  }
  return has_surface;
}

bool may_be_empty(const Legal& legal) {
  if (legal.empty() || !legal.color_lo.empty()) return false;
  bool is_all_background = true;
  for (int y = 0; y < legal.certain.height(); ++y) {
    for (int x = 0; x < legal.certain.width(); ++x) {
      const std::span<const LegalAnswer> answers = legal.at(x, y);
      const auto of_background = std::ranges::count(answers, kBackground, &LegalAnswer::primitive);
      if (of_background == 0) return false;
      is_all_background = is_all_background && of_background == std::ssize(answers);
    }
  }
  return !is_all_background;
}

namespace {

// Outcomes of a reference's alpha test. Its float product of 255 and a test value half way between two codes may go to
// either code (llvmpipe makes 76 of 0.3).
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
  const DrawIndex draws(scene);
  const FragmentBounds bounds(scene, candidate, reference, factor);
  for (std::size_t i = 0; i < std::min(r.covered.size(), r.shaded.size()); ++i) {
    const Covered& c = r.covered[i];
    if (c.triangle >= r.triangles.size() || c.x >= open.width() || c.y >= open.height()) continue;
    const Draw* draw = draws.draw(r.triangles[c.triangle].primitive);
    if (draw == nullptr || !draw->alpha_test) continue;
    const double alpha = r.shaded[i].color.a;
    const FragmentBound bound = bounds.of_fragment(i);  // with a reason, its texel may be another by Mesa's mistake
    const double off = bound.color.a + std::abs(bound.line_shift.a) + bound.apart.a;
    const bool mine = alpha_outcomes(*draw->alpha_test, scene.frame.color, alpha, alpha).may_pass;
    const Outcomes other = std::isfinite(off) && bound.reason.empty()
                               ? theirs_of(*draw->alpha_test, theirs, alpha - off, alpha + off)
                               : Outcomes{true, true};
    if (mine ? other.may_fail : other.may_pass) open(c.x, c.y) = 1;
  }
  // A fragment that the reference alone has is of unknown alpha; coverage judges whether it may be there.
  const Planes &a = candidate.planes, &b = reference.planes;
  for (int y = 0; a.count.size() == open.size() && b.count.size() == open.size() && y < open.height(); ++y) {
    for (int x = 0; x < open.width(); ++x) {
      if (b.count(x, y) > a.count(x, y)) open(x, y) = 1;
    }
  }
  return open;
}

namespace {

// Bound of a reference's unrounded depth of a fragment against the candidate's depth, which is rounded to the frame's
// format (half a step) [window z]. Where edges of one triangle meet, the reference may hold any of their values.
double depth_error(const Records<double>& r, const OffsetErrors& offsets, std::size_t fragment,
                   const DepthLimits& limits, DepthFormat format) {
  const Covered& c = r.covered[fragment];
  const WindowTriangle<double>& triangle = r.triangles[c.triangle];
  const PlaneBounds bounds = bounds_from_origin(triangle, c.x, c.y, limits);
  const double z = r.depth[fragment];
  if (area_may_vanish(triangle)) return std::numeric_limits<double>::infinity();
  double apart = std::abs(bounds.line_shift_depth), arithmetic = bounds.depth;
  if (triangle.corners == 2) {
    const auto primitive = static_cast<std::int32_t>(triangle.primitive);
    for (const EdgeValue& edge : edge_values(triangles_of(r, primitive), c.x, c.y, limits)) {
      apart = std::max(apart, std::abs(edge.depth - z));
    }
    arithmetic = primitive_bounds(r, primitive, c.x, c.y, limits).depth;
  }
  return tolerance(Profile::opengl, Stage::depth).factor * kFloatRounding * (arithmetic + offsets.of(triangle)) +
         apart + depth_step(format, z) / 2;
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
  const DrawIndex draws(scene);
  const OffsetErrors offsets(scene);
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    const Covered& c = r.covered[i];
    if (c.triangle >= r.triangles.size() || c.x >= width || c.y >= height) continue;
    const std::uint32_t primitive = r.triangles[c.triangle].primitive;
    const Draw* draw = draws.draw(primitive);
    if (draw == nullptr) continue;
    Held& before = held(c.x, c.y);
    const DepthLimits limits = depth_limits(draws, static_cast<std::int32_t>(primitive));
    const double z = r.depth[i], error = depth_error(r, offsets, i, limits, scene.frame.depth);
    const bool compares = draw->depth_func != DepthFunc::always && draw->depth_func != DepthFunc::never;
    const double apart = std::abs(z - before.z);  // depths that round to one code are within a step of each other
    if (compares && !(apart > error + before.error + depth_step(scene.frame.depth, z))) open(c.x, c.y) = 1;
    if (r.drawn[i].drawn && draw->merge.depth_mask) before = {z, error};
  }
  return open;
}

Plane<std::uint8_t> open_by_double(const FrameFormat& frame, const Records<double>& r) {
  Plane<std::uint8_t> open(frame.width, frame.height, 0);
  if (frame.depth != DepthFormat::z32f || r.depth.size() != r.covered.size()) return open;
  const FragmentsByPixel fragments = FragmentsByPixel::covered(frame, r);
  std::vector<double> depths;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      depths.assign(1, frame.clear_depth);
      fragments.each(x, y, [&](std::size_t i) {
        if (!std::isnan(r.depth[i])) depths.push_back(r.depth[i]);
      });
      std::ranges::sort(depths);
      const auto share_a_float = [](double a, double b) {
        return a != b && static_cast<float>(a) == static_cast<float>(b);
      };
      open(x, y) = std::ranges::adjacent_find(depths, share_a_float) == depths.end() ? 0 : 1;
    }
  }
  return open;
}

LegalWinners::LegalWinners(const Scene& scene, const Records<double>& records)
    : scene_(scene),
      records_(records),
      draws_(scene),
      offsets_(scene),
      fragments_(FragmentsByPixel::covered(scene.frame, records)) {}

bool LegalWinners::is_drawn_again(std::size_t a, std::size_t b) const {
  const WindowTriangle<double>&of_a = records_.triangles[records_.covered[a].triangle],
        &of_b = records_.triangles[records_.covered[b].triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    if (of_a.v[k].p_win != of_b.v[k].p_win) return false;
  }
  return of_a.corners == of_b.corners && of_a.width == of_b.width &&
         placed_alike(*draws_.draw(of_a.primitive), *draws_.draw(of_b.primitive));
}

std::vector<LegalAnswer> LegalWinners::at(int x, int y) const {
  std::vector<Hit> hits;
  std::vector<std::size_t> at;  // the hits' fragments
  fragments_.each(x, y, [&](std::size_t i) {
    const WindowTriangle<double>& triangle = records_.triangles[records_.covered[i].triangle];
    const Draw* draw = draws_.draw(triangle.primitive);
    if (draw == nullptr) return;
    const DepthLimits limits = depth_limits(draws_, static_cast<std::int32_t>(triangle.primitive));
    const double z = records_.depth[i], error = depth_error(records_, offsets_, i, limits, scene_.frame.depth);
    Hit& hit = hits.emplace_back();
    hit.primitive = triangle.primitive;
    hit.depth_func = draw->depth_func;
    hit.certain = true;
    hit.z_lo = std::isfinite(error) ? std::max(z - error, 0.0) : 0;
    hit.z_hi = std::isfinite(error) ? std::min(z + error, 1.0) : 1;
    hit.depth_mask = draw->merge.depth_mask;
    if (draw->alpha_test) {
      const bool known = i < records_.shaded.size();
      const double alpha = known ? records_.shaded[i].color.a : 0;
      const Outcomes test = alpha_outcomes(*draw->alpha_test, scene_.frame.color, alpha, alpha);
      hit.alpha_passes = !known || test.may_pass;
      hit.alpha_fails = !known || test.may_fail;
    }
    if (draw->stencil) hit.stencil = triangle.front ? &draw->stencil->front : &draw->stencil->back;
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (records_.depth[at[k]] != z || !is_drawn_again(at[k], i)) continue;
      if (hits[k].surface == kNoSurface) hits[k].surface = static_cast<std::int32_t>(k);
      hit.surface = hits[k].surface;
    }
    at.push_back(i);
  });
  std::vector<LegalAnswer> out;
  fold_hits(hits, scene_.frame, out);
  return out;
}

namespace {

// Planes of coverage from which fragments are taken out one by one.
class Removal {
 public:
  Removal(const Capture& from, Plane<std::uint8_t>& open) : open_(open) {
    out_.planes.count = from.planes.count;
    out_.planes.id_sum = from.planes.id_sum;
    out_.records.triangles = from.records.triangles;
    out_.records.covered = from.records.covered;
  }
  void add(const Covered& c, std::uint32_t primitive) {
    const bool are_counted = out_.planes.count.size() == open_.size() && out_.planes.id_sum.size() == open_.size();
    if (c.x >= open_.width() || c.y >= open_.height() || !are_counted) return;
    open_(c.x, c.y) = 1;
    out_.planes.count(c.x, c.y) -= 1;  // wraps: removing what was never counted shows
    out_.planes.id_sum(c.x, c.y) -= id_weight(primitive);
  }
  // With the triangles of the primitives `turned` marked as of no corners.
  Capture done(std::span<const std::uint32_t> turned) {
    for (WindowTriangle<double>& t : out_.records.triangles) {
      if (std::ranges::binary_search(turned, t.primitive)) t.corners = 0;
    }
    return std::move(out_);
  }

 private:
  Plane<std::uint8_t>& open_;
  Capture out_;
};

// A capture of the `wanted` triangles alone: input of the referee's stage coverage.
template <class Wanted>
Capture triangles_alone(const Capture& from, const Wanted& wanted) {
  Capture out;
  out.width = from.width;
  out.height = from.height;
  std::ranges::copy_if(from.records.triangles, std::back_inserter(out.records.triangles), wanted);
  return out;
}

}  // namespace

WithoutTurned without_turned(const Scene& scene, const Capture& candidate, const Capture& reference,
                             std::span<const std::uint32_t> turned, Renderer& referee) {
  WithoutTurned out{{}, {}, Plane<std::uint8_t>(scene.frame.width, scene.frame.height, 0)};
  const auto is_turned = [&](const WindowTriangle<double>& t) {
    return std::ranges::binary_search(turned, t.primitive);
  };
  const auto settled = [&](const WindowTriangle<double>& t) { return is_turned(t) && t.corners != 2; };
  const auto remove = [&](Removal& from, const Capture& triangles) {
    const Capture covers = referee.run_stage(scene, Stage::coverage, triangles);
    for (const Covered& c : covers.records.covered) from.add(c, triangles.records.triangles[c.triangle].primitive);
  };
  Removal mine(candidate, out.open), theirs(reference, out.open);
  remove(mine, triangles_alone(candidate, is_turned));
  remove(theirs, triangles_alone(reference, settled));
  for (const Covered& c : reference.records.covered) {
    if (c.triangle >= reference.records.triangles.size()) continue;
    const WindowTriangle<double>& t = reference.records.triangles[c.triangle];
    if (is_turned(t) && t.corners == 2) theirs.add(c, t.primitive);
  }
  out.candidate = mine.done(turned);
  out.reference = theirs.done(turned);
  return out;
}

namespace {

template <class T>
void settle_plane(Plane<T>& theirs, const Plane<T>& mine, const Plane<std::uint8_t>& open) {
  if (theirs.size() != open.size() || mine.size() != open.size()) return;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open.values()[i] != 0) theirs.values()[i] = mine.values()[i];
  }
}

}  // namespace

std::uint64_t copy_open_pixels(const Plane<std::uint8_t>& open, const Planes& candidate, Planes& reference) {
  settle_plane(reference.id, candidate.id, open);
  settle_plane(reference.stencil, candidate.stencil, open);
  settle_plane(reference.texel, candidate.texel, open);
  settle_plane(reference.shaded, candidate.shaded, open);
  settle_plane(reference.color, candidate.color, open);
  settle_plane(reference.depth, candidate.depth, open);
  return static_cast<std::uint64_t>(std::ranges::count(open.values(), std::uint8_t{1}));
}

void copy_open_drawn(const Plane<std::uint8_t>& open, const Records<double>& candidate, Records<double>& reference) {
  const std::size_t fragments = candidate.covered.size();
  if (candidate.drawn.size() != fragments || reference.drawn.size() != fragments) return;
  for (std::size_t i = 0; i < fragments; ++i) {
    const Covered& c = candidate.covered[i];
    if (c.x < open.width() && c.y < open.height() && open(c.x, c.y) != 0) reference.drawn[i] = candidate.drawn[i];
  }
}

std::uint64_t copy_pixels_open_by_alpha(const Scene& scene, const Capture& candidate, Stage stage, double factor,
                                        Capture& reference) {
  // Alpha and its reference are converted with m bits, at least the frame's (OpenGL 2.1 spec, 4.1.4, 2.14.9). We take
  // the frame's, and so does Mesa of 8 bits; of more it compares them in float, which is legal.
  const bool in_float = stage == Stage::attributes || stage == Stage::shade || scene.frame.color != ColorFormat::rgba8;
  const auto open =
      open_by_alpha(scene, candidate, reference, in_float ? ColorFormat::rgba32f : scene.frame.color, factor);
  return copy_open_pixels(open, candidate.planes, reference.planes);
}

}  // namespace plumbline::check
