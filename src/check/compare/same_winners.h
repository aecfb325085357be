// Parts of comparators of two renderers' planes: pixels of one winner, and pixels that other fragments cover.
#pragma once

#include <string>

#include "capture/capture.h"
#include "check/bounds/units.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

/// Compares a plane (such as &Planes::color) by visit(meter, x, y, winner) where both sides have the same winner;
/// visibility judges the other pixels.
inline Measurement where_winners_agree(const Planes& a, const Planes& b, auto plane, const std::string& unit,
                                       auto visit) {
  std::string why;
  if (!same_size(a.id, b.id, why) || !same_size(a.id, a.*plane, why)) return mismatch(unit, why, a.id.size());
  return compare_planes(a.*plane, b.*plane, unit, [&](Meter& meter, int x, int y) {
    const std::int32_t id = a.id(x, y);
    if (id == b.id(x, y)) visit(meter, x, y, id);
  });
}

/// Pixels that the two sides cover with different fragments (lines by different rules); coverage judges them. Counts
/// are compared as well as sums, because primitive 0 has weight 0 in the sum.
class OthersCover {
 public:
  OthersCover(const Planes& a, const Planes& b) : a_(a), b_(b) {
    std::string why;
    comparable_ = same_size(a.id_sum, b.id_sum, why) && same_size(a.id_sum, a.id, why) &&
                  same_size(a.count, b.count, why) && same_size(a.count, a.id, why);
  }
  bool operator()(int x, int y) const {
    return comparable_ && (a_.id_sum(x, y) != b_.id_sum(x, y) || a_.count(x, y) != b_.count(x, y));
  }

 private:
  const Planes &a_, &b_;
  bool comparable_ = false;
};

}  // namespace plumbline::check
