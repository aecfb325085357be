// Stage 4: window triangles against exact ones, and against another renderer's, bit for bit.
#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include "check/bounds/matched_by_primitive.h"
#include "check/bounds/units.h"
#include "check/compare/compare_records.h"
#include "check/compare/legal_window.h"
#include "check/verdict/ledger.h"

namespace plumbline::check {

namespace {

using Run = std::span<const WindowTriangle<double>>;
using Colors = std::array<Vec4<double>, 3>;

// Rotation (number of corners) by which another triangle fits `t` best: a renderer may begin a triangle at any corner,
// a line at its first alone. apart(turn): the misfit; the smallest turn wins ties.
template <class Apart>
std::size_t best_turn(const WindowTriangle<double>& t, Apart apart) {
  std::size_t best = 0;
  for (const std::size_t turn : {std::size_t{1}, std::size_t{2}}) {
    if (t.corners == 3 && apart(turn) < apart(best)) best = turn;
  }
  return best;
}

Colors colors_of(const WindowTriangle<double>& t) { return {t.v[0].color, t.v[1].color, t.v[2].color}; }

// Compares a candidate's run of records, the first of them number `first`, with the reference's run of the same
// primitive.
class RunComparison {
 public:
  RunComparison(Meter& meter, const Scene& scene, const Records<double>& candidate, const WindowRules& rules)
      : meter_(meter), rules_(rules), legal_(scene, candidate, rules.factor, rules.area, rules.conventions) {}

  void operator()(Run mine, Run theirs, std::size_t first) {
    const bool alike = std::ranges::equal(mine, theirs, [&](const auto& a, const auto& b) { return is_alike(a, b); });
    if (alike || !as_legal(mine, theirs, first)) strictly(mine, theirs, first);
  }

 private:
  // Equality of kind and facing, and of positions but for rounding.
  bool is_alike(const WindowTriangle<double>& a, const WindowTriangle<double>& b) const {
    if (a.corners != b.corners || a.front != b.front) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_at(a.v[k], b.v[k], error_of(b, k))) return false;
    }
    return true;
  }

  static bool is_at(const WindowVertex<double>& a, const WindowVertex<double>& b, const Vec3<double>& error) {
    const Vec3<double> off = glm::abs(a.p_win - b.p_win);
    return off.x <= error.x && off.y <= error.y && off.z <= error.z;
  }

  bool is_near(const WindowVertex<double>& a, const WindowVertex<double>& b, const Vec3<double>& error) const {
    return is_at(a, b, error) && std::abs(a.inv_w - b.inv_w) <= rules_.factor * u * std::abs(b.inv_w);
  }

  Vec3<double> error_of(const WindowTriangle<double>& t, std::size_t k) const {
    return legal_.error(t.primitive, t.v[k].p_win);
  }

  void strictly(Run mine, Run theirs, std::size_t first) {
    if (mine.size() != theirs.size()) {
      const Run more = mine.size() > theirs.size() ? mine : theirs;
      return meter_.missing(more.size(), {-1, -1, static_cast<std::int64_t>(more.front().primitive), "triangles", true},
                            mine.size(), theirs.size());
    }
    for (std::size_t i = 0; i < mine.size(); ++i) {
      meter_.value(mine[i].front == theirs[i].front ? 0 : kInfinite, 0, at(first + i, "front"), mine[i].front,
                   theirs[i].front);
      compare(mine[i], theirs[i], colors_of(theirs[i]), first + i);
      meter_.item();
    }
  }

