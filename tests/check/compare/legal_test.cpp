// Comparators against an oracle's legal answers.
#include <functional>

#include "check/compare/compare_planes.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// A frame of 5 x 3 pixels of background, but for one where primitives 2 and 6 are legal and between one and three
// fragments lie.
struct LegalAnswers : testing::Test {
  static constexpr int kWidth = 5, kHeight = 3, kX = 3, kY = 1;
  LegalAnswers() {
    scene.frame.width = kWidth;
    scene.frame.height = kHeight;
    planes.count = Plane<std::uint32_t>(kWidth, kHeight);
    planes.id = Plane<std::int32_t>(kWidth, kHeight, kBackground);
    planes.shaded = planes.color = Plane<glm::vec4>(kWidth, kHeight, glm::vec4(0, 0, 0, 1));
    planes.depth = Plane<double>(kWidth, kHeight, 1);
    legal.certain = legal.possible = Plane<std::uint32_t>(kWidth, kHeight);
    legal.certain(kX, kY) = 1;
    legal.possible(kX, kY) = 3;
    legal.first = {0};
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (x == kX && y == kY) {
          legal.answers.push_back({2, 0x1p-10f, 0.25, 0.3125, {0.5, 0.25, 0.125, 1}});
          legal.answers.push_back({6, 0x1p-12f, 0.75, 0.75, {1.5, 0.5, -0.5, 1}});
        } else {
          legal.answers.push_back({kBackground, 0, 1, 1, {0, 0, 0, 1}});
        }
        legal.first.push_back(static_cast<std::uint32_t>(legal.answers.size()));
      }
    }
    show(2, 0.25, {0.5, 0.25, 0.125, 1});
  }
  void show(std::int32_t id, double z, glm::vec4 color) {
    planes.count(kX, kY) = 2;
    planes.id(kX, kY) = id;
    planes.depth(kX, kY) = z;
    planes.shaded(kX, kY) = color;
    planes.color(kX, kY) = stored(color);
  }
  // Nearest codes, in a frame of codes.
  glm::vec4 stored(const glm::vec4& color) const {
    const auto scale = static_cast<float>(color_scale(scene.frame.color));
    return scale > 0 ? glm::round(color * scale) / scale : color;
  }
  Measurement count() const { return compare_legal_count(planes, legal); }
  Measurement winner() const { return compare_legal_winner(planes, legal); }
  Measurement depth() const { return compare_legal_depth(scene, planes, legal, 1); }
  Measurement shaded() const { return compare_legal_shaded(scene, planes, legal, 1); }
  Measurement merge() const { return compare_legal_merge(scene, planes, legal, 1); }
  std::vector<Measurement> all() const { return {count(), winner(), depth(), shaded(), merge()}; }
  // No answer at all at the open pixel.
  void forbid() {
    legal.answers.erase(legal.answers.begin() + 8, legal.answers.begin() + 10);
    for (std::size_t i = 9; i < legal.first.size(); ++i) legal.first[i] -= 2;
    ASSERT_TRUE(legal.at(kX, kY).empty());
  }
  Scene scene;
  Planes planes;
  Legal legal;
};

TEST_F(LegalAnswers, LegalOnesPassAndAreCountedAsAmbiguous) {
  scene.frame.color = ColorFormat::rgba32f, show(2, 0.25, {0.5, 0.25, 0.125, 1});
  for (const Measurement& m : all()) {
    EXPECT_TRUE(passes(m)) << m.unit;
    EXPECT_EQ(m.ambiguous, 1u) << m.unit;
    EXPECT_EQ(m.items, 15u) << m.unit;
    EXPECT_EQ(m.max_difference, 0) << m.unit;
  }
}

TEST_F(LegalAnswers, OtherSizesFail) {
  const Planes whole = planes;
  planes.count = Plane<std::uint32_t>(kHeight, kWidth);
  planes.id = Plane<std::int32_t>(kHeight, kWidth, kBackground);
  planes.shaded = planes.color = Plane<glm::vec4>(kHeight, kWidth, glm::vec4(0, 0, 0, 1));
  planes.depth = Plane<double>(kHeight, kWidth, 1);
  for (const Measurement& m : all()) {
    EXPECT_TRUE(fails(m, 15));
    EXPECT_NE(m.mismatch, "");
  }
  planes = {};
  for (const Measurement& m : all()) EXPECT_FALSE(passes(m));
  planes = whole;
  legal = {};
  for (const Measurement& m : all()) EXPECT_FALSE(passes(m)) << "an oracle that says nothing";
}

