// The frame's clear colour, which a renderer may round and encode otherwise than its fragments' colours.
#include <optional>

#include "tests/check/compare/planes.h"

namespace plumbline::check {
namespace {

// A frame cleared to 100.6 codes of red, as exact has it; a renderer's pixels at the code.
struct ClearedFrame : PlanePairs {
  Measurement merged(glm::ivec2 pixel, int red, const Conventions& conventions) const {
    Capture mine = capture, exacts = capture;
    if (pixel == kCleared) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          if (mine.planes.id.empty() ? glm::ivec2(x, y) != pixel : mine.planes.id(x, y) != kBackground) continue;
          exacts.planes.color(x, y).r = 100.6f / 255, mine.planes.color(x, y).r = code(red);
        }
      }
    }
    exacts.planes.color(pixel.x, pixel.y).r = 100.6f / 255;
    mine.planes.color(pixel.x, pixel.y).r = code(red);
    if (other_at) mine.planes.color(6, 3).r = code(*other_at);
    return compare_merge(scene, mine.planes, exacts.planes, 1, {}, conventions);
  }
  static Conventions down() {
    Conventions out;
    out.color_rounding = Conventions::Rounding::down;
    return out;
  }
  static constexpr glm::ivec2 kCleared{0, 0}, kDrawn{3, 1};
  std::optional<int> other_at;  // red of the last pixel
};

TEST_F(ClearedFrame, ItsCodeIsTheNearestOrThatOfFragments) {
  for (const auto& [red, holds] : {std::pair(99, false), std::pair(100, true), std::pair(101, true), {102, false}})
    EXPECT_EQ(passes(merged(kCleared, red, down())), holds) << red;
  for (const auto& [red, holds] : {std::pair(100, true), std::pair(101, false)})
    EXPECT_EQ(passes(merged(kDrawn, red, down())), holds) << red;
}

TEST_F(ClearedFrame, AllPixelsAreClearedToOneColour) {
  other_at = 100;  // that of fragments
  EXPECT_TRUE(passes(merged(kCleared, 101, down())));
  other_at = 101;
  EXPECT_FALSE(passes(merged(kCleared, 100, down())));
  EXPECT_TRUE(passes(merged(kCleared, 101, down())));
}

TEST_F(ClearedFrame, OfARendererThatRoundsToTheNearestItsCodeIsTheNearest) {
  for (const auto& [red, holds] : {std::pair(100, false), std::pair(101, true), std::pair(102, false)})
    EXPECT_EQ(passes(merged(kCleared, red, {})), holds) << red;
}

TEST_F(ClearedFrame, ItMayBeLinearWhereFragmentsAreEncoded) {
  Conventions srgb;
  srgb.color_encoding = Conventions::Encoding::srgb;
  for (const glm::ivec2 p : {kDrawn, glm::ivec2(2, 2)}) capture.planes.color(p.x, p.y) = {0, 0, 0, 1};  // encoded, too
  const auto encoded = static_cast<int>(std::lround(255 * srgb_encoded(static_cast<double>(100.6f / 255))));
  for (const auto& [red, holds] : {std::pair(encoded, true), std::pair(101, true), std::pair(120, false)})
    EXPECT_EQ(passes(merged(kCleared, red, srgb)), holds) << red;
  EXPECT_FALSE(passes(merged(kDrawn, 101, srgb)));
}

TEST_F(ClearedFrame, WhereNoWinnersAreShownEachPixelMayBeAFragments) {
  capture.planes.id = {};
  EXPECT_FALSE(passes(merged(kCleared, 101, down())));
}

// A frame that asks for 12 bits, drawn in 16, as OpenGL does. Numbers between codes of 16 bits are none.
TEST_F(PlanePairs, CodesOf16BitsMayStandWhere12AreAskedFor) {
  capture.planes.id = {};
  allow(0, 0, {kBackground});
  const auto holds = [&](ColorFormat asked, float red) {
    scene.frame.color = asked;
    capture.planes.color = Plane<glm::vec4>(kWidth, kHeight, glm::vec4(red, 0, 0, 1));
    for (LegalAnswer& answer : legal.answers) answer.z_lo = answer.z_hi = 1, answer.color = {red, 0, 0, 1};
    capture.planes.depth = Plane<double>(kWidth, kHeight, 1);
    return passes(compare_legal_merge(scene, capture.planes, legal, 1));
  };
  const float of_16_bits = 1000.0f / 65535, between = 1000.5f / 65535;
  EXPECT_TRUE(holds(ColorFormat::rgba12, of_16_bits));
  EXPECT_TRUE(holds(ColorFormat::rgba16, of_16_bits));
  EXPECT_FALSE(holds(ColorFormat::rgba8, of_16_bits));
  EXPECT_FALSE(holds(ColorFormat::rgba12, between));
}

}  // namespace
}  // namespace plumbline::check
