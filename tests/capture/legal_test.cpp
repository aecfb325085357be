// fold_hits(): every outcome that a legal renderer may come to is in the set, and where nothing is open, one is.
#include "capture/legal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "capture/capture.h"
#include "capture/fragment_outcomes.h"

namespace plumbline {
namespace {

constexpr std::array kFuncs = {DepthFunc::never,         DepthFunc::less,    DepthFunc::equal,
                               DepthFunc::less_equal,    DepthFunc::greater, DepthFunc::not_equal,
                               DepthFunc::greater_equal, DepthFunc::always};

Hit hit(std::uint32_t primitive, double lo, double hi, DepthFunc func = DepthFunc::less) {
  return {.primitive = primitive, .depth_func = func, .certain = true, .group = -1, .z_lo = lo, .z_hi = hi};
}
Hit maybe(Hit h, int group = -1) {
  h.certain = false;
  h.group = group;
  return h;
}

std::vector<LegalAnswer> answers(const std::vector<Hit>& hits, const FrameFormat& frame = {}) {
  std::vector<LegalAnswer> out;
  fold_hits(hits, frame, out);
  return out;
}
std::vector<int> winners(const std::vector<Hit>& hits, const FrameFormat& frame = {}) {
  std::vector<int> ids;
  for (const LegalAnswer& a : answers(hits, frame)) ids.push_back(a.primitive);
  return ids;
}
using Ids = std::vector<int>;

TEST(FoldHits, NoHitsLeaveTheBackground) {
  FrameFormat frame;
  frame.clear_color = {0.25f, 0.5f, 0.75f, 1};
  frame.clear_depth = 0.3;
  frame.depth = DepthFormat::z16;
  const auto all = answers({}, frame);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].primitive, kBackground);
  EXPECT_EQ(all[0].color, frame.clear_color);
  EXPECT_EQ(all[0].color_bound, 0);
  EXPECT_DOUBLE_EQ(all[0].z_lo, 19660.0 / 65535);  // 0.3 * 65535 = 19660.5 in the reals, and just below in double
  EXPECT_EQ(all[0].z_lo, all[0].z_hi);
  frame.depth = DepthFormat::z8;
  EXPECT_DOUBLE_EQ(answers({}, frame)[0].z_lo, 77.0 / 255);  // 76.5, half up
}

Hit of_surface(Hit h, std::int32_t surface) {
  h.surface = surface;
  return h;
}

// Where depths are equal, the depth function alone decides; else both are legal.
TEST(FoldHits, DepthsOfOneSurfaceAreEqual) {
  using F = DepthFunc;
  for (const auto& [func, again] :
       {std::pair(F::less, 0), std::pair(F::less_equal, 1), std::pair(F::greater, 0), std::pair(F::greater_equal, 1),
        std::pair(F::equal, 1), std::pair(F::not_equal, 0), std::pair(F::always, 1), std::pair(F::never, 0)}) {
    const Hit first = hit(0, 0.4, 0.5, F::always), second = hit(1, 0.4, 0.5, func);
    EXPECT_EQ(winners({of_surface(first, 0), of_surface(second, 0)}), Ids{again}) << static_cast<int>(func);
    const bool is_open = func != F::always && func != F::never;
    EXPECT_EQ(winners({of_surface(first, 0), of_surface(second, 1)}), is_open ? (Ids{0, 1}) : Ids{again});
    EXPECT_EQ(winners({first, second}), is_open ? (Ids{0, 1}) : Ids{again});
  }
}

// The held depth is that of the surface that wrote it last, not of the one that is seen.
TEST(FoldHits, AHitWithoutDepthMaskLeavesTheSurface) {
  const Hit wall = of_surface(hit(0, 0.4, 0.5), 0), again = of_surface(hit(2, 0.4, 0.5), 0);
  Hit decal = of_surface(hit(1, 0.1, 0.2), 1);
  decal.depth_mask = false;
  EXPECT_EQ(winners({wall, decal, again}), Ids{1});
  EXPECT_EQ(winners({wall, decal, of_surface(hit(2, 0.1, 0.2), 1)}), Ids{2}) << "the decal's depth is not held";
}

TEST(FoldHits, ASurfaceThatMayBeThereTiesWhereItIs) {
  const Hit first = of_surface(maybe(hit(0, 0.4, 0.5)), 0), second = of_surface(hit(1, 0.4, 0.5), 0);
  EXPECT_EQ(winners({first, second}), (Ids{0, 1})) << "the second wins where the first is not";
  EXPECT_EQ(winners({of_surface(hit(0, 0.4, 0.5), 0), maybe(second)}), Ids{0});
}