  // If both runs are legal: compares each of the candidate's records with the reference's record of the same answer, if
  // there is one, else with the answer itself. False: a run is not legal. (The reference's area is that on a grid of
  // 1/256 pixel: its run need not be legal beside positions in float.)
  bool as_legal(Run mine, Run theirs, std::size_t first) {
    const auto lists = legal_.of((mine.empty() ? theirs : mine).front().primitive);
    const auto list_of = [&](Run run) {
      return std::ranges::find_if(lists, [&](const auto& list) { return legal_.match(run, list).has_value(); });
    };
    const auto my_list = list_of(mine), their_list = list_of(theirs);
    const bool is_own_grid = rules_.conventions.subpixel_bits != Conventions::kFloat;
    if (my_list == lists.end() || (is_own_grid && their_list == lists.end())) return false;
    using Answers = std::vector<std::size_t>;
    const Answers my_answers = legal_.match(mine, *my_list).value(),
                  their_answers = their_list == lists.end() ? Answers() : legal_.match(theirs, *their_list).value();
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const WindowAnswer& answer = (*my_list)[my_answers[i]];
      if (answer.has_no_area) {
        meter_.ambiguous();
        meter_.item();
        continue;
      }
      const auto same = my_list == their_list ? std::ranges::find(their_answers, my_answers[i]) : their_answers.end();
      const bool both = same != their_answers.end();
      const WindowTriangle<double>& other =
          both ? theirs[static_cast<std::size_t>(same - their_answers.begin())] : answer.record;
      const bool as_theirs = both && other.front == mine[i].front;
      if (!as_theirs) meter_.ambiguous();
      const Colors& colors = as_theirs       ? colors_of(other)
                             : mine[i].front ? colors_of(answer.record)
                                             : answer.back_color;
      compare_turned(mine[i], other, colors, first + i);
      meter_.item();
    }
    for (std::size_t i = mine.size(); i < theirs.size(); ++i) {
      meter_.ambiguous();
      meter_.item();
    }
    return true;
  }

  // compare(), with the other begun at the corner from which it fits best: within the errors of positions and 1/w (of
  // corners at one place, 1/w alone tells them apart), then nearest in place, then in colour.
  void compare_turned(const WindowTriangle<double>& a, WindowTriangle<double> b, Colors colors, std::size_t number) {
    const auto apart = [&](std::size_t turn) {
      int misfits = 0;
      double places = 0, shades = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto &v = a.v[k], &w = b.v[(k + turn) % 3];
        misfits += is_near(v, w, error_of(b, (k + turn) % 3)) ? 0 : 1;
        places = std::max(places, glm::length(v.p_win - w.p_win));
        shades = std::max(shades, glm::length(v.color - colors[(k + turn) % 3]));
      }
      return std::tuple(misfits, places, shades);
    };
    const std::size_t turn = best_turn(a, apart);
    std::rotate(b.v.begin(), b.v.begin() + static_cast<std::ptrdiff_t>(turn), b.v.end());
    std::rotate(colors.begin(), colors.begin() + static_cast<std::ptrdiff_t>(turn), colors.end());
    compare(a, b, colors, number);
  }

  // Everything but the facing.
  void compare(const WindowTriangle<double>& a, const WindowTriangle<double>& b, const Colors& colors,
               std::size_t number) {
    for (std::size_t k = 0; k < 3; ++k) {
      const WindowVertex<double>&v = a.v[k], &w = b.v[k];
      add(meter_, v.p_win, w.p_win, error_of(b, k) / rules_.factor, rules_.factor, at(number, "p_win"));
      meter_.value(difference(v.inv_w, w.inv_w) / (u * std::abs(w.inv_w) + kGradualUnderflow), rules_.factor,
                   at(number, "inv_w"), v.inv_w, w.inv_w);
      for (int c = 0; c < 2; ++c) {
        const double place = (v.p_win[c] - 0.5) * kSubpixel, own = snapped(rules_.conventions, c, place),
                     given = v.snapped[c];
        const bool may_be = rules_.area == FacingArea::either && may_be_snapped(c, place, given);
        meter_.value(may_be ? 0 : difference(given, own), 0, at(number, "snapped"), given, own);
      }
      const Vec4<double> allowance = rules_.colors * u * glm::max(glm::abs(colors[k]), Vec4<double>(1));
      add(meter_, v.color, colors[k], Vec4<double>(u), 0, at(number, "color"), allowance);
    }
    meter_.value(a.corners == b.corners ? 0 : kInfinite, 0, at(number, "corners"), a.corners, b.corners);
    meter_.value(difference(a.width, b.width), 0, at(number, "width"), a.width, b.width);
  }

  // True if a foreign renderer may snap `place` [1/256 pixel] to the grid position `other`. Rounded to the nearest, and
  // half way between two: to either, for no specification says which; exact takes the even one.
  bool may_be_snapped(int axis, double place, double other) const {
    if (rules_.conventions.subpixel_bits == Conventions::kFloat || rules_.conventions.subpixel_bits > 8) return false;
    if (rules_.conventions.subpixel_rounding != Conventions::Rounding::nearest) {
      const auto [least, most] = snapped_range(rules_.conventions, axis, place);
      return other == least || other == most;
    }
    const double steps = in_steps(rules_.conventions, axis, place / kSubpixel + 0.5);
    const double quarter = std::exp2(6 - rules_.conventions.subpixel_bits);  // of a step
    return steps - std::floor(steps) == 0.5 && (other == snapped(rules_.conventions, axis, place - quarter) ||
                                                other == snapped(rules_.conventions, axis, place + quarter));
  }

  static Place at(std::size_t number, const char* field) { return {-1, -1, static_cast<std::int64_t>(number), field}; }

  Meter& meter_;
  const WindowRules& rules_;
  LegalWindow legal_;
};

}  // namespace

