#include <algorithm>
#include <span>

#include "capture/by_conventions.h"
#include "check/bounds/units.h"
#include "check/compare/compare_planes.h"
#include "check/verdict/ledger.h"

namespace plumbline::check {

Measurement compare_legal_count(const Planes& candidate, const Legal& legal) {
  return compare_planes(candidate.count, legal.certain, "fragments", [&](Meter& meter, int x, int y) {
    const double count = candidate.count(x, y), low = legal.certain(x, y), high = legal.possible(x, y);
    if (low != high) meter.ambiguous();
    meter.value(std::max({low - count, count - high, 0.0}), 0, {x, y, -1, "count"}, count, count < low ? low : high);
  });
}

Measurement compare_legal_winner(const Planes& candidate, const Legal& legal) {
  if (candidate.id.empty() && !candidate.stencil.empty()) {
    return compare_planes(candidate.stencil, legal.certain, "pixels", [&](Meter& meter, int x, int y) {
      const auto answers = legal.at(x, y);
      const std::uint8_t held = candidate.stencil(x, y), first = answers.empty() ? 0 : answers.front().stencil;
      const auto is = [](std::uint8_t value) { return [value](const LegalAnswer& a) { return a.stencil == value; }; };
      if (!std::ranges::all_of(answers, is(first))) meter.ambiguous();
      meter.value(std::ranges::any_of(answers, is(held)) ? 0 : 1, 0, {x, y, -1, "stencil"}, held, first);
    });
  }
  return compare_planes(candidate.id, legal.certain, "pixels", [&](Meter& meter, int x, int y) {
    const auto answers = legal.at(x, y);
    if (answers.size() > 1) meter.ambiguous();
    const std::int32_t id = candidate.id(x, y);
    meter.value(answer_of_winner(legal, candidate, x, y) != nullptr ? 0 : 1, 0, {x, y, -1, "primitive"}, id,
                answers.empty() ? kBackground : answers.front().primitive);
  });
}

namespace {

// True if the candidate shows no winners, or a plane of them of the oracle's size; if not, `why` says so.
bool fits_winners(const Planes& candidate, const Legal& legal, std::string& why) {
  return candidate.id.empty() || same_size(candidate.id, legal.certain, why);
}
std::int32_t winner_at(const Planes& planes, int x, int y) { return planes.id.empty() ? kBackground : planes.id(x, y); }

// True if the background is the only legal answer.
bool is_cleared(std::span<const LegalAnswer> answers) {
  return !answers.empty() &&
         std::ranges::all_of(answers, [](const LegalAnswer& a) { return a.primitive == kBackground; });
}

// Clear depth where only the background is legal: merge judges it; stage depth only for candidates without colour.
void meter_clear_depth(Meter& meter, const Scene& scene, const Planes& candidate, const Legal& legal, int x, int y) {
  std::string why;
  if (candidate.depth.empty() || legal.first.empty() || !same_size(candidate.depth, legal.certain, why)) return;
  const auto answers = answers_of_winner(legal, candidate, x, y);
  if (!is_cleared(answers)) return;
  const LegalAnswer& cleared = answers.front();
  const double z = candidate.depth(x, y), factor = tolerance(Profile::oracle, Stage::depth).factor;
  meter.value(distance_outside(z, cleared.z_lo, cleared.z_hi) / depth_step(scene.frame.depth, z), factor,
              {x, y, -1, "cleared z"}, z, cleared.z_lo);
}

// Rule by which a plane's colours are compared with an answer's.
struct ColorRule {
  StoredColors stored;
  double factor = 1;       // of the answer's bound
  double half_code = 0;    // added to the bound, for rounding to the frame's format
  bool may_clamp = false;  // colours may be clamped to [0, 1]

