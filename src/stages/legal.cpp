#include "stages/legal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "stages/capture.h"
#include "stages/fragment_outcomes.h"

namespace plumbline {

namespace {

/// More combinations of "which member of each group is the certain one" than this are not told apart.
constexpr std::size_t kMostCombinations = 256;

struct Interval {
  double lo, hi;
};

/// What a depth test may come to, over all depths that the intervals allow.
struct Test {
  bool may_pass, may_fail;
  Interval passed;  ///< the hit's depths under which it passes
  Interval failed;  ///< the held depths under which the hit fails
  Interval under;   ///< the held depths under which it passes
};

/// Depths that are clamped to one end are one number in every arithmetic and format: a tie, which is not open.
bool tie_of_clamped(Interval a, Interval b) {
  return (a.lo == 0 || a.lo == 1) && a.lo == a.hi && a.lo == b.lo && a.lo == b.hi;
}

/// `hit` against the depth that the frame holds; depths no more than `step` apart may compare either way, so that
/// "less" and "less or equal" allow the same.
Test depth_test(DepthFunc func, Interval hit, Interval held, double step) {
  if (tie_of_clamped(hit, held)) {
    const Outcomes tie = outcomes(func, hit.lo, hit.lo, held.lo);
    return {tie.may_pass, tie.may_fail, hit, held, held};
  }
  const bool may_be_less = hit.lo <= held.hi + step, may_be_greater = hit.hi >= held.lo - step;
  const Interval hit_if_less{hit.lo, std::min(hit.hi, held.hi + step)};
  const Interval hit_if_greater{std::max(hit.lo, held.lo - step), hit.hi};
  const Interval held_if_less{std::max(held.lo, hit.lo - step), held.hi};  // the hit is less: what is held is greater
  const Interval held_if_greater{held.lo, std::min(held.hi, hit.hi + step)};
  switch (func) {
    case DepthFunc::never: return {false, true, hit, held, held};
    case DepthFunc::always: return {true, false, hit, held, held};
    case DepthFunc::less:
    case DepthFunc::less_equal: return {may_be_less, may_be_greater, hit_if_less, held_if_greater, held_if_less};
    case DepthFunc::greater:
    case DepthFunc::greater_equal: return {may_be_greater, may_be_less, hit_if_greater, held_if_less, held_if_greater};
    case DepthFunc::equal:
      return {may_be_less && may_be_greater, true, {hit_if_greater.lo, hit_if_less.hi}, held, held};
    case DepthFunc::not_equal:
      return {true, may_be_less && may_be_greater, hit, {held_if_less.lo, held_if_greater.hi}, held};
  }
  return {true, true, hit, held, held};
}

LegalAnswer background(const FrameFormat& frame) {
  const double z = depth_in_format(frame.depth, frame.clear_depth);
  return {kBackground, 0, z, z, frame.clear_color, frame.clear_stencil};
}

LegalAnswer answer(const Hit& hit, Interval z) {
  return {static_cast<std::int32_t>(hit.primitive), static_cast<float>(hit.color_bound), z.lo, z.hi, hit.color};
}

void add(const LegalAnswer& answer, std::vector<LegalAnswer>& all) {
  for (LegalAnswer& a : all) {
    if (a.primitive != answer.primitive || a.stencil != answer.stencil) continue;
    a.z_lo = std::min(a.z_lo, answer.z_lo);
    a.z_hi = std::max(a.z_hi, answer.z_hi);
    return;
  }
  all.push_back(answer);
}

/// Draws one hit over every winner so far, all of one stencil value that stays. A winner's interval is the hull of the
/// depths that it may hold.
void draw_without_stencil(const Hit& hit, bool certain, DepthFormat format, std::vector<LegalAnswer>& winners) {
  bool may_win = false;
  Interval won{0, 0};
  std::size_t kept = 0;
  const std::uint8_t stencil = winners.empty() ? 0 : winners.front().stencil;
  for (LegalAnswer& held : winners) {
    const double step = depth_step(format, std::max(hit.z_hi, held.z_hi));
    const Test test = depth_test(hit.depth_func, {hit.z_lo, hit.z_hi}, {held.z_lo, held.z_hi}, step);
    if (test.may_pass) {
      const Interval left = hit.depth_mask ? test.passed : test.under;
      won = may_win ? Interval{std::min(won.lo, left.lo), std::max(won.hi, left.hi)} : left;
      may_win = true;
    }
    if (certain && !test.may_fail) continue;
    if (certain) {  // it stays only by the hit's failing
      held.z_lo = test.failed.lo;
      held.z_hi = test.failed.hi;
    }
    winners[kept++] = held;
  }
  winners.resize(kept);
  if (!may_win) return;
  winners.push_back(answer(hit, won));
  winners.back().stencil = stencil;
}

/// The same in general.
void draw(const Hit& hit, bool certain, const StencilFace* face, DepthFormat format,
          std::vector<LegalAnswer>& winners) {
  const auto alike = [&](const LegalAnswer& a) { return a.stencil == winners.front().stencil; };
  if (face == nullptr && std::ranges::all_of(winners, alike)) {
    return draw_without_stencil(hit, certain, format, winners);
  }
  std::vector<LegalAnswer> left, won;
  const auto put = [&](LegalAnswer a, bool nearer, std::uint8_t held, std::vector<LegalAnswer>& to) {
    a.stencil = face == nullptr ? held : stencil_after(*face, nearer, held);
    add(a, to);
  };
  for (const LegalAnswer& held : winners) {
    if (!certain) add(held, left);
    if (face != nullptr && !stencil_passes(*face, held.stencil)) {
      put(held, false, held.stencil, left);
      continue;
    }
    const double step = depth_step(format, std::max(hit.z_hi, held.z_hi));
    const Test test = depth_test(hit.depth_func, {hit.z_lo, hit.z_hi}, {held.z_lo, held.z_hi}, step);
    if (test.may_fail) {  // it stays only by the hit's failing
      LegalAnswer failed = held;
      failed.z_lo = test.failed.lo;
      failed.z_hi = test.failed.hi;
      put(failed, false, held.stencil, left);
    }
    if (!test.may_pass) continue;
    put(answer(hit, hit.depth_mask ? test.passed : test.under), true, held.stencil, won);
  }
  winners = std::move(left);
  for (const LegalAnswer& a : won) add(a, winners);
}

void draw(const Hit& hit, bool certain, DepthFormat format, std::vector<LegalAnswer>& winners) {
  if (!hit.alpha_passes) return;
  certain = certain && !hit.alpha_fails;
  std::vector<LegalAnswer> other = hit.or_stencil == nullptr ? std::vector<LegalAnswer>{} : winners;
  draw(hit, certain, hit.stencil, format, winners);
  if (hit.or_stencil == nullptr) return;
  draw(hit, certain, hit.or_stencil, format, other);
  for (const LegalAnswer& a : other) add(a, winners);
}

/// `chosen`: per hit, whether it counts as certain besides those that are.
void fold(std::span<const Hit> hits, const std::vector<bool>& chosen, const FrameFormat& frame,
          std::vector<LegalAnswer>& winners) {
  winners.assign(1, background(frame));
  for (std::size_t i = 0; i < hits.size(); ++i) {
    draw(hits[i], hits[i].certain || (!chosen.empty() && chosen[i]), frame.depth, winners);
    if (hits[i].twice && hits[i].stencil != nullptr) draw(hits[i], false, frame.depth, winners);
  }
}

/// The members of each group, as indices into `hits`.
std::vector<std::vector<std::size_t>> groups_of(std::span<const Hit> hits) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].group < 0) continue;
    const auto same = [&](const std::vector<std::size_t>& g) { return hits[g.front()].group == hits[i].group; };
    const auto found = std::find_if(groups.begin(), groups.end(), same);
    if (found == groups.end()) {
      groups.push_back({i});
    } else {
      found->push_back(i);
    }
  }
  return groups;
}