TEST(FoldHits, SurfacesTieUnderAStencilTest) {
  FrameFormat frame;
  frame.stencil = StencilFormat::s8;
  StencilFace face;
  Hit first = of_surface(hit(0, 0.4, 0.5), 0), second = of_surface(hit(1, 0.4, 0.5), 0);
  first.stencil = second.stencil = &face;
  EXPECT_EQ(winners({first, second}, frame), Ids{0});
  second.surface = 1;
  EXPECT_EQ(winners({first, second}, frame), (Ids{0, 1}));
}

TEST(FoldHits, ACertainHitReplacesTheBackground) {
  Hit h = hit(7, 0.4, 0.41);
  h.color = {1, 0.5, 0, 1};
  h.color_bound = 0.125;
  const auto all = answers({h});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].primitive, 7);
  EXPECT_EQ(all[0].z_lo, 0.4);
  EXPECT_EQ(all[0].z_hi, 0.41);
  EXPECT_EQ(all[0].color, glm::vec4(1, 0.5f, 0, 1));
  EXPECT_EQ(all[0].color_bound, 0.125f);
}

TEST(FoldHits, APossibleHitLeavesBoth) { EXPECT_EQ(winners({maybe(hit(3, 0.4, 0.41))}), (Ids{-1, 3})); }

TEST(FoldHits, WellSeparatedCertainHitsHaveOneAnswerUnderEachFunction) {
  const auto pair = [](DepthFunc func, double first, double second) {
    FrameFormat frame;
    frame.clear_depth = func == DepthFunc::greater || func == DepthFunc::greater_equal ? 0 : 1;
    return winners({hit(0, first, first + 0.01, func), hit(1, second, second + 0.01, func)}, frame);
  };
  EXPECT_EQ(pair(DepthFunc::never, 0.2, 0.4), (Ids{-1}));
  EXPECT_EQ(pair(DepthFunc::less, 0.2, 0.4), (Ids{0}));
  EXPECT_EQ(pair(DepthFunc::less, 0.4, 0.2), (Ids{1}));
  EXPECT_EQ(pair(DepthFunc::equal, 0.2, 0.4), (Ids{-1}));
  EXPECT_EQ(pair(DepthFunc::less_equal, 0.2, 0.4), (Ids{0}));
  EXPECT_EQ(pair(DepthFunc::less_equal, 0.4, 0.2), (Ids{1}));
  EXPECT_EQ(pair(DepthFunc::greater, 0.2, 0.4), (Ids{1}));
  EXPECT_EQ(pair(DepthFunc::greater, 0.4, 0.2), (Ids{0}));
  EXPECT_EQ(pair(DepthFunc::not_equal, 0.2, 0.4), (Ids{1}));
  EXPECT_EQ(pair(DepthFunc::not_equal, 0.4, 0.2), (Ids{1}));
  EXPECT_EQ(pair(DepthFunc::greater_equal, 0.2, 0.4), (Ids{1}));
  EXPECT_EQ(pair(DepthFunc::greater_equal, 0.4, 0.2), (Ids{0}));
  EXPECT_EQ(pair(DepthFunc::always, 0.2, 0.4), (Ids{1}));
  EXPECT_EQ(pair(DepthFunc::always, 0.4, 0.2), (Ids{1}));
}

TEST(FoldHits, DepthsWithinAStepMayCompareEitherWay) {
  FrameFormat frame;
  frame.depth = DepthFormat::z16;
  const double step = 1.0 / 65535;
  EXPECT_EQ(winners({hit(0, 0.5, 0.5), hit(1, 0.5 + 0.9 * step, 0.5 + 0.9 * step)}, frame), (Ids{0, 1}));
  EXPECT_EQ(winners({hit(0, 0.5, 0.5), hit(1, 0.5 + 1.1 * step, 0.5 + 1.1 * step)}, frame), (Ids{0}));
  EXPECT_EQ(winners({hit(0, 0.5, 0.5), hit(1, 0.5 - 1.1 * step, 0.5 - 1.1 * step)}, frame), (Ids{1}));
  frame.depth = DepthFormat::z24;
  EXPECT_EQ(winners({hit(0, 0.5, 0.5), hit(1, 0.5 + 0.9 * step, 0.5 + 0.9 * step)}, frame), (Ids{0}));
}

