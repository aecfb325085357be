#include "reference/arithmetic/frame_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "capture/by_conventions.h"
#include "reference/arithmetic/bounded.h"

namespace plumbline::math {

namespace {

Interval operator+(Interval a, Interval b) { return {a.lo + b.lo, a.hi + b.hi}; }
Interval operator-(Interval a, Interval b) { return {a.lo - b.hi, a.hi - b.lo}; }
Interval operator*(Interval a, Interval b) {
  const auto [lo, hi] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
  return {lo, hi};
}
Interval operator/(Interval a, double b) { return {a.lo / b, a.hi / b}; }
Interval lesser(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }
Interval greater(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }

/// Blending of colours and factors in units of the largest code (`one`), in which stored colours are whole numbers.
struct Blender {
  const ColorInterval &source, &destination, &constant;
  double one;

  Interval factor(BlendFactor f, std::size_t channel) const {
    const Interval all{one, one};
    switch (f) {
      case BlendFactor::zero: return {0, 0};
      case BlendFactor::one: return all;
      case BlendFactor::source_color: return source[channel];
      case BlendFactor::one_minus_source_color: return all - source[channel];
      case BlendFactor::destination_color: return destination[channel];
      case BlendFactor::one_minus_destination_color: return all - destination[channel];
      case BlendFactor::source_alpha: return source[3];
      case BlendFactor::one_minus_source_alpha: return all - source[3];
      case BlendFactor::destination_alpha: return destination[3];
      case BlendFactor::one_minus_destination_alpha: return all - destination[3];
      case BlendFactor::constant_color: return constant[channel];
      case BlendFactor::one_minus_constant_color: return all - constant[channel];
      case BlendFactor::constant_alpha: return constant[3];
      case BlendFactor::one_minus_constant_alpha: return all - constant[3];
      case BlendFactor::source_alpha_saturate: return channel == 3 ? all : lesser(source[3], all - destination[3]);
    }
    return all;
  }

  Interval source_term(const BlendTerm& term, std::size_t c) const { return source[c] * factor(term.source, c) / one; }
  Interval destination_term(const BlendTerm& term, std::size_t c) const {
    return destination[c] * factor(term.destination, c) / one;
  }
  /// Largest sum of absolute values that are rounded: of the terms; where the factors are complements, of the colours
  /// times the larger factor above 1, as a renderer may have s a + d (1 - a) as d + a (s - d).
  double magnitude(const BlendTerm& term, std::size_t c) const {
    const auto largest = [](Interval v) { return std::max(std::abs(v.lo), std::abs(v.hi)); };
    if (!are_complements(term.source, term.destination))
      return largest(source_term(term, c)) + largest(destination_term(term, c));
    const double factors = std::max(largest(factor(term.source, c)), largest(factor(term.destination, c)));
    return std::max(1.0, factors / one) * (largest(source[c]) + largest(destination[c]));
  }

