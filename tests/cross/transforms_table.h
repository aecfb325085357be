// A table of formulas: ours in double, beside a reference's, over random inputs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace plumbline::test {

/// The reference's numbers. Where they have 64 significant bits (x86), what is measured is our error alone.
using Wide = long double;
using WideVec3 = glm::vec<3, Wide>;
using WideMat4 = glm::mat<4, 4, Wide>;

inline constexpr double kTurn = 6.283185307179586;
inline const WideMat4 kOne(1);

inline WideVec3 wide(const glm::dvec3& v) { return WideVec3(v); }
inline WideMat4 moved(const glm::dvec3& by) { return glm::translate(kOne, wide(by)); }
inline WideMat4 scaled(const glm::dvec3& by) { return glm::scale(kOne, wide(by)); }
inline WideMat4 turned(double angle, const glm::dvec3& axis) { return glm::rotate(kOne, Wide(angle), wide(axis)); }

class Inputs {
 public:
  double between(double least, double most) {
    return least + (most - least) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  /// Either sign; the magnitude's logarithm is uniform in [log least, log most).
  double of_any_size(double least, double most) {
    const double size = std::exp2(between(std::log2(least), std::log2(most)));
    return bits_() % 2 == 0 ? size : -size;
  }
  glm::dvec3 point(double reach) {
    const double x = between(-reach, reach), y = between(-reach, reach);
    return {x, y, between(-reach, reach)};
  }
  /// Uniform in [-reach, reach]^3 but for vectors of length up to reach / 16.
  glm::dvec3 direction(double reach) {
    for (;;) {
      const glm::dvec3 v = point(reach);
      if (glm::length(v) > reach / 16) return v;
    }
  }

 private:
  std::mt19937_64 bits_{1};
};

/// One number of ours, the reference's, and the magnitude whose ULP is the unit of their difference.
struct Entry {
  double ours;
  Wide theirs, magnitude;
};
using Entries = std::vector<Entry>;

/// One line of the table. `digits`: significant bits of the number whose ULP is the unit, 53 (double) or 24 (float).
/// `bound` [ULP].
struct Row {
  const char* formula;  ///< with its note
  const char* ours;
  const char* reference;
  int digits;
  double bound;
  std::function<Entries(Inputs&)> input;
};

/// Ours in double.
inline Row row(const char* formula, const char* ours, const char* reference, double bound,
               std::function<Entries(Inputs&)> input) {
  return {formula, ours, reference, 53, bound, std::move(input)};
}

/// Entries in ULP of themselves, each a formula of its own. An entry of 0 must be 0.
template <class Ours, class Theirs>
Entries by_entry(const Ours& ours, const Theirs& theirs) {
  Entries out;
  for (int c = 0; c < Ours::length(); ++c) {
    for (int r = 0; r < Ours::col_type::length(); ++r) {
      out.push_back({ours[c][r], theirs[c][r], std::abs(static_cast<Wide>(theirs[c][r]))});
    }
  }
  return out;
}

/// Entries in ULP of the largest entry, or of `magnitude`, the largest term added up, where that is larger.
template <class Ours, class Theirs>
Entries by_largest(const Ours& ours, const Theirs& theirs, double magnitude = 0) {
  Entries out = by_entry(ours, theirs);
  Wide largest = magnitude;
  for (const Entry& e : out) largest = std::max(largest, e.magnitude);
  for (Entry& e : out) e.magnitude = largest;
  return out;
}

inline Entries number(double ours, Wide theirs) { return {{ours, theirs, std::abs(theirs)}}; }

/// The largest difference over 10,000 random inputs, in ULP; infinite where something is not a number, or fewer than
/// 1,000 entries were compared.
inline double largest_difference(const Row& row) {
  Inputs random;
  double largest = 0;
  int entries = 0;
  for (int i = 0; i < 10000; ++i) {
    for (const Entry& e : row.input(random)) {
      ++entries;
      const Wide apart = std::abs(static_cast<Wide>(e.ours) - e.theirs);
      if (apart == 0) continue;
      const Wide ulp = e.magnitude > 0 ? std::ldexp(Wide(1), std::ilogb(e.magnitude) + 1 - row.digits) : Wide(0);
      const double in_ulp = static_cast<double>(apart / ulp);
      if (!(in_ulp <= largest)) largest = std::isnan(in_ulp) ? std::numeric_limits<double>::infinity() : in_ulp;
    }
  }
  return entries < 1000 ? std::numeric_limits<double>::infinity() : largest;
}

inline bool holds(const Row& row) { return largest_difference(row) <= row.bound; }

/// Prints the table. A row beyond its bound fails.
inline void expect_table(std::span<const Row> rows) {
  fmt::print("{:<34} {:<36} {:<42} {:>9} {:>6}  ULP of a number of\n", "formula", "ours", "reference", "largest",
             "bound");
  for (const Row& row : rows) {
    const double largest = largest_difference(row);
    fmt::print("{:<34} {:<36} {:<42} {:>9.4g} {:>6.1f}  {} bits\n", row.formula, row.ours, row.reference, largest,
               row.bound, row.digits);
    EXPECT_LE(largest, row.bound) << row.formula << ": " << row.ours << " against " << row.reference;
  }
}

}  // namespace plumbline::test