TEST(FoldHits, DepthsClampedToOneEndAreATieThatTheFunctionSettles) {
  for (const double end : {0.0, 1.0}) {
    FrameFormat frame;
    frame.clear_depth = 0.5;
    const auto pair = [&](DepthFunc func) {
      return winners({hit(0, end, end, DepthFunc::always), hit(1, end, end, func)}, frame);
    };
    EXPECT_EQ(pair(DepthFunc::never), (Ids{0}));
    EXPECT_EQ(pair(DepthFunc::less), (Ids{0}));
    EXPECT_EQ(pair(DepthFunc::equal), (Ids{1}));
    EXPECT_EQ(pair(DepthFunc::less_equal), (Ids{1}));
    EXPECT_EQ(pair(DepthFunc::greater), (Ids{0}));
    EXPECT_EQ(pair(DepthFunc::not_equal), (Ids{0}));
    EXPECT_EQ(pair(DepthFunc::greater_equal), (Ids{1}));
    EXPECT_EQ(pair(DepthFunc::always), (Ids{1}));
    // Which may or may not be clamped is open still.
    const double other = end == 0 ? 1e-9 : 1 - 1e-9, lo = std::min(end, other), hi = std::max(end, other);
    EXPECT_EQ(winners({hit(0, end, end, DepthFunc::always), hit(1, lo, hi)}, frame), (Ids{0, 1}));
    EXPECT_EQ(winners({hit(0, lo, hi, DepthFunc::always), hit(1, end, end)}, frame), (Ids{0, 1}));
  }
  EXPECT_EQ(winners({hit(0, 1, 1)}), (Ids{-1})) << "the cleared depth is such an end too";
  EXPECT_EQ(winners({hit(0, 0.25, 0.25), hit(1, 0.25, 0.25)}), (Ids{0, 1})) << "no end: rounded by who knows whom";
}

// A sky that reaches the far plane is not left out (passes_all_over()).
TEST(FoldHits, NothingFailsLessOrEqualOverTheFarthestDepth) {
  const double nearly = 1 - depth_step(DepthFormat::z24, 1) / 2;
  const Hit sky = hit(0, nearly, 1, DepthFunc::less_equal);
  EXPECT_EQ(winners({sky}), (Ids{0}));
  EXPECT_EQ(winners({maybe(sky)}), (Ids{-1, 0})) << "a hit that may be";
  EXPECT_EQ(winners({hit(0, nearly, 1)}), (Ids{-1, 0})) << "less";
  EXPECT_EQ(answers({sky})[0].z_lo, nearly);
  EXPECT_EQ(answers({sky})[0].z_hi, 1);
}

TEST(FoldHits, PassingAndFailingNarrowTheInterval) {
  const auto all = answers({hit(0, 0.4, 0.5), hit(1, 0.45, 0.6)});
  const double step = depth_step(DepthFormat::z24, 0.6);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].z_lo, 0.4);  // 1 failed: 0 is no farther than 0.6, which says nothing
  EXPECT_EQ(all[0].z_hi, 0.5);
  EXPECT_EQ(all[1].z_lo, 0.45);
  EXPECT_DOUBLE_EQ(all[1].z_hi, 0.5 + step);  // 1 passed, so it is nearer than some depth of 0
  const auto other = answers({hit(0, 0.4, 0.6), hit(1, 0.3, 0.5)});
  ASSERT_EQ(other.size(), 2u);
  EXPECT_DOUBLE_EQ(other[0].z_hi, 0.5 + step);  // 0 stays only where 1 is not nearer
}

TEST(FoldHits, AGroupCoversButAnyOneMemberMayNot) {
  EXPECT_EQ(winners({maybe(hit(0, 0.4, 0.41)), maybe(hit(1, 0.4, 0.41))}), (Ids{-1, 0, 1}));
  EXPECT_EQ(winners({maybe(hit(0, 0.4, 0.41), 5), maybe(hit(1, 0.4, 0.41), 5)}), (Ids{0, 1}));
  // Two groups, one behind the other: neither the background nor the farther group can be seen.
  EXPECT_EQ(winners({maybe(hit(0, 0.6, 0.61), 0), maybe(hit(1, 0.6, 0.61), 0), maybe(hit(2, 0.4, 0.41), 1),
                     maybe(hit(3, 0.4, 0.41), 1)}),
            (Ids{2, 3}));
}

