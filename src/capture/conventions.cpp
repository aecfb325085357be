#include "capture/conventions.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace plumbline {

std::string bits_text(int bits) { return bits == Conventions::kFloat ? "float" : std::to_string(bits); }

std::string sample_text(const glm::dvec2& sample) { return fmt::format("{:.4g}, {:.4g}", sample.x, sample.y); }

double rounded(Conventions::Rounding rounding, double v) {
  using enum Conventions::Rounding;
  return rounding == down ? std::floor(v) : rounding == up ? std::ceil(v) : std::nearbyint(v);
}

Conventions::Rounding subpixel_rounding(const Conventions& conventions, int axis) {
  using enum Conventions::Rounding;
  const Conventions::Rounding declared = conventions.subpixel_rounding;
  if (axis == 0 || conventions.window_y == Conventions::WindowY::up || declared == nearest) return declared;
  return declared == down ? up : down;
}

double middle_of(Conventions::Rounding rounding) {
  using enum Conventions::Rounding;
  return rounding == down ? 0.5 : rounding == up ? -0.5 : 0;
}

double srgb_encoded(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

double snapped(const Conventions& conventions, int axis, double from_centre) {
  constexpr int kBits = 8;  // of 1/256
  const int bits = conventions.subpixel_bits;
  if (bits < 0 || bits > kBits) return std::nearbyint(from_centre);
  // to_dialect() moved positions by `moved`, and snapped ones by `moved`, rounded.
  const double steps = std::ldexp(1.0, kBits - bits), half = std::ldexp(0.5, kBits),
               moved = half - std::ldexp(conventions.sample[axis], kBits);
  const double from_side = rounded(subpixel_rounding(conventions, axis), (from_centre - moved + half) / steps) * steps;
  return from_side - half + std::round(moved);
}

SnappedRange snapped_range(const Conventions& conventions, int axis, double from_centre) {
  constexpr double kSteps = 256;  // of 1/256 pixel
  const bool is_to_nearest = conventions.subpixel_rounding == Conventions::Rounding::nearest;
  const double before = is_to_nearest ? 0 : kSteps * kOfFixedPoint;
  return {snapped(conventions, axis, from_centre - before), snapped(conventions, axis, from_centre + before)};
}

double in_steps(const Conventions& conventions, int axis, double p_win) {
  return std::ldexp(p_win - 0.5 + conventions.sample[axis], conventions.subpixel_bits);
}

double on_grid(const Conventions& conventions, int axis, double p_win) {
  return rounded(subpixel_rounding(conventions, axis), in_steps(conventions, axis, p_win));
}

bool leaves_open(const Conventions& conventions, std::string_view name) {
  return std::ranges::find(conventions.open, name) != conventions.open.end();
}

bool settles_grid(const Conventions& c) {
  // Edge functions in a frame of 2^15 pixels are exact in double: 2 (15 + 10) + 2 bits.
  constexpr int kFinest = 10, kOfRecords = 8;  // window.snapped is in 1/256 pixel
  const auto is_open = [&](std::string_view name) { return leaves_open(c, name); };
  if (is_open("subpixel_bits") || is_open("subpixel_rounding") || is_open("sample")) return false;
  if (c.subpixel_bits < 0 || c.subpixel_bits > kFinest) return false;
  const bool is_to_nearest = c.subpixel_rounding == Conventions::Rounding::nearest;
  const bool is_y_known =
      c.window_y == Conventions::WindowY::down || (c.rows == Conventions::Rows::from_bottom && !is_open("rows"));
  if (!is_to_nearest && (!is_y_known || is_open("window_y"))) return false;
  const glm::dvec2 sample = std::ldexp(1.0, std::max(c.subpixel_bits, kOfRecords)) * c.sample;
  return sample == glm::round(sample);
}

bool settles_ties(const Conventions& c) { return c.tie_rule != Conventions::TieRule::any && settles_grid(c); }

bool settles_ties_of_floats(const Conventions& c) {
  const bool is_rule = c.tie_rule != Conventions::TieRule::any && !leaves_open(c, "tie_rule");
  const bool are_floats = c.subpixel_bits == Conventions::kFloat && !leaves_open(c, "subpixel_bits");
  const glm::dvec2 sample = 256.0 * c.sample;
  return is_rule && are_floats && !leaves_open(c, "sample") && sample == glm::round(sample);
}

namespace {

// A mistake, and the convention that it is of; empty: of none.
struct Mistake {
  std::string_view name;
  std::string line;
};

std::vector<Mistake> mistakes_of(const Conventions& conventions) {
  const Conventions expected;
  std::vector<Mistake> out;
  const auto add = [&](const ConventionWords& words, std::string_view found, std::string_view of_dialect) {
    out.push_back(
        {words.name, fmt::format("convention {}: {}, expected {} ({})", words.name, found, of_dialect, words.meaning)});
  };
  if (conventions.sample != expected.sample)
    add(kSampleWords, sample_text(conventions.sample), sample_text(expected.sample));
  each_choice([&](const ConventionWords& words, auto member) {
    const auto found = conventions.*member;
    if (found == expected.*member || words.is_free) return;
    if (words.name == "depth_format" && name_of(found) != "z16") return;  // more than was asked for
    add(words, name_of(found), name_of(expected.*member));
  });
  using enum Conventions::TieRule;
  if (conventions.tie_rule == inclusive || conventions.tie_rule == exclusive) {
    out.push_back(
        {"tie_rule",
         fmt::format("convention tie_rule: {}, expected each sample on a shared edge in one triangle: it is in {}",
                     name_of(conventions.tie_rule), conventions.tie_rule == inclusive ? "both" : "none")});
  }
  if (conventions.subpixel_bits != Conventions::kFloat && conventions.subpixel_bits < 4)
    out.push_back({"subpixel_bits",
                   fmt::format("convention subpixel_bits: {}, expected 4 or more (OpenGL 2.1: the least SUBPIXEL_BITS)",
                               conventions.subpixel_bits)});
  constexpr int kLeastEdgeBits = 14;
  if (conventions.edge_bits != Conventions::kFloat && conventions.edge_bits < kLeastEdgeBits)
    out.push_back({"edge_bits",
                   fmt::format("convention edge_bits: {}, expected {} or more: over 1,024 rows an edge errs by {:.3g} "
                               "pixel, beyond 1/16, that of the least SUBPIXEL_BITS (OpenGL 2.1)",
                               conventions.edge_bits, kLeastEdgeBits, std::ldexp(1024, -conventions.edge_bits))});
  if (std::min(conventions.offset_unit.x, conventions.offset_unit.y) < 1)
    out.push_back(
        {kOffsetWords.name,
         fmt::format("convention offset_unit: {:.4g}, {:.4g}, expected 1 or more: a unit makes depths differ ({})",
                     conventions.offset_unit.x, conventions.offset_unit.y, "OpenGL 2.1, 3.5.5")});
  for (const std::string& line : conventions.unexplained) out.push_back({"", "no convention: " + line});
  return out;
}

}  // namespace

std::vector<std::string> mistaken(const Conventions& conventions) {
  std::vector<std::string> out;
  for (Mistake& mistake : mistakes_of(conventions)) out.push_back(std::move(mistake.line));
  return out;
}

std::vector<std::string> not_accepted(const Conventions& conventions) {
  std::vector<std::string> out;
  for (Mistake& mistake : mistakes_of(conventions)) {
    if (std::ranges::find(conventions.accepted, mistake.name) == conventions.accepted.end())
      out.push_back(std::move(mistake.line));
  }
  return out;
}

Conventions undeclared() {
  Conventions out;
  out.alpha_test = Conventions::AlphaTest::either;
  out.level_of_detail = Conventions::LevelOfDetail::approximate;
  return out;
}

}  // namespace plumbline