// Bounds of colours that overflow float may be finite, and larger than all that codes hold.
TEST_F(LegalAnswers, AnyColourOfCodesIsAmbiguousUnderABoundOfAll) {
  forbid();
  legal.answers.insert(legal.answers.begin() + 8, {2, 5, 0.25, 0.3125, {0.5, 0.25, 0.125, 1}});
  for (std::size_t i = 9; i < legal.first.size(); ++i) ++legal.first[i];
  show(2, 0.25, {1, 0, 1, 1});
  EXPECT_TRUE(passes(merge()));
  EXPECT_EQ(merge().ambiguous, 1u);
  scene.frame.color = ColorFormat::rgba32f;
  EXPECT_EQ(merge().ambiguous, 0u) << "a float may be farther off";
}

TEST_F(LegalAnswers, ADepthIsACodeWhereCodesAreDeclared) {
  scene.frame.depth = DepthFormat::z16;
  show(2, 16384 / 65535.0, planes.color(kX, kY));
  const auto declared = [&] { return compare_legal_depth(scene, planes, legal, 1, {.has_codes = true}); };
  EXPECT_TRUE(passes(declared()));
  planes.depth(kX, kY) = 16384.3 / 65535;
  EXPECT_TRUE(passes(depth()));
  EXPECT_TRUE(fails(declared())) << "of 24 bits";
  planes.depth(kX, kY) = NAN;
  EXPECT_TRUE(fails(declared()));
}

// 0.5 of a code lies between two.
TEST_F(LegalAnswers, ADepthIsRoundedAsIsDeclared) {
  using enum Conventions::Rounding;
  scene.frame.depth = DepthFormat::z16;
  show(2, 16384 / 65535.0, planes.color(kX, kY));
  const double step = 1 / 65535.0, low = legal.at(kX, kY)[0].z_lo, high = legal.at(kX, kY)[0].z_hi;
  const auto holds = [&](double z, Conventions::Rounding rounding) {
    planes.depth(kX, kY) = z;
    return passes(compare_legal_depth(scene, planes, legal, 0.501, {.rounding = rounding}));
  };
  EXPECT_TRUE(holds(low - 0.4 * step, nearest) && holds(high + 0.4 * step, nearest));
  EXPECT_FALSE(holds(low - 0.6 * step, nearest) || holds(high + 0.6 * step, nearest));
  EXPECT_TRUE(holds(low - 0.9 * step, down) && holds(high + 0.9 * step, up));
  EXPECT_FALSE(holds(low - 1.1 * step, down) || holds(high + 0.1 * step, down));
  EXPECT_FALSE(holds(low - 0.1 * step, up) || holds(high + 1.1 * step, up));
}

TEST_F(LegalAnswers, AStencilValueIsJudgedWithoutWinners) {
  planes.id = {};
  planes.stencil = {planes.color.width(), planes.color.height(), 0};
  EXPECT_TRUE(passes(winner()));
  planes.stencil(kX, kY) = 3;
  EXPECT_TRUE(fails(winner()));
  for (LegalAnswer& a : legal.answers) a.stencil = 3;
  EXPECT_EQ(winner().differing, 14u) << "all others hold 0";
}

TEST_F(LegalAnswers, WithoutWinnersAnyOfThemIsLegal) {
  planes.id = {};
  EXPECT_FALSE(passes(winner())) << "there is none";
  for (const Measurement& m : {depth(), shaded(), merge()}) EXPECT_TRUE(passes(m)) << m.unit;
  planes.depth(kX, kY) = 0.75;
  planes.shaded(kX, kY) = glm::vec4(1.5, 0.5, -0.5, 1);
  planes.color(kX, kY) = stored({1, 0.5, 0, 1});
  for (const Measurement& m : {depth(), shaded(), merge()}) EXPECT_TRUE(passes(m)) << m.unit;
  planes.depth(kX, kY) = 0.5;
  planes.shaded(kX, kY) = planes.color(kX, kY) = glm::vec4(0.5, 0.5, 0.125, 1);  // green of one, the rest of the other
  for (const Measurement& m : {depth(), shaded(), merge()}) EXPECT_TRUE(fails(m)) << m.unit;
  planes.depth(kX, kY) = NAN;
  planes.shaded(kX, kY).b = planes.color(kX, kY).b = NAN;
  for (const Measurement& m : {depth(), shaded(), merge()}) EXPECT_TRUE(fails(m)) << m.unit;
  EXPECT_EQ(depth().worst.reference, 0.25) << "the number that was expected";
  planes.depth(kX, kY) = 0.25;
  planes.color(kX, kY) = stored({1, 0.5, 0, 1});
  EXPECT_TRUE(passes(depth()));
  EXPECT_TRUE(fails(merge())) << "the depth of one, the colour of the other";
  planes.depth(kX, kY) = 0.75;
  EXPECT_TRUE(passes(merge()));
  planes.depth(0, 0) = 0.25;
  EXPECT_TRUE(passes(depth())) << "what it was cleared to is merge's matter";
  EXPECT_TRUE(fails(merge())) << "legal elsewhere";
  planes.color = {};
  EXPECT_TRUE(fails(depth())) << "nobody else's, without a colour";
}