  double wanted(const LegalAnswer& a, int channel) const {
    const double v = a.color[channel];
    return stored.of_channel(stored.scale > 0 ? std::clamp(v, 0.0, 1.0) : v, channel);
  }
  double bound(const LegalAnswer& a, int channel) const {
    const double v = a.color[channel], off = a.color_bound, middle = stored.of_channel(v, channel);
    if (stored.of_channel(0.5, channel) == 0.5) return off;
    return std::max(stored.of_channel(v + off, channel) - middle, middle - stored.of_channel(v - off, channel));
  }
  // Difference of a channel, in bounds.
  double apart(double got, const LegalAnswer& a, int channel) const {
    const double own = a.color[channel];
    double diff = difference(stored.middle(got), wanted(a, channel));
    if (may_clamp) diff = std::min(diff, difference(got, std::clamp(own, 0.0, 1.0)));
    // The clear colour may be rounded, and encoded, otherwise than fragments are.
    if (a.primitive == kBackground) diff = std::min(diff, difference(got, own));
    return diff == 0 ? 0 : diff / (bound(a, channel) + half_code);
  }
  double farthest(const glm::vec4& color, const LegalAnswer& a) const {
    return std::max({apart(color[0], a, 0), apart(color[1], a, 1), apart(color[2], a, 2), apart(color[3], a, 3)});
  }
};

// Compares each pixel's colour with the nearest legal answer. `at_pixel(meter, x, y)`: adds more values; true: the
// pixel's colour is not compared. `holds(answer, x, y)`: whether the pixel's other planes fit the answer; if any answer
// fits, only fitting answers count.
template <class AtPixel, class Holds>
Measurement compare_legal_color(const Plane<glm::vec4>& color, const Planes& candidate, const Legal& legal,
                                const ColorRule& rule, const AtPixel& at_pixel, const Holds& holds) {
  std::string why;
  if (!fits_winners(candidate, legal, why)) return mismatch("bound", why, color.size());
  return compare_planes(color, legal.certain, "bound", [&](Meter& meter, int x, int y) {
    if (at_pixel(meter, x, y)) return;
    if (legal.at(x, y).size() > 1) meter.ambiguous();
    const glm::vec4 c = color(x, y);
    const auto answers = answers_of_winner(legal, candidate, x, y);
    if (answers.empty()) {  // visibility judges the winner; here any finite colour holds
      return add_finite_color(meter, Vec4<double>(c), {x, y, winner_at(candidate, x, y), "color", true});
    }
    const bool one_holds = std::ranges::any_of(answers, [&](const LegalAnswer& a) { return holds(a, x, y); });
    const auto distance = [&](const LegalAnswer& a) {
      return one_holds && !holds(a, x, y) ? kInfinite : rule.farthest(c, a);
    };
    const LegalAnswer& nearest = *std::ranges::min_element(answers, {}, distance);
    // True: any colour is legal. (Colours of frames of codes lie in [0, 1].)
    const bool is_any = rule.stored.scale > 0 ? !(nearest.color_bound < 1) : !std::isfinite(nearest.color_bound);
    if (is_any && legal.at(x, y).size() == 1) meter.ambiguous();
    for (int i = 0; i < 4; ++i) {
      meter.value(rule.apart(c[i], nearest, i), rule.factor, {x, y, nearest.primitive, "color", true}, c[i],
                  rule.wanted(nearest, i));
    }
  });
}

}  // namespace

Measurement compare_legal_depth(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                const DeclaredCodes& declared) {
  std::string why;
  if (!fits_winners(candidate, legal, why)) return mismatch("step", why, candidate.depth.size());
  const LegalAnswer cleared = LegalFold(scene.frame).winners().front();
  return compare_planes(candidate.depth, legal.certain, "step", [&](Meter& meter, int x, int y) {
    if (legal.at(x, y).size() > 1) meter.ambiguous();
    const auto answers = answers_of_winner(legal, candidate, x, y);
    if (!candidate.color.empty() && is_cleared(answers)) return;
    const double z = candidate.depth(x, y), step = depth_step(scene.frame.depth, z);
    const double middle = declared.rounding ? z + middle_of(*declared.rounding) * step : z;
    // A winner that leaves no depth leaves the cleared one, whose rounding no convention says.
    const auto is_of_fragment = [&](const LegalAnswer& a) {
      const bool is_cleared_depth = a.z_lo == cleared.z_lo && a.z_hi == cleared.z_hi;
      return declared.rounding && a.primitive != kBackground && !is_cleared_depth;
    };
    const auto apart = [&](const LegalAnswer& a) {
      return distance_outside(is_of_fragment(a) ? middle : z, a.z_lo, a.z_hi) / step;
    };
    if (answers.empty()) {
      return meter.value(std::isfinite(z) ? 0 : kInfinite, 0, {x, y, winner_at(candidate, x, y), "z", true}, z, 0);
    }
    const double of_clear = tolerance(Profile::oracle, Stage::depth).factor;
    const auto most_apart = [&](const LegalAnswer& a) {
      return is_of_fragment(a) ? factor + declared.product_error : of_clear;
    };
    const LegalAnswer& nearest =
        *std::ranges::min_element(answers, {}, [&](const LegalAnswer& a) { return apart(a) / most_apart(a); });
    const double expected = std::isnan(z) ? nearest.z_lo : std::clamp(z, nearest.z_lo, nearest.z_hi);
    const double codes = declared.has_codes ? z * depth_scale(scene.frame.depth) : 0;
    constexpr double kRoundings = 1e-6;  // of a code that was computed in double [step]
    const bool is_code = std::abs(codes - std::nearbyint(codes)) <= kRoundings;
    const double most = most_apart(nearest);
    meter.value(is_code ? apart(nearest) : std::max(apart(nearest), 2 * most), most,
                {x, y, nearest.primitive, is_code ? "z" : "z that is no code", true}, z, expected);
  });
}

Measurement compare_legal_shaded(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                 const Conventions& conventions) {
  // No fragment has a colour where only the background is legal; merge judges the clear colour.
  const auto has_no_winner = [&](Meter& meter, int x, int y) {
    if (!is_cleared(answers_of_winner(legal, candidate, x, y))) return false;
    add_finite_color(meter, Vec4<double>(candidate.shaded(x, y)), {x, y, kBackground, "color"});
    return true;
  };
  const auto holds = [](const LegalAnswer&, int, int) { return true; };
  Conventions rounding;  // shaded colours are not encoded
  rounding.color_rounding = conventions.color_rounding;
  const double scale = has_codes_of_fragments(scene.frame, conventions) ? color_scale(scene.frame.color) : 0;
  const ColorRule rule{.stored = {rounding, scale},
                       .factor = factor,
                       .half_code = scale > 0 ? 0.5 / scale + 4 * u : 0,
                       .may_clamp = scene.frame.color != ColorFormat::rgba32f};
  return compare_legal_color(candidate.shaded, candidate, legal, rule, has_no_winner, holds);
}

Measurement compare_legal_merge(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                const Conventions& conventions) {
  const double scale = color_scale(scene.frame.color);
  const bool codes = scale > 0;
  const StoredColors stored{conventions, scale};
  constexpr double kOf16Bits = 65535;  // codes that OpenGL gives where 12 bits are asked for
  const auto codes_and_clear_depth = [&](Meter& meter, int x, int y) {
    meter_clear_depth(meter, scene, candidate, legal, x, y);
    for (int c = 0; c < 4; ++c) {
      const double v = candidate.color(x, y)[c];
      if (scene.frame.color == ColorFormat::rgba12 && is_stored_code(kOf16Bits, v)) continue;
      meter_code(meter, scale, v, {x, y, winner_at(candidate, x, y), "no code", true});
    }
    return false;
  };
  if (!legal.color_lo.empty()) {
    const double rounding = codes ? 0.5 / scale + 4 * u : u;
    return compare_planes(candidate.color, legal.color_lo, "bound", [&](Meter& meter, int x, int y) {
      codes_and_clear_depth(meter, x, y);
      const glm::vec4 &color = candidate.color(x, y), &low = legal.color_lo(x, y), &high = legal.color_hi(x, y);
      for (int c = 0; c < 4; ++c) {
        if (!std::isfinite(low.x)) {
          add_open_value(meter, color[c], {x, y, -1, "color"}, 0);
          continue;
        }
        const double value = stored.middle(color[c]), clear = scene.frame.clear_color[c];
        double off = distance_outside(value, stored.of_channel(low[c], c), stored.of_channel(high[c], c));
        const bool may_be_clear =
            distance_outside(clear, low[c], high[c]) <= rounding;  // rounded, and encoded, as it may be
        if (may_be_clear) off = std::min(off, distance_outside(color[c], low[c], high[c]));
        meter.value(off / rounding, factor, {x, y, -1, "color"}, color[c], low[c]);
      }
    });
  }
  // The colour and the depth are of one answer. (Where winners are shown, there is but one.)
  const bool has_depth =
      candidate.depth.width() == legal.certain.width() && candidate.depth.size() == legal.certain.size();
  const double steps = tolerance(Profile::oracle, Stage::depth).factor;
  const auto has_its_depth = [&](const LegalAnswer& a, int x, int y) {
    if (!has_depth) return true;
    const double z = candidate.depth(x, y);
    return distance_outside(z, a.z_lo, a.z_hi) / depth_step(scene.frame.depth, z) <= steps;
  };
  const ColorRule rule{.stored = stored, .factor = factor, .half_code = codes ? 0.5 / scale + 4 * u : 0};
  return compare_legal_color(candidate.color, candidate, legal, rule, codes_and_clear_depth, has_its_depth);
}

}  // namespace plumbline::check