Measurement compare_window(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           const WindowRules& rules) {
  const auto &a = candidate.triangles, &b = reference.triangles;
  if (candidate.matrices.empty() || candidate.matrices.size() != scene.draws.size()) {
    return mismatch("u", fmt::format("{} matrices for {} draws", candidate.matrices.size(), scene.draws.size()),
                    std::max(a.size(), b.size()));
  }
  Meter meter("u");
  RunComparison compare(meter, scene, candidate, rules);
  matched_by_primitive(Run(a), Run(b), [&](Run mine, Run theirs) {
    compare(mine, theirs, mine.empty() ? 0 : static_cast<std::size_t>(mine.data() - a.data()));
  });
  return meter.done();
}

namespace {

// Numbers of the records whose primitive is not among `apart`, which is sorted.
std::vector<std::size_t> records_beside(const std::vector<WindowTriangle<double>>& triangles,
                                        std::span<const std::uint32_t> apart) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!std::ranges::binary_search(apart, triangles[i].primitive)) out.push_back(i);
  }
  return out;
}

}  // namespace

Measurement compare_window_equal(const Records<double>& candidate, const Records<double>& reference, double factor,
                                 std::span<const std::uint32_t> turned) {
  const std::vector<std::size_t> mine = records_beside(candidate.triangles, turned),
                                 theirs = records_beside(reference.triangles, turned);
  Measurement m = each("window triangles", "ULP", mine.size(), theirs.size(), [&](Meter& meter, std::size_t number) {
    const std::size_t i = mine[number];
    const WindowTriangle<double>&a = candidate.triangles[i], &b = reference.triangles[theirs[number]];
    const auto at = [&](const char* field) { return Place{-1, -1, static_cast<std::int64_t>(i), field}; };
    meter.value(a.primitive == b.primitive ? 0 : kInfinite, 0, at("primitive"), a.primitive, b.primitive);
    if (a.corners == 3) meter.value(a.front == b.front ? 0 : kInfinite, 0, at("front"), a.front, b.front);
    meter.value(a.corners == b.corners ? 0 : kInfinite, 0, at("corners"), a.corners, b.corners);
    meter.value(difference(a.width, b.width), 0, at("width"), a.width, b.width);
    const std::size_t turn = best_turn(a, [&](std::size_t by) {
      int n = 0;
      for (std::size_t k = 0; k < 3; ++k) n += a.v[k].p_win != b.v[(k + by) % 3].p_win ? 1 : 0;
      return n;
    });
    for (std::size_t k = 0; k < 3; ++k) {
      const WindowVertex<double>&v = a.v[k], &w = b.v[(k + turn) % 3];
      for (int c = 0; c < 3; ++c) {
        const double diff = difference(v.p_win[c], w.p_win[c]);
        meter.value(diff == 0 ? 0 : diff / ulp(w.p_win[c]), 0, at("p_win"), v.p_win[c], w.p_win[c]);
      }
      const double diff_w = difference(v.inv_w, w.inv_w);
      meter.value(diff_w == 0 ? 0 : diff_w / ulp(w.inv_w), factor, at("inv_w"), v.inv_w, w.inv_w,
                  kFlushedUnderflow / ulp(w.inv_w));
      for (int c = 0; c < 2; ++c) {
        const double x = v.snapped[c], y = w.snapped[c];
        meter.value(difference(x, y), 0, at("snapped"), x, y);
      }
    }
  });
  m.items += turned.size();
  m.ambiguous += turned.size();
  return m;
}

}  // namespace plumbline::check