TEST(FoldHits, TooManyGroupsWidenTheSetOnly) {
  std::vector<Hit> hits;
  for (std::uint32_t i = 0; i < 40; ++i) hits.push_back(maybe(hit(i, 0.4, 0.41), static_cast<int>(i / 2)));
  const Ids ids = winners(hits);
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(std::find(ids.begin(), ids.end(), i) != ids.end());
  EXPECT_EQ(ids.front(), 0);  // the groups that are told apart still shut the background out
}

TEST(FoldHits, EmptiesOut) {
  std::vector<LegalAnswer> out(3);
  fold_hits({}, FrameFormat{}, out);
  EXPECT_EQ(out.size(), 1u);
}

// Brute force: depths drawn from the intervals, coverage from what the hits allow, folded in plain codes.

bool passes(DepthFunc func, long z, long held) {
  switch (func) {
    case DepthFunc::never: return false;
    case DepthFunc::less: return z < held;
    case DepthFunc::equal: return z == held;
    case DepthFunc::less_equal: return z <= held;
    case DepthFunc::greater: return z > held;
    case DepthFunc::not_equal: return z != held;
    case DepthFunc::greater_equal: return z >= held;
    case DepthFunc::always: return true;
  }
  return false;
}

constexpr double kCodes = 65535;

/// All ways of covering the pixel that the hits allow, as bit sets.
std::vector<unsigned> coverages(const std::vector<Hit>& hits) {
  std::vector<unsigned> out;
  for (unsigned set = 0; set < 1u << hits.size(); ++set) {
    bool legal = true;
    std::set<int> groups, covered;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const bool covers = (set >> i & 1u) != 0;
      legal &= covers || !hits[i].certain;
      if (hits[i].group < 0) continue;
      groups.insert(hits[i].group);
      if (covers) covered.insert(hits[i].group);
    }
    if (legal && groups == covered) out.push_back(set);
  }
  return out;
}

class BruteForce : public ::testing::TestWithParam<int> {};

TEST_P(BruteForce, EveryOutcomeIsInTheSet) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  FrameFormat frame;
  frame.depth = DepthFormat::z16;
  for (int round = 0; round < 300; ++round) {
    frame.clear_depth = std::array{0.0, 1.0, 30005 / kCodes}[static_cast<std::size_t>(below(3))];
    std::vector<Hit> hits;
    const int count = below(5);
    for (int i = 0; i < count; ++i) {
      const int lo = 30000 + below(10), hi = lo + below(6);
      Hit h = hit(static_cast<std::uint32_t>(i), lo / kCodes, hi / kCodes,
                  below(2) == 0 ? DepthFunc::less : kFuncs[static_cast<std::size_t>(below(8))]);
      h.depth_mask = below(4) != 0;
      hits.push_back(below(2) == 0 ? h : maybe(h, below(4) - 2 < 0 ? -1 : below(2)));
    }
    const auto all = answers(hits, frame);
    ASSERT_TRUE(
        std::is_sorted(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.primitive < b.primitive; }));
    for (const unsigned set : coverages(hits)) {
      for (int sample = 0; sample < 60; ++sample) {
        int winner = kBackground;
        long held = std::lround(frame.clear_depth * kCodes);
        for (std::size_t i = 0; i < hits.size(); ++i) {
          if ((set >> i & 1u) == 0) continue;
          const long lo = std::lround(hits[i].z_lo * kCodes), hi = std::lround(hits[i].z_hi * kCodes);
          const long z = lo + below(static_cast<int>(hi - lo) + 1);
          if (!passes(hits[i].depth_func, z, held)) continue;
          winner = static_cast<int>(i);
          if (hits[i].depth_mask) held = z;
        }
        const auto found = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.primitive == winner; });
        ASSERT_TRUE(found != all.end()) << "round " << round << ": " << winner << " is not among the answers";
        const double z = static_cast<double>(held) / kCodes;
        ASSERT_LE(found->z_lo, z + 1e-12) << "round " << round;
        ASSERT_GE(found->z_hi, z - 1e-12) << "round " << round;
      }
    }
    // Narrower intervals leave no more open.
    std::vector<Hit> narrow = hits;
    for (Hit& h : narrow) h.z_lo = h.z_hi = 0.5 * (h.z_lo + h.z_hi);
    for (const LegalAnswer& a : answers(narrow, frame)) {
      const auto same = [&](const auto& wide) { return wide.primitive == a.primitive; };
      ASSERT_TRUE(std::any_of(all.begin(), all.end(), same)) << "round " << round;
    }
    ASSERT_LE(all.size(), hits.size() + 1);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, BruteForce, ::testing::Range(1, 21));

