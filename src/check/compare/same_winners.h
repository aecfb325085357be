// Parts of comparators of two renderers' planes: pixels' winners, pixels of one winner, and pixels that other fragments
// cover.
#pragma once

#include <cstdint>
#include <string>

#include "capture/capture.h"
#include "check/bounds/units.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

/// Stencil values beside winners: compared, or not shown by the candidate.
enum class Stencils { compared, not_shown };

/// A pixel's winner and stencil value; 0 where stencil values are not compared, or the candidate's frame holds none.
struct Winner {
  std::int32_t primitive = 0;
  int stencil = 0;
  bool operator==(const Winner&) const = default;
};

/// Compares winners, with stencil values where `stencils` says so; without a plane of winners, stencil values alone.
/// Where two winners differ, is_open(meter, x, y, a, b, held) tells whether both are legal; `held`: stencil values
/// count.
inline Measurement compare_winners_at_pixels(const Planes& a, const Planes& b, Stencils stencils, auto is_open) {
  const bool held = stencils == Stencils::compared && !a.stencil.empty();
  if (stencils == Stencils::compared && a.stencil.size() != b.stencil.size())
    return mismatch("pixels", "stencil values of one side alone", a.id.size());
  if (held && a.id.empty() && !b.id.empty()) {
    return compare_planes(a.stencil, b.stencil, "pixels", [&](Meter& meter, int x, int y) {
      const int mine = a.stencil(x, y), theirs = b.stencil(x, y);
      meter.value(mine == theirs ? 0 : 1, 0, {x, y, -1, "stencil"}, mine, theirs);
    });
  }
  return compare_planes(a.id, b.id, "pixels", [&](Meter& meter, int x, int y) {
    const auto winner = [&](const Planes& of) { return Winner{of.id(x, y), held ? of.stencil(x, y) : 0}; };
    const Winner mine = winner(a), theirs = winner(b);
    if (mine == theirs) return;
    if (is_open(meter, x, y, mine, theirs, held)) return meter.ambiguous();
    if (mine.primitive != theirs.primitive)
      return meter.value(1, 0, {x, y, -1, "primitive"}, mine.primitive, theirs.primitive);
    meter.value(1, 0, {x, y, -1, "stencil"}, mine.stencil, theirs.stencil);
  });
}

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
