// Measurements, the results of comparators. A comparator measures; the verdict decides.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "capture/plane.h"

namespace plumbline::check {

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Place in a capture: a pixel, or a record and its field.
struct Place {
  int x = -1, y = -1;         ///< pixel, or -1
  std::int64_t record = -1;   ///< number of the record, or -1
  const char* field = "";     ///< such as "p_clip.x"
  bool of_primitive = false;  ///< `record` is the number of a primitive: of the winner, of a polygon
};
std::string to_string(const Place& place);

/// The item with the largest difference in proportion to its tolerance.
struct Worst {
  Place place;
  double candidate = 0, reference = 0;
  double difference = 0;  ///< in the measurement's unit
  double tolerance = 0;   ///< likewise
};

/// "PLACE: 0.5, EXPECTED 0.25, 4 UNIT apart, tolerance 1"; of an infinite difference the numbers alone.
std::string to_string(const Worst& worst, std::string_view expected, std::string_view unit);

struct Measurement {
  std::string unit;
  std::uint64_t items = 0;      ///< pixels or records compared
  std::uint64_t differing = 0;  ///< items beyond their tolerance
  std::uint64_t ambiguous = 0;  ///< items for which more than one answer is legal
  std::uint64_t disputed = 0;   ///< items where the reference, not the candidate, is outside the legal answers
  double max_difference = 0;    ///< [unit], disputed values left out; infinite: NaN, a wrong size, a missing record
  double max_ratio = 0;         ///< largest (difference - allowance) / tolerance, likewise; above 1 an item differs
  Worst worst;
  Worst dispute;                        ///< the disputed value with the largest difference
  std::string reason;                   ///< the reference's fault at `dispute`
  std::vector<glm::ivec2> disputed_at;  ///< pixels of disputed items, where items have one
  /// Pixels of items that differ, where items have one; the first 2^16.
  std::vector<glm::ivec2> differing_at;
  std::string mismatch;  ///< why nothing could be compared item by item (sizes differ), or empty
  /// Items by difference: [0] none, [i] in [2^(i-13), 2^(i-12)) units, the ends open; [19]: not finite.
  std::array<std::uint64_t, 20> histogram{};
};

/// |a - b|; 0 for equal numbers, equal infinities included; infinite where anything else is not finite.
double difference(double a, double b);

/// Gathers a measurement item by item.
class Meter {
 public:
  explicit Meter(std::string unit) { m_.unit = std::move(unit); }

  /// One value of an item. `diff`, `tolerance`, `allowance` [the meter's unit]: differs where diff > allowance +
  /// tolerance; the allowance is another ledger row's and does not count in max_ratio. A NaN `diff` is infinite. Where
  /// the sum is not finite, or the tolerance negative, both are 0.
  void value(double diff, double tolerance, const Place& place, double candidate, double reference,
             double allowance = 0);
  /// Disputes the current item's later values that are beyond their tolerance: the reference's fault, for the reason
  /// `why`. Infinite differences, such as NaN, stay the candidate's. Empty: ends that.
  void suspect(std::string_view why) { why_ = why; }
  void ambiguous() { item_ambiguous_ = true; }
  /// Ends an item: counts it, adds its largest difference to the histogram, and ends suspect().
  void item();
  /// Counts `items` whole items as infinitely different. Call between items. `candidate`, `reference`: each side's
  /// count.
  void missing(std::uint64_t items, const Place& place, std::size_t candidate = 0, std::size_t reference = 0);
  Measurement done() { return std::move(m_); }

 private:
  Measurement m_;
  double item_difference_ = 0;
  bool item_differs_ = false, item_ambiguous_ = false, item_disputed_ = false;
  std::string why_;
};

/// The worse of two measurements of one stage: the one with more items beyond tolerance; of as many, the one with the
/// larger max_ratio.
inline Measurement worse(Measurement a, Measurement b) {
  const bool a_tells = a.differing != b.differing ? a.differing > b.differing : a.max_ratio >= b.max_ratio;
  return a_tells ? std::move(a) : std::move(b);
}

/// Measurement of sides that cannot be compared item by item: all items (at least 1) differ infinitely.
Measurement mismatch(std::string unit, std::string why, std::uint64_t items);

/// Whether two planes have one size and are not both empty. `why`: set to the reason where the result is false.
template <class A, class B>
bool same_size(const Plane<A>& a, const Plane<B>& b, std::string& why) {
  if (a.empty() && b.empty()) {
    why = "not handed out by either";
    return false;
  }
  if (a.width() == b.width() && a.height() == b.height()) return true;
  why = std::to_string(a.width()) + " x " + std::to_string(a.height()) + " against " + std::to_string(b.width()) +
        " x " + std::to_string(b.height());
  return false;
}

/// Compares pixel by pixel: `visit(meter, x, y)` gives the meter the pixel's values. Sizes differ or both are empty:
/// mismatch().
template <class A, class B, class Visit>
Measurement compare_planes(const Plane<A>& a, const Plane<B>& b, const std::string& unit, Visit visit) {
  std::string why;
  if (!same_size(a, b, why)) return mismatch(unit, why, a.size());
  Meter meter(unit);
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      visit(meter, x, y);
      meter.item();
    }
  }
  return meter.done();
}

/// Adds two integers of an item, subtracted modulo 2^64: no signed overflow, exact below 2^53. Zero tolerance.
template <class T>
void add_integers(Meter& meter, T a, T b, const Place& place) {
  const auto apart = static_cast<std::uint64_t>(std::max(a, b)) - static_cast<std::uint64_t>(std::min(a, b));
  meter.value(static_cast<double>(apart), 0, place, static_cast<double>(a), static_cast<double>(b));
}

/// Zero tolerance, for planes of integers.
template <class T>
Measurement compare_equal(const Plane<T>& candidate, const Plane<T>& reference, const std::string& unit) {
  return compare_planes(candidate, reference, unit, [&](Meter& meter, int x, int y) {
    add_integers(meter, candidate(x, y), reference(x, y), {x, y, -1, ""});
  });
}

}  // namespace plumbline::check
