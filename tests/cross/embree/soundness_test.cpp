// No legal float renderer's winner, depth, colour or overdraw count falls outside the oracle's legal answers.
#include <gtest/gtest.h>

#include "reference/oracle/oracle.h"
#include "tests/cross/embree/float_renderer.h"
#include "tests/cross/embree_scenes.h"
#include "tests/extent.h"

namespace plumbline {
namespace {

using test::FloatRenderer;
using test::Habits;

constexpr std::array<Habits, 5> kHabits = {Habits{}, Habits{.by_eye = true, .snapped_planes = true},
                                           Habits{.in_double = true, .reversed_clip = true}, Habits{.jitter = 3},
                                           Habits{.by_eye = true, .reversed_clip = true, .jitter = 3}};

struct Outside {
  int winners = 0, depths = 0, colors = 0, counts = 0;
  long pixels = 0, covered = 0, ambiguous = 0;
  std::string first;
};

void judge(const Scene& scene, const Legal& legal, const Habits& habits, Outside& out) {
  const FloatRenderer drawn(scene, habits);
  for (int y = 0; y < scene.frame.height; ++y) {
    for (int x = 0; x < scene.frame.width; ++x) {
      const auto answers = legal.at(x, y);
      ++out.pixels;
      out.covered += drawn.count(x, y) > 0 ? 1 : 0;
      out.ambiguous += answers.size() > 1 ? 1 : 0;
      const std::uint32_t count = drawn.count(x, y);
      const bool count_legal = count >= legal.certain(x, y) && count <= legal.possible(x, y);
      out.counts += count_legal ? 0 : 1;
      const std::int32_t id = drawn.id(x, y);
      const auto found = std::find_if(answers.begin(), answers.end(), [&](const auto& a) { return a.primitive == id; });
      bool depth_legal = true, color_legal = true;
      if (found == answers.end()) {
        ++out.winners;
      } else {
        const double z = drawn.depth(x, y), step = depth_step(scene.frame.depth, z);
        depth_legal = z >= found->z_lo - step && z <= found->z_hi + step;
        const glm::dvec4 off = glm::abs(drawn.color(x, y) - glm::dvec4(found->color));
        // Colours through snapped positions are another renderer's than the bound is for.
        const bool any_color = habits.snapped_planes;
        color_legal = any_color || std::max({off.r, off.g, off.b, off.a}) <= static_cast<double>(found->color_bound);
        out.depths += depth_legal ? 0 : 1;
        out.colors += color_legal ? 0 : 1;
      }
      if (out.first.empty() && !(count_legal && depth_legal && color_legal && found != answers.end())) {
        out.first = scene.name + ": pixel " + std::to_string(x) + ", " + std::to_string(y) + ", winner " +
                    std::to_string(id) + ", count " + std::to_string(count) + " of [" +
                    std::to_string(legal.certain(x, y)) + ", " + std::to_string(legal.possible(x, y)) + "], legal:";
        for (const LegalAnswer& a : answers) out.first += " " + std::to_string(a.primitive);
      }
    }
  }
}

class Soundness : public ::testing::TestWithParam<int> {};

TEST_P(Soundness, NoFloatRendererIsOutsideTheLegalAnswers) {
  Outside out;
  for (unsigned seed = 1; seed <= 25 / one_of(8); ++seed) {
    const Scene scene = test::small_scene(GetParam(), seed);
    const Legal legal = math::legal_by_boxes(scene, Request{});
    for (const Habits& habits : kHabits) judge(scene, legal, habits, out);
  }
  EXPECT_GT(out.covered, out.pixels / 100);  // else the scenes show nothing
  EXPECT_EQ(out.winners, 0) << out.first;
  EXPECT_EQ(out.depths, 0) << out.first;
  EXPECT_EQ(out.colors, 0) << out.first;
  EXPECT_EQ(out.counts, 0) << out.first;
  RecordProperty("pixels", static_cast<int>(out.pixels));
  std::printf("kind %d: %ld pixels, %ld covered, %.3f %% ambiguous\n", GetParam(), out.pixels, out.covered,
              100.0 * static_cast<double>(out.ambiguous) / static_cast<double>(out.pixels));
}
// These renderers snap to the nearest 1/256 pixel, and left and lower edges own their samples: by another rule, or a
// coarser grid, some answers of theirs are illegal.
TEST_P(Soundness, NorByTheTieRuleThatTheyDeclare) {
  using enum Conventions::TieRule;
  Outside own, other, coarser;
  std::size_t open = 0;
  for (unsigned seed = 1; seed <= 1 + 10 / one_of(8); ++seed) {
    const Scene scene = test::small_scene(GetParam(), seed);
    const auto declared = [&](Conventions::TieRule rule, int bits) {
      Request request;
      request.conventions.tie_rule = rule;
      request.conventions.subpixel_bits = bits;
      return math::legal_by_boxes(scene, request);
    };
    const Legal by_own = declared(left_bottom, 8);
    for (std::size_t i = 0; i < by_own.certain.size(); ++i)
      open += by_own.certain.values()[i] != by_own.possible.values()[i] ? 1 : 0;
    for (const Habits& habits : kHabits) judge(scene, by_own, habits, own);
    judge(scene, declared(right_top, 8), kHabits[0], other);
    judge(scene, declared(left_bottom, 4), kHabits[0], coarser);
  }
  EXPECT_EQ(own.winners, 0) << own.first;
  EXPECT_EQ(own.depths, 0) << own.first;
  EXPECT_EQ(own.colors, 0) << own.first;
  EXPECT_EQ(own.counts, 0) << own.first;
  constexpr int kSoup = 0, kOnTheGrid = 7;
  EXPECT_TRUE(GetParam() != kOnTheGrid || other.counts > 0);
  EXPECT_TRUE(GetParam() != kSoup || coarser.counts > 0);
  std::printf("kind %d: %zu of %ld pixels open; illegal by another rule %d, by a coarser grid %d\n", GetParam(), open,
              own.pixels, other.counts, coarser.counts);
}

// Depths and colours in float are legal where that arithmetic is declared, and not all are where none is.
TEST_P(Soundness, NorByTheArithmeticThatTheyDeclare) {
  using enum Conventions::DepthArithmetic;
  using test::FloatDepth;
  Outside declared, undeclared;
  for (unsigned seed = 1; seed <= 1 + 8 / one_of(8); ++seed) {
    const Scene scene = test::small_scene(GetParam(), seed);
    for (const auto& [way, arithmetic] :
         {std::pair(FloatDepth::edge_functions, in_float), std::pair(FloatDepth::plane, in_float),
          std::pair(FloatDepth::edge_equations, in_float_from_origin)}) {
      Request request;
      request.conventions.depth_arithmetic = arithmetic;
      judge(scene, math::legal_by_boxes(scene, request), {.depth = way}, declared);
      judge(scene, math::legal_by_boxes(scene, Request{}), {.depth = way}, undeclared);
    }
  }
  EXPECT_EQ(declared.winners, 0) << declared.first;
  EXPECT_EQ(declared.depths, 0) << declared.first;
  EXPECT_EQ(declared.colors, 0) << declared.first;
  std::printf("kind %d: %ld pixels, %.3f %% ambiguous; illegal undeclared: %d winners, %d depths, %d colours\n",
              GetParam(), declared.pixels,
              100.0 * static_cast<double>(declared.ambiguous) / static_cast<double>(declared.pixels),
              undeclared.winners, undeclared.depths, undeclared.colors);
  constexpr int kSlivers = 5;
  EXPECT_TRUE(GetParam() != kSlivers || (undeclared.depths > 0 && undeclared.colors > 0));
}
INSTANTIATE_TEST_SUITE_P(Kinds, Soundness, ::testing::Range(0, test::kSceneKinds));

}  // namespace
}  // namespace plumbline
