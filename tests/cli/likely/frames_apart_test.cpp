// Pixels in which frames differ: each look, thresholds, NaN, and what is legal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "cli/likely/frames_apart.h"

namespace plumbline::cli {
namespace {

using testing::ElementsAre;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kCode = 1.0f / 255;
constexpr double kStep = 1.0 / 65535;
const FrameFormat kFrame = {.depth = DepthFormat::z16};  // cleared to 1

// A frame of one pixel.
GivenFrame pixel(const glm::vec4& color, double depth) {
  GivenFrame out;
  out.color = {1, 1, color};
  out.depth = {1, 1, depth};
  return out;
}
GivenFrame grey(double depth = 0.5) { return pixel({0.5f, 0.5f, 0.5f, 0.5f}, depth); }

Apart apart(const GivenFrame& given, const GivenFrame& frame) { return FramesApart(kFrame, given, grey()).from(frame); }

// By alpha, too; coarse; by colour, by depth; finely by colour, by depth.
TEST(FramesApart, CountsByEachLook) {
  EXPECT_THAT(apart(grey(), grey()), ElementsAre(0, 0, 0, 0, 0, 0, 0));
  const auto shifted = [](float codes, float alpha_codes, double steps) {
    return pixel({0.5f, 0.5f + codes * kCode, 0.5f, 0.5f + alpha_codes * kCode}, 0.5 + steps * kStep);
  };
  EXPECT_THAT(apart(grey(), shifted(1.6f, 0, 0)), ElementsAre(1, 1, 1, 1, 0, 1, 0));
  EXPECT_THAT(apart(grey(), shifted(1.4f, 0, 0)), ElementsAre(0, 0, 0, 0, 0, 1, 0));
  EXPECT_THAT(apart(grey(), shifted(0.4f, 0, 0)), ElementsAre(0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(apart(grey(), shifted(0, 1.6f, 0)), ElementsAre(1, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(apart(grey(), shifted(0, 0, 1.6)), ElementsAre(1, 1, 0, 0, 1, 0, 1));
  EXPECT_THAT(apart(grey(), shifted(0, 0, 1.4)), ElementsAre(0, 0, 0, 0, 0, 0, 1));
  EXPECT_THAT(apart(grey(), shifted(0, 0, 0.2)), ElementsAre(0, 0, 0, 0, 0, 0, 0));
}

// Two codes from ours, and one from a frame that lies between both.
TEST(FramesApart, CountsFramesThatAreHalfAsFarAsOurs) {
  const auto brighter = [](float codes) { return pixel({0.5f, 0.5f + codes * kCode, 0.5f, 0.5f}, 0.5); };
  EXPECT_THAT(apart(brighter(2), brighter(1)), ElementsAre(1, 1, 1, 1, 0, 1, 0));
  EXPECT_THAT(apart(brighter(2), brighter(1.1f)), ElementsAre(0, 0, 0, 0, 0, 1, 0));
  EXPECT_THAT(apart(brighter(4), brighter(2.6f)), ElementsAre(0, 0, 0, 0, 0, 1, 0));
  EXPECT_THAT(apart(brighter(40), brighter(31)), ElementsAre(1, 1, 1, 0, 0, 1, 0)) << "four times as near";
  EXPECT_THAT(apart(brighter(40), brighter(29)), ElementsAre(1, 1, 1, 1, 0, 1, 0));
}

TEST(FramesApart, CountsNoNumbersWhereALookSeesThem) {
  const GivenFrame no_red = pixel({kNaN, 0.5f, 0.5f, 0.5f}, 0.5), no_alpha = pixel({0.5f, 0.5f, 0.5f, kNaN}, 0.5),
                   no_depth = grey(kNaN);
  EXPECT_THAT(apart(no_red, grey()), ElementsAre(1, 1, 1, 1, 0, 1, 0));
  EXPECT_THAT(apart(no_alpha, grey()), ElementsAre(1, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(apart(no_depth, grey()), ElementsAre(1, 1, 0, 0, 1, 0, 1));
  EXPECT_THAT(apart(grey(), no_depth), ElementsAre(1, 1, 0, 0, 1, 0, 1));
  EXPECT_THAT(apart(no_red, no_red), ElementsAre(1, 1, 1, 1, 0, 1, 0)) << "of both, too";
}

TEST(FramesApart, SeesNoDepthsWhereOneFrameHasNone) {
  GivenFrame without = grey();
  without.depth = {};
  EXPECT_THAT(apart(without, grey(0.9)), ElementsAre(0, 0, 0, 0, 0, 0, 0));
}

// A legal pixel that is ours to a look, and no other frame's, is counted; one that differs from ours contradicts
// others.
TEST(FramesApart, PassesOverLegalPixelsThatDifferFromOurs) {
  const GivenFrame ours = grey(), white = pixel({1, 1, 1, 0.5f}, 0.5);
  GivenFrame given = pixel({0.2f, 0.2f, 0.2f, 0.5f}, 0.5);
  EXPECT_THAT(FramesApart(kFrame, given, ours).from(white), ElementsAre(1, 1, 1, 1, 0, 1, 0));
  given.is_legal = given.is_legal_color = {1, 1, std::uint8_t{1}};
  const FramesApart legal(kFrame, given, ours);
  EXPECT_THAT(legal.from(white), ElementsAre(0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(legal.legal(white).against, ElementsAre(1, 1, 1, 1, 0, 1, 0));
  EXPECT_THAT(legal.legal(white).drawn, ElementsAre(0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(legal.legal(ours).against, ElementsAre(0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(legal.legal(ours).drawn, ElementsAre(0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(legal.legal(given).drawn, ElementsAre(1, 1, 1, 1, 0, 1, 0));
}

// Neither for a frame nor against it.
TEST(FramesApart, LeavesOutPixelsThatAreWrongInOurs) {
  GivenFrame given = pixel({1, 0, 0, 1}, 0.25);
  const FramesApart::Legal none = FramesApart(kFrame, given, grey()).legal(grey(0.75));
  given.is_wrong_in_ours = {1, 1, 1};
  EXPECT_THAT(apart(given, grey()), ElementsAre(0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(FramesApart(kFrame, given, grey()).legal(grey(0.75)).against, none.against);
  given.is_wrong_in_ours = {1, 1, 0};
  EXPECT_THAT(apart(given, grey()), ElementsAre(1, 1, 1, 1, 1, 1, 1));
}

// A legal depth that differs from ours: the pixel counts by its colour, but for a frame that moves the depth elsewhere.
TEST(FramesApart, CountsPixelsOfLegalDepthsByTheirColor) {
  const GivenFrame ours = grey();
  GivenFrame given = pixel({1, 1, 1, 0.5f}, 0.5 + 3 * kStep);
  const auto apart_from = [&](const GivenFrame& frame) { return FramesApart(kFrame, given, ours).from(frame); };
  const GivenFrame white = pixel({1, 1, 1, 0.5f}, 0.5), far_white = pixel({1, 1, 1, 0.5f}, 0.9);
  EXPECT_THAT(apart_from(white), ElementsAre(1, 1, 0, 0, 1, 0, 1)) << "the depth is not known to be legal";
  given.is_legal_depth = {1, 1, std::uint8_t{1}};
  EXPECT_THAT(apart_from(white), ElementsAre(0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(apart_from(grey()), ElementsAre(1, 1, 1, 1, 0, 1, 0));
  EXPECT_THAT(apart_from(far_white), ElementsAre(1, 1, 0, 0, 1, 0, 1));
  given.depth = {1, 1, 0.9};
  EXPECT_THAT(apart_from(far_white), ElementsAre(0, 0, 0, 0, 0, 0, 0)) << "there, the depth is";
  given.depth = {1, 1, 1.0};
  EXPECT_THAT(apart_from(far_white), ElementsAre(1, 1, 0, 0, 1, 0, 1)) << "stage depth judges no cleared depth";
}

}  // namespace
}  // namespace plumbline::cli