// Counts of a renderer whose tie rule is not known.
TEST_F(LegalAnswers, OtherCountsAreAmbiguousBesideIllegalOnes) {
  planes.id_sum = Plane<std::uint64_t>(kWidth, kHeight);
  Planes other = planes;
  other.count(kX, kY) = 1;  // ours is 2: both are legal
  EXPECT_TRUE(fails(compare_coverage(planes, other)));
  EXPECT_TRUE(fails(compare_coverage(planes, other, legal))) << "nothing else differs: another tie rule";
  planes.count(0, 0) = 1;
  const Measurement m = compare_coverage(planes, other, legal);
  EXPECT_TRUE(fails(m));
  EXPECT_EQ(m.worst.place.x, 0);
  EXPECT_EQ(m.ambiguous, 1u);
  planes.count(kX, kY) = 4;
  EXPECT_TRUE(fails(compare_coverage(planes, other, legal), 2)) << "more than are legal";
}

TEST_F(LegalAnswers, CountsLieBetweenCertainAndPossible) {
  for (const auto& [n, outside] : {std::pair(0u, 1.0), std::pair(1u, 0.0), std::pair(3u, 0.0), std::pair(4u, 1.0),
                                   std::pair(UINT32_MAX, 4294967292.0)}) {
    planes.count(kX, kY) = n;
    EXPECT_EQ(passes(count()), outside == 0) << n;
    EXPECT_EQ(count().max_difference, outside);
    if (outside > 0) {
      EXPECT_TRUE(fails(count()));
      EXPECT_EQ(count().worst.place.x, kX);
      EXPECT_EQ(count().worst.place.y, kY);
      EXPECT_EQ(count().worst.reference, n == 0 ? 1 : 3) << "the nearer end";
    }
  }
  planes.count(kX, kY) = 1;
  planes.count(1, 2) = 1;
  EXPECT_TRUE(fails(count())) << "nothing may be there";
  EXPECT_EQ(count().ambiguous, 1u);
}

TEST_F(LegalAnswers, TheWinnerIsOneOfThem) {
  for (std::int32_t id : {kBackground, 0, 1, 3, 5, 7, INT32_MAX, INT32_MIN}) {
    planes.id(kX, kY) = id;
    EXPECT_TRUE(fails(winner())) << id;
    EXPECT_EQ(winner().max_difference, 1);
    EXPECT_EQ(winner().worst.place.x, kX);
    EXPECT_EQ(winner().worst.place.y, kY);
    EXPECT_EQ(winner().worst.candidate, id);
    EXPECT_EQ(winner().worst.reference, 2);
  }
  planes.id(kX, kY) = 6;
  EXPECT_TRUE(passes(winner()));
  planes.id(0, 0) = 2;
  EXPECT_TRUE(fails(winner())) << "legal elsewhere";
}

TEST_F(LegalAnswers, WhereNothingIsLegalTheWinnerFails) {
  forbid();
  EXPECT_TRUE(fails(winner()));
  EXPECT_EQ(winner().worst.place.x, kX);
  EXPECT_EQ(winner().ambiguous, 0u);
  for (const Measurement& m : {depth(), shaded(), merge()}) EXPECT_TRUE(passes(m)) << "visibility's matter";
}

TEST_F(LegalAnswers, DepthLiesInTheWinnersIntervalOrAStepFromIt) {
  for (DepthFormat format : {DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f}) {
    scene.frame.depth = format;
    const double step = depth_step(format, 0.25);
    for (const auto& [z, holds] : {std::pair(0.25, true), std::pair(0.28, true), std::pair(0.3125, true),
                                   std::pair(0.25 - 0.99 * step, true), std::pair(0.3125 + 0.99 * step, true),
                                   std::pair(0.25 - 1.01 * step, false), std::pair(0.3125 + 1.01 * step, false),
                                   std::pair(0.75, false), std::pair(1.0, false), std::pair(0.0, false)}) {
      planes.depth(kX, kY) = z;
      EXPECT_EQ(passes(depth()), holds) << z;
      if (!holds) {
        EXPECT_TRUE(fails(depth()));
      }
    }
    EXPECT_EQ(depth().worst.place.x, kX);
    EXPECT_EQ(depth().worst.place.y, kY);
    EXPECT_EQ(depth().worst.reference, 0.25) << "the nearer end";
    EXPECT_NEAR(depth().max_difference, 0.25 / depth_step(format, 0), 1e-6) << "in steps";
    planes.depth(kX, kY) = 0.25;
  }
}

