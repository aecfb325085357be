// Helpers of comparators and bounds: roundings, units, look-ups of legal answers. Of headers, compare/same_winners.h
// alone includes these.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "check/bounds/bounds.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

inline constexpr double u = kFloatRounding;

// The nearest float. Volatile: vectorising two conversions to float and back, GCC 12 -O2 leaves them out.
inline double to_float(double value) {
  const volatile auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

/// floor(value) as an int, clamped to [-2^30, 2^30]; NaN becomes -2^30. Numbers of another renderer's records may not
/// fit an int.
inline int whole_in_range(double value) {
  constexpr double kMost = 0x1p30;
  return static_cast<int>(std::floor(std::fmin(std::fmax(value, -kMost), kMost)));
}

// Compares records one by one by visit(meter, i); a mismatch where the two sides' counts differ.
template <class Visit>
Measurement each(const char* what, const std::string& unit, std::size_t candidate, std::size_t reference, Visit visit) {
  if (candidate != reference) {
    return mismatch(unit, fmt::format("{} {}, the reference {}", candidate, what, reference),
                    std::max(candidate, reference));
  }
  Meter meter(unit);
  for (std::size_t i = 0; i < candidate; ++i) {
    visit(meter, i);
    meter.item();
  }
  return meter.done();
}

// Distance from |value| to the next larger float; of the largest one, to the next smaller.
inline double ulp(double value) {
  const auto f = static_cast<float>(std::abs(value));
  if (f == std::numeric_limits<float>::max()) return 0x1p104;
  return static_cast<double>(std::nextafter(f, std::numeric_limits<float>::infinity())) - static_cast<double>(f);
}

// Adds all entries of two vectors to the meter, each difference in units of unit[c]. `allowance`: as in Meter::value(),
// but in the entries' own unit.
template <int n>
void add(Meter& meter, const glm::vec<n, double>& a, const glm::vec<n, double>& b, const glm::vec<n, double>& unit,
         double factor, const Place& place, const glm::vec<n, double>& allowance = glm::vec<n, double>(0)) {
  for (int c = 0; c < n; ++c) {
    const double diff = difference(a[c], b[c]);
    meter.value(diff == 0 ? 0 : diff / unit[c], factor, place, a[c], b[c],
                allowance[c] == 0 ? 0 : allowance[c] / unit[c]);
  }
}

inline const LegalAnswer* answer_of_primitive(std::span<const LegalAnswer> answers, std::int32_t primitive) {
  const auto it = std::find_if(answers.begin(), answers.end(),
                               [&](const LegalAnswer& answer) { return answer.primitive == primitive; });
  return it == answers.end() ? nullptr : &*it;
}

// The legal answer of the planes' winner and its stencil value; null: there is none.
inline const LegalAnswer* answer_of_winner(const Legal& legal, const Planes& planes, int x, int y) {
  const std::int32_t id = planes.id(x, y);
  if (planes.stencil.empty()) return answer_of_primitive(legal.at(x, y), id);
  for (const LegalAnswer& answer : legal.at(x, y)) {
    if (answer.primitive == id && answer.stencil == planes.stencil(x, y)) return &answer;
  }
  return nullptr;
}

// Legal answers that a pixel's depth and colour are compared with: the answer of the pixel's winner, or all answers
// where the planes show no winners. Empty: the winner is not legal.
inline std::span<const LegalAnswer> answers_of_winner(const Legal& legal, const Planes& planes, int x, int y) {
  if (planes.id.empty()) return legal.at(x, y);
  const LegalAnswer* own = answer_of_winner(legal, planes, x, y);
  return own == nullptr ? std::span<const LegalAnswer>() : std::span(own, 1);
}

// True if several counts of fragments are legal at the pixel, the candidate's among them.
inline bool is_open(const Legal& legal, const Planes& planes, int x, int y) {
  if (legal.empty() || planes.count.size() != legal.certain.size()) return false;
  const std::uint32_t count = planes.count(x, y), low = legal.certain(x, y), high = legal.possible(x, y);
  return low != high && low <= count && count <= high;
}

// Encoding of colours by a renderer's conventions: a colour as stored before rounding (of_channel), and the middle of
// the colours that round to a stored code (middle).
struct StoredColors {
  const Conventions& conventions;
  double scale;  // the largest code; 0: floats
  double encoded(double v) const {
    if (scale == 0 || conventions.color_encoding == Conventions::Encoding::linear) return v;
    return srgb_encoded(std::clamp(v, 0.0, 1.0));
  }
  double of_channel(double v, int channel) const { return channel < 3 ? encoded(v) : v; }
  double middle(double stored) const {
    return scale > 0 ? stored + middle_of(conventions.color_rounding) / scale : stored;
  }
};

inline double distance_outside(double value, double low, double high) {
  if (value >= low && value <= high) return 0;
  return std::isfinite(value) ? std::max(low - value, value - high) : kInfinite;
}

/// Nearest code to a stored number, of 0 to `scale`.
inline double nearest_code(double scale, double stored) { return std::clamp(std::round(scale * stored), 0.0, scale); }
/// Whether a stored number is a code, to two roundings of float and 1e-3 of a code: a literal of six digits for 1/255
/// is up to 3.3e-4 of a code off (largest seen: 8.9e-5, 0.00392157f). Scale 0: any number is.
inline bool is_stored_code(double scale, double stored) {
  constexpr double kOfLiteral = 1e-3;
  const double most = scale * 2 * kFloatRounding + kOfLiteral;
  return scale == 0 || std::abs(scale * stored - nearest_code(scale, stored)) <= most;
}
/// Adds a stored number, which differs if it is no code.
inline void meter_code(Meter& meter, double scale, double stored, const Place& place) {
  const bool is_code = is_stored_code(scale, stored);
  meter.value(is_code ? 0 : kInfinite, 0, place, scale * stored, nearest_code(scale, stored));
}

/// Adds a colour without a reference (a winner's where no fragment wins): it differs only if not finite.
inline void add_finite_color(Meter& meter, const Vec4<double>& color, const Place& place) {
  for (int c = 0; c < 4; ++c) meter.value(std::isfinite(color[c]) ? 0 : kInfinite, 0, place, color[c], 0);
}

// Adds a value without a bound (a triangle without area): any finite number is legal, and the item is ambiguous.
inline void add_open_value(Meter& meter, double value, const Place& place, double reference) {
  meter.ambiguous();
  meter.value(std::isfinite(value) && std::isfinite(reference) ? 0 : kInfinite, 0, place, value, reference);
}

}  // namespace plumbline::check