// Where all depths are more than a step apart and the coverage is certain, the fold has nothing to leave open.
TEST(FoldHits, SeparatedPointsGiveExactlyThePlainFoldsWinner) {
  std::mt19937 random(99);
  FrameFormat frame;
  frame.depth = DepthFormat::z16;
  for (int round = 0; round < 5000; ++round) {
    std::vector<Hit> hits;
    std::vector<long> codes;
    for (long code = 100; code < 160; code += 10) codes.push_back(code);
    std::shuffle(codes.begin(), codes.end(), random);
    frame.clear_depth = static_cast<double>(codes.back()) / kCodes;
    long held = codes.back();
    codes.pop_back();
    int winner = kBackground;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const DepthFunc func = kFuncs[random() % 8];
      const double z = static_cast<double>(codes[i]) / kCodes;
      hits.push_back(hit(static_cast<std::uint32_t>(i), z, z, func));
      if (!passes(func, codes[i], held)) continue;
      winner = static_cast<int>(i);
      held = codes[i];
    }
    ASSERT_EQ(winners(hits, frame), (Ids{winner})) << "round " << round;
  }
}

// Depths far apart, coverage open: every set of fragments leaves one winner and one stencil value, and the answers are
// exactly those.
TEST(FoldHits, StencilValuesGoWithTheWinnersAndTellPathsApart) {
  std::mt19937 random(7);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  FrameFormat frame;
  frame.stencil = StencilFormat::s8;
  for (int round = 0; round < 2000; ++round) {
    frame.clear_stencil = static_cast<std::uint8_t>(below(3));
    std::array<StencilFace, 4> faces;
    std::vector<Hit> hits;
    for (std::uint32_t i = 0; i < 4; ++i) {
      StencilFace& face = faces[i];
      face.func = kFuncs[static_cast<std::size_t>(below(8))];
      face.reference = static_cast<std::uint8_t>(below(3));
      face.fail = static_cast<StencilOp>(below(8));
      face.depth_fail = static_cast<StencilOp>(below(8));
      face.pass = static_cast<StencilOp>(below(8));
      const double z = 0.1 + 0.2 * below(4) + 0.01 * i;
      Hit h = hit(i, z, z);
      if (below(3) != 0) h.stencil = &face;
      hits.push_back(below(2) == 0 ? h : maybe(h));
    }
    std::set<std::pair<int, int>> expected, is;
    for (unsigned set = 0; set < 16; ++set) {
      double held = frame.clear_depth;
      std::pair<int, int> end{kBackground, frame.clear_stencil};
      bool possible = true;
      for (unsigned i = 0; i < 4; ++i) {
        const bool there = (set >> i & 1u) != 0;
        possible = possible && (there || !hits[i].certain);
        if (!there) continue;
        const bool nearer = hits[i].z_lo < held;
        const auto stencil = static_cast<std::uint8_t>(end.second);
        const bool passed = hits[i].stencil == nullptr || stencil_passes(*hits[i].stencil, stencil);
        if (hits[i].stencil != nullptr) end.second = stencil_after(*hits[i].stencil, nearer, stencil);
        if (!passed || !nearer) continue;
        end.first = static_cast<int>(i);
        held = hits[i].z_lo;
      }
      if (possible) expected.insert(end);
    }
    for (const LegalAnswer& a : answers(hits, frame)) is.insert({a.primitive, a.stencil});
    ASSERT_TRUE(std::ranges::includes(is, expected)) << "round " << round;
    const bool all_certain = std::ranges::all_of(hits, [](const Hit& h) { return h.certain; });
    if (all_certain) {
      ASSERT_EQ(is, expected) << "round " << round;
    }
  }
}

TEST(FoldHits, WhatTheAlphaTestDropsIsNotThereAndWhatItMayDropMayBe) {
  Hit h = hit(3, 0.4, 0.4);
  h.alpha_fails = true;
  EXPECT_EQ(winners({h}), (Ids{kBackground, 3}));
  h.alpha_passes = false;
  EXPECT_EQ(winners({h}), (Ids{kBackground}));
}

}  // namespace
}  // namespace plumbline