TEST_F(LegalAnswers, OfTheOtherWinnerTheOtherDepth) {
  show(6, 0.75, {1.5, 0.5, -0.5, 1});
  EXPECT_TRUE(passes(depth()));
  EXPECT_TRUE(passes(shaded()));
  planes.depth(kX, kY) = 0.25;
  EXPECT_TRUE(fails(depth()));
  planes.shaded(kX, kY) = glm::vec4(0.5, 0.25, 0.125, 1);
  EXPECT_TRUE(fails(shaded())) << "the colour of 2 under the name of 6";
}

TEST_F(LegalAnswers, AWinnerThatIsNotLegalIsVisibilitysMatterAlone) {
  show(4, 0.5, {1, 1, 1, 1});
  EXPECT_TRUE(fails(winner()));
  EXPECT_TRUE(passes(depth()));
  EXPECT_TRUE(passes(shaded()));
  EXPECT_TRUE(passes(merge()));
}

TEST_F(LegalAnswers, ColourAtTheBoundPassesBeyondItFails) {
  for (int c = 0; c < 4; ++c) {
    for (float sign : {-1.0f, 1.0f}) {
      show(2, 0.25, {0.5, 0.25, 0.125, 1});
      planes.shaded(kX, kY)[c] += sign * 0x1p-10f;
      EXPECT_TRUE(passes(shaded())) << c;
      EXPECT_EQ(shaded().max_ratio, 1) << "exactly met";
      const float farther = sign > 0 ? 10.0f : -10.0f;
      planes.shaded(kX, kY)[c] = std::nextafter(planes.shaded(kX, kY)[c], farther);
      EXPECT_TRUE(fails(shaded())) << c;
      EXPECT_EQ(shaded().worst.place.x, kX);
      EXPECT_EQ(shaded().worst.place.y, kY);
    }
  }
}

TEST_F(LegalAnswers, TheBackgroundHasNoBound) {
  planes.shaded(0, 2).b = planes.color(0, 2).b = std::numeric_limits<float>::denorm_min();
  EXPECT_TRUE(passes(shaded())) << "no fragment has a colour there";
  const Plane<glm::vec4> color = std::exchange(planes.color, {});
  EXPECT_TRUE(passes(shaded())) << "nor without planes.color";
  planes.color = color;
  planes.shaded(0, 2).b = NAN;
  EXPECT_TRUE(fails(shaded()));
  planes.shaded(0, 2).b = 0;
  scene.frame.color = ColorFormat::rgba32f, show(2, 0.25, {0.5, 0.25, 0.125, 1});
  EXPECT_TRUE(fails(merge()));
  planes.color(0, 2).b = 0;
  EXPECT_TRUE(passes(merge()));
  planes.depth(0, 2) = 1 - 1.01 * depth_step(scene.frame.depth, 1);
  EXPECT_TRUE(fails(merge()));
  EXPECT_TRUE(passes(depth()));
  planes.depth(0, 2) = 1 - 0.99 * depth_step(scene.frame.depth, 1);
  EXPECT_TRUE(passes(merge()));
  planes.depth(0, 2) = NAN;
  EXPECT_TRUE(fails(merge()));
}

TEST_F(LegalAnswers, CodesMayBeHalfACodeFarther) {
  const double bound = 0x1p-10 * 255;  // in codes
  for (const auto& [codes, holds] : {std::pair(bound + 0.499, true), std::pair(bound + 0.501, false)}) {
    legal.answers[8].color[0] = static_cast<float>((128 - codes) / 255);
    EXPECT_EQ(passes(merge()), holds) << codes;
  }
  legal.answers[8].color[0] = 0.5;
  scene.frame.color = ColorFormat::rgba32f;
  show(2, 0.25, {0.5f + 0x1.1p-10f, 0.25, 0.125, 1});
  EXPECT_TRUE(fails(merge())) << "floats are not rounded";
}

