#include "capture/legal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "capture/fragment_outcomes.h"

namespace plumbline {

namespace {

constexpr std::size_t kMostBranches = 256;

struct Interval {
  double lo, hi;
};

/// What a depth test may come to, over all depths that the intervals allow.
struct Test {
  bool may_pass, may_fail;
  Interval passed;  ///< depths of the hit with which it may pass
  Interval failed;  ///< held depths with which the hit may fail
  Interval under;   ///< held depths with which the hit may pass
};

/// Depths that are clamped to one end are one number in every arithmetic and format: a tie, which is not open.
bool tie_of_clamped(Interval a, Interval b) {
  return (a.lo == 0 || a.lo == 1) && a.lo == a.hi && a.lo == b.lo && a.lo == b.hi;
}

/// A depth that the frame holds.
struct Held {
  Interval z;
  std::int32_t surface;
};

/// Depth test of a hit against the depth that the frame holds. Depths at most a step apart may compare either way, so
/// that `less` and `less_equal` have the same outcomes, except at 0 and 1. Depths of one surface are equal.
Test depth_test(const Hit& of, const Held& frame, DepthFormat format) {
  const DepthFunc func = of.depth_func;
  const Interval hit{of.z_lo, of.z_hi}, held = frame.z;
  if (held.lo == held.hi && passes_all_over(func, held.lo)) return {true, false, hit, held, held};
  const double step = depth_step(format, std::max(hit.hi, held.hi));
  const bool is_same = of.surface != kNoSurface && of.surface == frame.surface;
  if (is_same || tie_of_clamped(hit, held)) {
    const Outcomes tie = outcomes(func, held.lo, held.lo, held.lo);
    return {tie.may_pass, tie.may_fail, held, held, held};
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
  return {static_cast<std::int32_t>(hit.primitive),
          static_cast<float>(hit.color_bound),
          z.lo,
          z.hi,
          hit.color,
          0,
          hit.surface};
}

/// Surface of a depth that is of surface a or of surface b: known only where the two are one.
std::int32_t either(std::int32_t a, std::int32_t b) { return a == b ? a : kNoSurface; }

/// Sorts by draw order, and merges answers of equal primitive and stencil value: their depth interval is the hull.
void unite(std::vector<LegalAnswer>& all) {
  const auto key = [](const LegalAnswer& l) { return std::pair(l.primitive, l.stencil); };
  std::ranges::stable_sort(all, {}, key);
  std::size_t kept = 0;
  for (const LegalAnswer& l : all) {
    if (kept > 0 && key(all[kept - 1]) == key(l)) {
      all[kept - 1].z_lo = std::min(all[kept - 1].z_lo, l.z_lo);
      all[kept - 1].z_hi = std::max(all[kept - 1].z_hi, l.z_hi);
      all[kept - 1].surface = either(all[kept - 1].surface, l.surface);
    } else {
      all[kept++] = l;
    }
  }
  all.resize(kept);
}

std::vector<LegalAnswer> united(std::vector<LegalAnswer> a, const std::vector<LegalAnswer>& b) {
  a.insert(a.end(), b.begin(), b.end());
  unite(a);
  return a;
}

/// Draws one hit over winners of any stencil values.
std::vector<LegalAnswer> drawn_by_stencil(const Hit& hit, bool certain, const StencilFace* face, DepthFormat format,
                                          const std::vector<LegalAnswer>& winners) {
  std::vector<LegalAnswer> left;
  const auto put = [&](LegalAnswer a, bool passes_depth, std::uint8_t held) {
    a.stencil = face == nullptr ? held : stencil_after(*face, passes_depth, held);
    left.push_back(a);
  };
  for (const LegalAnswer& held : winners) {
    if (!certain) left.push_back(held);
    if (face != nullptr && !stencil_passes(*face, held.stencil)) {
      put(held, false, held.stencil);
      continue;
    }
    const Test test = depth_test(hit, {{held.z_lo, held.z_hi}, held.surface}, format);
    if (test.may_fail) {  // `held` stays only where the hit fails
      LegalAnswer failed = held;
      failed.z_lo = test.failed.lo;
      failed.z_hi = test.failed.hi;
      put(failed, false, held.stencil);
    }
    if (!test.may_pass) continue;
    LegalAnswer passed = answer(hit, hit.depth_mask ? test.passed : test.under);
    if (!hit.depth_mask) passed.surface = held.surface;
    put(passed, true, held.stencil);
  }
  unite(left);
  return left;
}

using Group = std::vector<std::size_t>;  // indices of its hits

/// The hits of each group, by its number.
std::vector<Group> groups_of(std::span<const Hit> hits) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].group < 0) continue;
    const auto number = static_cast<std::size_t>(hits[i].group);
    if (number >= groups.size()) groups.resize(number + 1);
    groups[number].push_back(i);
  }
  return groups;
}

/// Folds hits of groups. From a group's first hit to its last there is a branch for each hit of the group, in which
/// that hit is certain. Groups that overlap multiply their branches; a group that would make more than kMostBranches
/// gets no branches, and its hits are merely possible.
class BranchedFold {
 public:
  explicit BranchedFold(const FrameFormat& frame) : branches_{{{}, LegalFold(frame)}} {}