void unite(const std::vector<LegalAnswer>& more, std::vector<LegalAnswer>& all) {
  for (const LegalAnswer& a : more) {
    const auto key = [](const LegalAnswer& l) { return std::pair(l.primitive, l.stencil); };
    const auto at = std::ranges::lower_bound(all, key(a), {}, key);
    if (at == all.end() || key(*at) != key(a)) {
      all.insert(at, a);
    } else {
      at->z_lo = std::min(at->z_lo, a.z_lo);
      at->z_hi = std::max(at->z_hi, a.z_hi);
    }
  }
}

}  // namespace

void fold_hits(std::span<const Hit> hits, const FrameFormat& frame, std::vector<LegalAnswer>& out) {
  out.clear();
  const bool grouped = std::any_of(hits.begin(), hits.end(), [](const Hit& hit) { return hit.group >= 0; });
  if (!grouped) return fold(hits, {}, frame, out);

  std::vector<std::vector<std::size_t>> groups = groups_of(hits);
  std::size_t combinations = 1, told_apart = 0;
  while (told_apart < groups.size() && combinations * groups[told_apart].size() <= kMostCombinations) {
    combinations *= groups[told_apart++].size();
  }
  groups.resize(told_apart);  // the members of the others are merely possible
  std::vector<LegalAnswer> winners;
  std::vector<bool> chosen(hits.size());
  for (std::size_t combination = 0; combination < combinations; ++combination) {
    chosen.assign(hits.size(), false);
    std::size_t rest = combination;
    for (const std::vector<std::size_t>& group : groups) {
      chosen[group[rest % group.size()]] = true;
      rest /= group.size();
    }
    fold(hits, chosen, frame, winners);
    unite(winners, out);
  }
}

}  // namespace plumbline