  Interval operator()(const BlendTerm& term, std::size_t c) const {
    const Interval s = source_term(term, c), d = destination_term(term, c);
    switch (term.equation) {
      case BlendEquation::add: return s + d;
      case BlendEquation::subtract: return s - d;
      case BlendEquation::reverse_subtract: return d - s;
      case BlendEquation::min: return lesser(source[c], destination[c]);
      case BlendEquation::max: return greater(source[c], destination[c]);
    }
    return s;
  }
};

/// OpenGL 2.1 spec, table 4.2.
unsigned logic(LogicOp op, unsigned s, unsigned d, unsigned all) {
  const auto value = [&]() -> unsigned {
    switch (op) {
      case LogicOp::clear: return 0;
      case LogicOp::and_: return s & d;
      case LogicOp::and_reverse: return s & ~d;
      case LogicOp::copy: return s;
      case LogicOp::and_inverted: return ~s & d;
      case LogicOp::noop: return d;
      case LogicOp::xor_: return s ^ d;
      case LogicOp::or_: return s | d;
      case LogicOp::nor: return ~(s | d);
      case LogicOp::equivalent: return ~(s ^ d);
      case LogicOp::invert: return ~d;
      case LogicOp::or_reverse: return s | ~d;
      case LogicOp::copy_inverted: return ~s;
      case LogicOp::or_inverted: return ~s | d;
      case LogicOp::nand: return ~(s & d);
      case LogicOp::set: return all;
    }
    return 0;
  };
  return value() & all;
}

/// Hull of the op's results over all pairs of codes in two intervals; all codes where these are many.
Interval logic(LogicOp op, Interval source, Interval stored, double largest) {
  constexpr double kMost = 64;
  if ((source.hi - source.lo + 1) * (stored.hi - stored.lo + 1) > kMost) return {0, largest};
  Interval out{largest, 0};
  for (double s = source.lo; s <= source.hi; ++s) {
    for (double d = stored.lo; d <= stored.hi; ++d) {
      const double code = logic(op, static_cast<unsigned>(s), static_cast<unsigned>(d), static_cast<unsigned>(largest));
      out = {std::min(out.lo, code), std::max(out.hi, code)};
    }
  }
  return out;
}

/// `v` rounded to float. volatile: GCC 12 (-O2) leaves the rounding out where it vectorises two of them.
double in_float(double v) {
  const volatile float rounded = static_cast<float>(v);
  return static_cast<double>(rounded);
}

}  // namespace

bool are_complements(BlendFactor a, BlendFactor b) {
  using enum BlendFactor;
  constexpr std::pair<BlendFactor, BlendFactor> kPairs[] = {
      {source_color, one_minus_source_color},     {destination_color, one_minus_destination_color},
      {source_alpha, one_minus_source_alpha},     {destination_alpha, one_minus_destination_alpha},
      {constant_color, one_minus_constant_color}, {constant_alpha, one_minus_constant_alpha}};
  return std::ranges::any_of(
      kPairs, [&](const auto& p) { return (p.first == a && p.second == b) || (p.first == b && p.second == a); });
}

double to_whole(Conventions::Rounding rounding, double v) {
  switch (rounding) {
    case Conventions::Rounding::nearest: return std::nearbyint(v);
    case Conventions::Rounding::down: return std::floor(v);
    case Conventions::Rounding::up: return std::ceil(v);
  }
  return v;
}

ColorInterval around(const glm::dvec4& color, double bound) {
  ColorInterval out;
  for (std::size_t c = 0; c < 4; ++c) {
    const double v = color[static_cast<int>(c)];
    out[c] = {v - bound, v + bound};
  }
  return out;
}

glm::vec4 low(const ColorInterval& color) { return {color[0].lo, color[1].lo, color[2].lo, color[3].lo}; }
glm::vec4 high(const ColorInterval& color) { return {color[0].hi, color[1].hi, color[2].hi, color[3].hi}; }
glm::dvec4 middle(const ColorInterval& c) {
  return {(c[0].lo + c[0].hi) / 2, (c[1].lo + c[1].hi) / 2, (c[2].lo + c[2].hi) / 2, (c[3].lo + c[3].hi) / 2};
}

FrameColor::FrameColor(const FrameFormat& frame, Conventions::Blending blending, Conventions::Rounding rounding,
                       BlendedIn numbers)
    : unit_(frame.color == ColorFormat::rgba32f ? 1 : color_scale(frame.color)),
      codes_(frame.color != ColorFormat::rgba32f),
      blends_codes_(codes_ && blending != Conventions::Blending::in_float),
      blends_in_float_(numbers == BlendedIn::floats),
      truncates_products_(blending == Conventions::Blending::in_codes_down),
      rounding_(rounding),
      written_{},
      stored_{} {
  write({}, around(glm::dvec4(frame.clear_color), 0));
  if (!codes_) return;
  // A renderer that rounds fragments down or up may clear to the nearest code.
  for (std::size_t c = 0; c < 4; ++c) {
    const double nearest = std::nearbyint(static_cast<double>(frame.clear_color[static_cast<int>(c)]) * unit_);
    stored_[c] = {std::min(stored_[c].lo, nearest), std::max(stored_[c].hi, nearest)};
  }
}

void FrameColor::write(const Merge& state, const ColorInterval& color) {
  const Interval lowest{0, 0}, highest{unit_, unit_};
  const auto clamped = [&](Interval v) { return codes_ ? lesser(greater(v, lowest), highest) : v; };
  const auto range = [&](Conventions::Rounding of) { return blends_codes_ ? range_of(of) : RoundingRange{0, 0}; };
  const RoundingRange of_factor = range(rounding_),
                      of_product = range(truncates_products_ ? Conventions::Rounding::down : rounding_);
  constexpr double kRoundings = 4;  // in float, of a factor, two products and their sum
  ColorInterval source, blended, result, constant = around(glm::dvec4(0), 0);
  std::array<double, 4> rounding{};  // of blending in float
  for (std::size_t c = 0; c < 4; ++c) source[c] = clamped({color[c].lo * unit_, color[c].hi * unit_});
  for (std::size_t c = 0; c < 4; ++c)
    blended[c] = clamped({source[c].lo + of_factor.least, source[c].hi + of_factor.most});
  for (std::size_t c = 0; state.blend && c < 4; ++c) {
    const double v = static_cast<double>(state.blend->color[static_cast<int>(c)]) * unit_;
    const double slack = unit_ * 0x1p-22;  // of v, scaled in float
    constant[c] = blends_codes_
                      ? clamped({std::ceil(v + of_factor.least - slack), std::floor(v + of_factor.most + slack)})
                      : clamped({v, v});
  }
  for (std::size_t c = 0; c < 4; ++c) {
    if (!state.blend || state.logic_op) {
      result[c] = source[c];
      continue;
    }
    const Blender blender{blended, stored_, constant, unit_};
    const BlendTerm& term = c < 3 ? state.blend->rgb : state.blend->alpha;
    const bool multiplies = term.equation != BlendEquation::min && term.equation != BlendEquation::max;
    const Interval sum = blender(term, c);
    const bool subtracts = multiplies && term.equation != BlendEquation::add;
    const double below = -of_product.least, above = of_product.most;
    const double less = !multiplies ? 0 : below + (subtracts ? above : below),
                 more = !multiplies ? 0 : above + (subtracts ? below : above);
    result[c] = clamped({sum.lo - less, sum.hi + more});
    rounding[c] = !multiplies        ? 0
                  : blends_in_float_ ? kRoundings * kFloatRounding * blender.magnitude(term, c)
                                     : 0x1p-48 * blender.magnitude(term, c);
  }
  // Slack of the rounding to codes. Not blended: two float roundings (colour, scale to codes). Blended in double: ten
  // 2^-53 of the largest code. Blended in float: 8 u of the largest code (factor and product of two terms, the stored
  // colour, the sum, the scale).
  const bool blends = state.blend && !state.logic_op;
  const double either_way = !blends ? unit_ * 0x1p-23 : blends_in_float_ ? unit_ * 0x1p-21 : unit_ * 0x1p-49;
  const auto code = [&](double v) { return to_whole(rounding_, std::clamp(v, 0.0, unit_)); };
  const auto codes = [&](Interval v) -> Interval { return {code(v.lo - either_way), code(v.hi + either_way)}; };
  for (std::size_t c = 0; c < 4; ++c) {
    if (!state.color_mask[static_cast<int>(c)]) continue;
    const auto [lo, hi] = result[c];
    if (codes_ && state.logic_op) {
      stored_[c] = logic(*state.logic_op, codes(result[c]), stored_[c], unit_);
      written_[c] = stored_[c] + Interval{middle_of(rounding_), middle_of(rounding_)};
    } else if (codes_) {
      written_[c] = result[c];
      stored_[c] = codes(result[c]);
    } else {
      written_[c] = stored_[c] = {in_float(lo - rounding[c]), in_float(hi + rounding[c])};
    }
  }
}

ColorInterval FrameColor::written() const {
  ColorInterval out;
  for (std::size_t c = 0; c < 4; ++c) out[c] = written_[c] / unit_;
  return out;
}

}  // namespace plumbline::math