  void open(const Group& group) {
    if (branches_.size() * group.size() > kMostBranches) return;
    open_.push_back(&group);
    std::vector<Branch> more;
    for (const Branch& branch : branches_) {
      for (const std::size_t member : group) {
        more.push_back(branch);
        more.back().chosen.push_back(member);
      }
    }
    branches_ = std::move(more);
  }
  void draw(const Hit& hit, std::size_t index) {
    for (Branch& branch : branches_) {
      branch.fold.draw(hit, hit.certain || std::ranges::find(branch.chosen, index) != branch.chosen.end());
    }
  }
  void close(const Group& group) {
    const auto at = std::ranges::find(open_, &group);
    if (at == open_.end()) return;
    const auto place = at - open_.begin();
    open_.erase(at);
    std::vector<Branch> fewer;
    for (Branch& branch : branches_) {
      branch.chosen.erase(branch.chosen.begin() + place);
      const auto same = std::ranges::find(fewer, branch.chosen, &Branch::chosen);
      if (same == fewer.end()) {
        fewer.push_back(std::move(branch));
      } else {
        same->fold.set(united(same->fold.winners(), branch.fold.winners()));
      }
    }
    branches_ = std::move(fewer);
  }
  /// After the last group was closed.
  const std::vector<LegalAnswer>& winners() const { return branches_.front().fold.winners(); }

 private:
  struct Branch {
    std::vector<std::size_t> chosen;  ///< of each open group
    LegalFold fold;
  };
  std::vector<const Group*> open_;
  std::vector<Branch> branches_;
};

}  // namespace

bool placed_alike(const Draw& a, const Draw& b) {
  return a.transforms == b.transforms && a.depth_range == b.depth_range && a.polygon_offset == b.polygon_offset &&
         a.lit == b.lit && a.shading == b.shading && a.texture.has_value() == b.texture.has_value() &&
         a.fog.has_value() == b.fog.has_value();
}

LegalFold::LegalFold(const FrameFormat& frame) : format_(frame.depth), background_(background(frame)) { clear(); }

void LegalFold::clear() {
  winners_.clear();
  runs_.clear();
  one_stencil_ = true;
  add(background_);
}

void LegalFold::add(const LegalAnswer& winner) {
  if (runs_.empty() || runs_.back().z_lo != winner.z_lo || runs_.back().z_hi != winner.z_hi ||
      runs_.back().surface != winner.surface) {
    runs_.push_back({winners_.size(), winner.z_lo, winner.z_hi, winner.surface});
  }
  winners_.push_back(winner);
}

void LegalFold::set(const std::vector<LegalAnswer>& winners) {
  winners_.clear();
  runs_.clear();
  for (const LegalAnswer& a : winners) add(a);
  one_stencil_ = std::ranges::all_of(winners_, [&](const LegalAnswer& a) { return a.stencil == winners_[0].stencil; });
}

void LegalFold::draw_in_runs(const Hit& hit, bool certain) {
  bool may_win = false;
  Interval won{0, 0};
  std::int32_t surface = hit.surface;
  const std::uint8_t stencil = winners_.empty() ? 0 : winners_.front().stencil;
  std::size_t kept = 0, kept_runs = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    Run run = runs_[r];
    const std::size_t first = run.first, last = r + 1 < runs_.size() ? runs_[r + 1].first : winners_.size();
    const Test test = depth_test(hit, {{run.z_lo, run.z_hi}, run.surface}, format_);
    if (test.may_pass) {
      const Interval left = hit.depth_mask ? test.passed : test.under;
      if (!hit.depth_mask) surface = may_win ? either(surface, run.surface) : run.surface;
      won = may_win ? Interval{std::min(won.lo, left.lo), std::max(won.hi, left.hi)} : left;
      may_win = true;
    }
    if (certain && !test.may_fail) continue;
    const bool narrower = certain && (test.failed.lo != run.z_lo || test.failed.hi != run.z_hi);
    run.first = kept;
    if (certain) {  // the run's winners stay only where the hit fails
      run.z_lo = test.failed.lo;
      run.z_hi = test.failed.hi;
    }
    if (narrower || kept != first) {
      for (std::size_t i = first; i < last; ++i) {
        winners_[kept + i - first] = winners_[i];
        winners_[kept + i - first].z_lo = run.z_lo;
        winners_[kept + i - first].z_hi = run.z_hi;
      }
    }
    kept += last - first;
    runs_[kept_runs++] = run;
  }
  winners_.resize(kept);
  runs_.resize(kept_runs);
  if (!may_win) return;
  LegalAnswer winner = answer(hit, won);
  winner.stencil = stencil;
  winner.surface = surface;
  add(winner);
}

void LegalFold::draw(const Hit& hit, bool certain, const StencilFace* face) {
  if (face == nullptr && one_stencil_) return draw_in_runs(hit, certain);
  set(drawn_by_stencil(hit, certain, face, format_, winners_));
}

void LegalFold::draw_either_side(const Hit& hit, bool certain) {
  if (hit.or_stencil == nullptr) return draw(hit, certain, hit.stencil);
  std::vector<LegalAnswer> other = drawn_by_stencil(hit, certain, hit.or_stencil, format_, winners_);
  draw(hit, certain, hit.stencil);
  set(united(winners_, other));
}

void LegalFold::draw(const Hit& hit, bool certain) {
  if (!hit.alpha_passes) return;
  certain = certain && !hit.alpha_fails;
  draw_either_side(hit, certain);
  if (hit.stencil == nullptr) return;
  for (std::uint32_t again = 1; again < hit.pieces; ++again) draw_either_side(hit, false);
}

void fold_hits(std::span<const Hit> hits, const FrameFormat& frame, std::vector<LegalAnswer>& out) {
  const std::vector<Group> groups = groups_of(hits);
  BranchedFold fold(frame);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Group* group = hits[i].group < 0 ? nullptr : &groups[static_cast<std::size_t>(hits[i].group)];
    if (group != nullptr && group->front() == i) fold.open(*group);
    fold.draw(hits[i], i);
    if (group != nullptr && group->back() == i) fold.close(*group);
  }
  out = fold.winners();
}

}  // namespace plumbline