// A renderer that truncates: the code below the colour, and no other.
TEST_F(LegalAnswers, CodesMayBeRoundedDownWhereThatIsDeclared) {
  Conventions down;
  down.color_rounding = Conventions::Rounding::down;
  for (const auto& [code, holds] : {std::pair(127.0, true), std::pair(128.0, false), std::pair(126.0, false)}) {
    show(2, 0.25, {static_cast<float>(code / 255), 63.0f / 255, 31.0f / 255, 1});
    EXPECT_EQ(passes(compare_legal_merge(scene, planes, legal, 1, down)), holds) << code;
  }
  show(2, 0.25, {127.0f / 255, 63.0f / 255, 31.0f / 255, 1});
  EXPECT_TRUE(fails(merge())) << "63.75 and 31.875 are nearer to the codes above";
  planes.color(0, 0).r = 1.0f / 255;
  EXPECT_TRUE(fails(compare_legal_merge(scene, planes, legal, 1, down))) << "the clear colour's code above";
}

TEST_F(LegalAnswers, CodesMayStandForSrgbWhereThatIsDeclared) {
  Conventions srgb;
  srgb.color_encoding = Conventions::Encoding::srgb;
  const auto encoded = [](double v) { return 255 * (1.055 * std::pow(v, 1 / 2.4) - 0.055); };
  const auto as_code = [](double code) { return static_cast<float>(std::round(code) / 255); };
  const glm::vec4 right(as_code(encoded(0.5)), as_code(encoded(0.25)), as_code(encoded(0.125)), 1);
  show(2, 0.25, right);
  EXPECT_TRUE(passes(compare_legal_merge(scene, planes, legal, 1, srgb)));
  EXPECT_TRUE(fails(merge()));
  show(2, 0.25, right + glm::vec4(2.0f / 255, 0, 0, 0));
  EXPECT_TRUE(fails(compare_legal_merge(scene, planes, legal, 1, srgb)));
  show(2, 0.25, {NAN, right.g, right.b, 1});
  EXPECT_TRUE(fails(compare_legal_merge(scene, planes, legal, 1, srgb)));
}

TEST_F(LegalAnswers, CodesAreClampedFloatsAreNot) {
  show(6, 0.75, {1, 0.5, 0, 1});
  EXPECT_TRUE(passes(merge()));
  EXPECT_TRUE(passes(shaded())) << "a renderer may clamp before it rounds to codes";
  show(6, 0.75, {1.25, 0.5, -0.5, 1});
  EXPECT_TRUE(fails(shaded())) << "neither clamped nor not";
  show(6, 0.75, {1, 0.5, 0, 1});
  scene.frame.color = ColorFormat::rgba32f;
  EXPECT_TRUE(fails(shaded()));
  EXPECT_TRUE(fails(merge()));
  show(6, 0.75, {1.5, 0.5, -0.5, 1});
  EXPECT_TRUE(passes(merge()));
  for (const ColorFormat codes : {ColorFormat::rgba8, ColorFormat::rgba12}) {
    scene.frame.color = codes;
    EXPECT_TRUE(fails(merge()));
  }
  // Rounded to 8 bits: in a frame of 12 as far as half of one in 255 off.
  for (const ColorFormat codes : {ColorFormat::rgba8, ColorFormat::rgba12}) {
    scene.frame.color = codes;
    show(6, 0.75, {1, 128.0f / 255, 0, 1});
    EXPECT_EQ(passes(merge()), codes == ColorFormat::rgba8);
  }
}

// A frame of codes that holds numbers between them was never rounded.
TEST_F(LegalAnswers, ColoursOfAFrameOfCodesAreCodes) {
  for (const bool by_ranges : {false, true}) {
    if (by_ranges) legal.color_lo = legal.color_hi = planes.color;
    EXPECT_TRUE(passes(merge()));
    planes.color(kX, kY).g += 0.1f / 255;
    EXPECT_TRUE(fails(merge()));
    planes.color(kX, kY).g = 64.0f * 0.00392157f;  // a literal for 1/255
  }
}

TEST_F(LegalAnswers, WhatIsNoNumberFails) {
  for (double bad : not_numbers()) {
    for (std::int32_t id : {2, 4}) {  // a legal winner, and one that is not
      for (int c = 0; c < 4; ++c) {
        show(id, bad, {0.5, 0.25, 0.125, 1});
        planes.shaded(kX, kY)[c] = planes.color(kX, kY)[c] = static_cast<float>(bad);
        for (const Measurement& m : {depth(), shaded(), merge()}) EXPECT_TRUE(fails(m)) << m.unit << " " << id;
        EXPECT_EQ(depth().max_difference, kInf);
      }
    }
  }
}

}  // namespace
}  // namespace plumbline::check
