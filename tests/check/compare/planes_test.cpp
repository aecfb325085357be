// Comparators of planes against another renderer's planes, stages 5 to 11.
#include <fmt/format.h>

#include "check/bounds/mean_bounds.h"
#include "tests/check/compare/planes.h"

namespace plumbline::check {
namespace {

TEST_F(PlanePairs, EqualOnesPass) {
  for (const Compare& compare : all()) {
    const Measurement m = run(compare, kUnchangedPlanes);
    EXPECT_TRUE(passes(m)) << m.unit;
    EXPECT_EQ(m.max_difference, 0) << m.unit;
    EXPECT_EQ(m.items, 28u) << m.unit;
    EXPECT_EQ(histogram_sum(m), m.items);
  }
}

TEST_F(PlanePairs, OtherSizesFail) {
  const PlaneChange turned = [](Planes& p) { p = planes_of(kHeight, kWidth); };
  const PlaneChange higher = [](Planes& p) { p = planes_of(kWidth, kHeight + 1); };
  const PlaneChange empty = [](Planes& p) { p = {}; };
  for (const Compare& compare : all()) {
    for (const PlaneChange& change : {turned, higher, empty}) {
      EXPECT_FALSE(passes(run(compare, change)));
      EXPECT_FALSE(passes(run(compare, kUnchangedPlanes, change)));
      EXPECT_NE(run(compare, kUnchangedPlanes, change).mismatch, "");
    }
  }
}

TEST_F(PlanePairs, OnePlaneOfAnotherSizeFails) {
  for (const auto& compare : {coverage(), merge()}) {
    const PlaneChange sum_and_depth = [](Planes& p) {
      p.id_sum = Plane<std::uint64_t>(kHeight, kWidth, 7);
      p.depth = Plane<double>(kHeight, kWidth, 1);
    };
    EXPECT_FALSE(passes(run(compare, sum_and_depth)));
    EXPECT_FALSE(passes(run(compare, kUnchangedPlanes, sum_and_depth)));
  }
  for (const auto& compare : {depth(), shaded(), codes()}) {
    const PlaneChange id = [](Planes& p) { p.id = Plane<std::int32_t>(kHeight, kWidth, kBackground); };
    EXPECT_FALSE(passes(run(compare, id)));
    EXPECT_FALSE(passes(run(compare, kUnchangedPlanes, id)));
  }
}

TEST_F(PlanePairs, WithoutThePlaneThatDecidesFailsAndDoesNotCrash) {
  const PlaneChange no_id = [](Planes& p) { p.id = {}; };
  for (const auto& compare : {winners(), depth(), shaded(), codes()}) {
    EXPECT_FALSE(passes(run(compare, no_id, no_id))) << "nothing was compared";
  }
  EXPECT_TRUE(passes(run(merge(), no_id, no_id))) << "merge needs no winners";
  const PlaneChange no_depth = [](Planes& p) { p.depth = {}; };
  EXPECT_TRUE(passes(run(merge(), no_depth))) << "nor depths, but exact's";
  EXPECT_FALSE(passes(run(merge(), kUnchangedPlanes, no_depth)));
  const PlaneChange no_sum = [](Planes& p) { p.id_sum = {}; };
  EXPECT_FALSE(passes(run(coverage(), no_sum, no_sum)));
}

TEST_F(PlanePairs, CoverageOneFragmentMoreFails) {
  const Measurement m = run(coverage(), [](Planes& p) { p.count(4, 3) += 1; });
  EXPECT_TRUE(fails(m));
  EXPECT_EQ(m.worst.place.x, 4);
  EXPECT_EQ(m.worst.place.y, 3);
  EXPECT_STREQ(m.worst.place.field, "count");
  EXPECT_TRUE(fails(run(coverage(), kUnchangedPlanes, [](Planes& p) { p.count(4, 3) += 1; })));
  EXPECT_EQ(run(
                coverage(), [](Planes& p) { p.count(0, 0) = UINT32_MAX; }, [](Planes& p) { p.count(0, 0) = 0; })
                .max_difference,
            4294967295.0);
  EXPECT_TRUE(fails(run(
      coverage(), [](Planes& p) { p.count(0, 0) = UINT32_MAX; }, [](Planes& p) { p.count(0, 0) = UINT32_MAX - 1; })));
}

TEST_F(PlanePairs, CoverageByAnotherPrimitiveFails) {
  const Measurement m = run(coverage(), [](Planes& p) { p.id_sum(6, 0) += 1; });
  EXPECT_TRUE(fails(m));
  EXPECT_EQ(m.max_difference, 1);
  EXPECT_EQ(m.worst.place.x, 6);
  EXPECT_STREQ(m.worst.place.field, "fragments of other primitives");
  EXPECT_EQ(m.worst.candidate, 1);
  EXPECT_EQ(m.worst.reference, 0);
  const std::uint64_t big = std::uint64_t{1} << 60;
  EXPECT_TRUE(fails(run(
      coverage(), [=](Planes& p) { p.id_sum(6, 0) = big; }, [=](Planes& p) { p.id_sum(6, 0) = big + 1; })))
      << "equal as doubles";
  EXPECT_NE(id_weight(1) + id_weight(4), id_weight(2) + id_weight(3)) << "pairs of the same sum are told apart";
}

TEST_F(PlanePairs, WinnersDifferWithoutLegalAnswers) {
  const Measurement m = run(winners(), [](Planes& p) { p.id(3, 1) = 5; });
  EXPECT_TRUE(fails(m));
  EXPECT_EQ(m.max_difference, 1) << "a pixel, whatever the numbers";
  EXPECT_EQ(m.worst.place.x, 3);
  EXPECT_EQ(m.worst.place.y, 1);
  EXPECT_EQ(m.worst.candidate, 5);
  EXPECT_EQ(m.worst.reference, 3);
  EXPECT_TRUE(fails(run(winners(), [](Planes& p) { p.id(3, 1) = kBackground; })));
  EXPECT_TRUE(fails(run(winners(), [](Planes& p) { p.id(0, 0) = INT32_MAX; })));
}

TEST_F(PlanePairs, LegalAnswersDecideBetweenWinners) {
  const PlaneChange ours = [](Planes& p) { p.id(3, 1) = 5; };  // the reference has 3
  const auto counts = [&](const std::vector<std::int32_t>& answers) {
    legal = {};
    allow(3, 1, answers);
    const Measurement m = run(winners(), ours);
    EXPECT_EQ(m.items, 28u);
    return std::array{m.differing, m.ambiguous, m.disputed};
  };
  using Counts = std::array<std::uint64_t, 3>;
  EXPECT_EQ(counts({3, 5}), (Counts{0, 1, 0})) << "both are legal";
  EXPECT_EQ(counts({kBackground, 5}), (Counts{0, 0, 1})) << "ours alone";
  EXPECT_EQ(counts({kBackground, 3}), (Counts{1, 0, 0})) << "theirs alone";
  EXPECT_EQ(counts({kBackground, 4}), (Counts{1, 0, 0})) << "neither";
  EXPECT_EQ(counts({}), (Counts{1, 0, 0})) << "nothing is legal there";
  legal = {};
  allow(3, 1, {kBackground, 5});
  const Measurement m = run(winners(), ours);
  EXPECT_EQ(to_string(m.dispute.place), "pixel 3,1 primitive");
  EXPECT_EQ(m.dispute.candidate, 5);
  EXPECT_EQ(m.dispute.reference, 3);
  EXPECT_NE(m.reason, "");
  // And the same by the background.
  capture.planes.id(3, 1) = kBackground;
  EXPECT_EQ(counts({kBackground, 5}), (Counts{0, 1, 0}));
  EXPECT_EQ(counts({5}), (Counts{0, 0, 1}));
}

TEST_F(PlanePairs, LegalAnswersOfAnotherPixelDecideNothing) {
  allow(1, 3, {3, 5});  // x and y exchanged
  EXPECT_TRUE(fails(run(winners(), [](Planes& p) { p.id(3, 1) = 5; })));
}

TEST_F(PlanePairs, StencilValuesAreHeldLikeWinners) {
  capture.planes.stencil = Plane<std::uint8_t>(kWidth, kHeight, 5);
  EXPECT_TRUE(passes(run(winners(), kUnchangedPlanes)));
  for (const auto& pixel : {std::pair(3, 1), std::pair(0, 0)}) {  // a primitive's, and the background's
    const PlaneChange other = [pixel](Planes& p) { p.stencil(pixel.first, pixel.second) = 4; };
    const Measurement m = run(winners(), other);
    EXPECT_TRUE(fails(m));
    EXPECT_TRUE(fails(run(winners(), kUnchangedPlanes, other)));
    EXPECT_EQ(to_string(m.worst.place), fmt::format("pixel {},{} stencil", pixel.first, pixel.second));
  }
  EXPECT_FALSE(passes(run(winners(), [](Planes& p) { p.stencil = {}; })));
  EXPECT_FALSE(passes(run(winners(), kUnchangedPlanes, [](Planes& p) { p.stencil = {}; })));
  const auto counts = [&](std::uint8_t one, std::uint8_t another) {
    legal = {};
    allow(3, 1, {3, 3});
    const std::uint32_t first = legal.first[1 * kWidth + 3];
    legal.answers[first].stencil = one, legal.answers[first + 1].stencil = another;
    const Measurement m = run(winners(), [](Planes& p) { p.stencil(3, 1) = 4; });
    return std::array{m.differing, m.ambiguous, m.disputed};
  };
  using Counts = std::array<std::uint64_t, 3>;
  EXPECT_EQ(counts(4, 5), (Counts{0, 1, 0})) << "both are legal";
  EXPECT_EQ(counts(4, 6), (Counts{0, 0, 1})) << "ours alone";
  EXPECT_EQ(counts(5, 6), (Counts{1, 0, 0})) << "theirs alone";
}

TEST_F(PlanePairs, DepthIsHeldToTheBoundAndOneStep) {
  for (DepthFormat format : {DepthFormat::z8, DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f}) {
    scene.frame.depth = format;
    for (unsigned triangle : {0u, 1u}) {
      const int x = triangle == 0 ? 3 : 2, y = triangle == 0 ? 1 : 2;
      const double bound = bounds_from_origin(capture.records.triangles[triangle], x, y).depth;
      ASSERT_GE(bound, 1);
      const double step = depth_step(format, 0.5);
      for (double by : {0.999, -0.999, 1.001, -1.001}) {
        const PlaneChange moved = [&](Planes& p) { p.depth(x, y) += by * 64 * kU * bound + std::copysign(step, by); };
        EXPECT_EQ(passes(run(depth(), moved)), std::abs(by) < 1) << by;
        EXPECT_EQ(passes(run(depth(), kUnchangedPlanes, moved)), std::abs(by) < 1) << by;
        if (by > 1) {
          EXPECT_EQ(run(depth(), moved).worst.place.x, x);
          EXPECT_EQ(run(depth(), moved).worst.place.y, y);
          EXPECT_NEAR(run(depth(), moved).max_ratio, 1.001, 1e-6);
        }
      }
    }
  }
}

TEST_F(PlanePairs, TheBackgroundsDepthAndColoursAreEqual) {
  EXPECT_TRUE(fails(run(depth(), [](Planes& p) { p.depth(0, 3) = std::nextafter(1.0, 0.0); })));
  EXPECT_TRUE(passes(run(shaded(), [](Planes& p) { p.shaded(0, 3).g = 1e-30f; }))) << "no fragment has a colour there";
  EXPECT_TRUE(fails(run(codes(), [](Planes& p) { p.color(0, 3).g = code(2); })));
}

// Tolerance of channel c of primitive 3 at pixel (3, 1): that of the reference's plane plus that of the candidate's
// mean.
double shaded_limit(const Capture& candidate, int c) {
  const WindowTriangle<double>& t = candidate.records.triangles[0];
  return (64 * bounds_from_origin(t, 3, 1).color[c] + 10 * bounds_of_mean(t, 3, 1)[c]) * kU;
}

TEST_F(PlanePairs, ShadedIsHeldToTheBound) {
  for (int c = 0; c < 4; ++c) {
    const double limit = shaded_limit(capture, c);
    for (double by : {0.99, 1.01}) {
      const PlaneChange moved = [&](Planes& p) { p.shaded(3, 1)[c] += static_cast<float>(by * limit); };
      EXPECT_EQ(passes(run(shaded(), moved)), by < 1) << c;
      if (by > 1) {
        EXPECT_EQ(run(shaded(), moved).worst.place.y, 1);
        EXPECT_EQ(run(shaded(), moved).worst.place.x, 3);
      }
    }
    EXPECT_TRUE(fails(run(shaded(), [&](Planes& p) { p.shaded(3, 1)[c] -= code(1); }))) << "1/255";
  }
}

TEST_F(PlanePairs, WhatTheVerticesColoursDifferByIsLightsMatter) {
  const auto apart = [&](std::size_t vertex, double by) {
    Capture a = capture, b = capture;
    a.records.lit[vertex].color.g += 0.125;
    const double limit = shaded_limit(a, 1);
    for (auto* plane : {&a.planes.shaded, &a.planes.color}) (*plane)(3, 1).g += static_cast<float>(0.125 + by * limit);
    return std::pair(compare_shaded_planes(scene, a, b, 64), compare_codes(scene, a, b, 1, 64));
  };
  // The pixel shows primitive 3: vertices 9 to 11.
  for (std::size_t vertex : {9u, 10u, 11u}) {
    EXPECT_TRUE(passes(apart(vertex, 0.99).first));
    EXPECT_TRUE(fails(apart(vertex, 1.01).first));
    EXPECT_TRUE(passes(apart(vertex, 0.99).second));
  }
  for (std::size_t vertex : {8u, 12u}) {
    EXPECT_TRUE(fails(apart(vertex, 0).first)) << "another primitive's";
    EXPECT_TRUE(fails(apart(vertex, 0).second));
  }
  scene.draws[0].shading = Shading::flat;
  EXPECT_TRUE(passes(apart(11, 0.99).first));
  EXPECT_TRUE(fails(apart(10, 0).first)) << "not the provoking vertex";
}

TEST_F(PlanePairs, AReferenceWithoutColoursOfVerticesIsGrantedLightsTolerance) {
  const auto moved = [&](double by) {
    Capture a = capture, b = capture;
    b.records.lit.clear();
    const double limit = shaded_limit(capture, 0) + tolerance(Profile::opengl, Stage::light).factor * kU;
    a.planes.shaded(3, 1).r += static_cast<float>(by * limit);
    return compare_shaded_planes(scene, a, b, 64);
  };
  EXPECT_TRUE(passes(moved(0.99)));
  EXPECT_TRUE(fails(moved(1.01)));
}

TEST_F(PlanePairs, AWinnerThatTheSceneDoesNotHaveDoesNotCrash) {
  const PlaneChange far_off = [](Planes& p) { p.id(3, 1) = 1 << 30; };
  EXPECT_TRUE(passes(run(shaded(), far_off, far_off)));
}

TEST_F(PlanePairs, CodesMayBeNeighbours) {
  const auto moved = [&](int c, int by) {
    return [=](Planes& p) { p.color(2, 2)[c] += static_cast<float>(by) / 255; };
  };
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(passes(run(codes(), moved(c, 1))));
    EXPECT_TRUE(fails(run(codes(), moved(c, 2))));
    EXPECT_EQ(run(codes(), moved(c, 1)).max_difference, 1);
    EXPECT_EQ(run(codes(), moved(c, 3)).max_difference, 3);
    EXPECT_EQ(run(codes(), moved(c, 2)).worst.place.x, 2);
    EXPECT_EQ(run(codes(), moved(c, 2)).worst.place.y, 2);
  }
  EXPECT_TRUE(fails(run(codes(), moved(3, -2)))) << "alpha";
}

TEST_F(PlanePairs, EveryCodeIsItself) {
  for (int c = 0; c < 256; ++c) {
    const auto shows = [&](int other) { return [other](Planes& p) { p.color(0, 3).b = code(other); }; };
    EXPECT_EQ(run(codes(), shows(c), shows(c)).max_difference, 0) << c;
    EXPECT_EQ(run(codes(), shows(c), shows(c ^ 1)).max_difference, 1) << c;
    EXPECT_TRUE(fails(run(codes(), shows(c), shows(c ^ 2)))) << c;
  }
}

TEST_F(PlanePairs, SliversMayHaveTheWholeCodesOfTheirBound) {
  // Needles 3 px high and about 2^-6 px wide, until one's bound is just short of a whole code.
  double in_codes = 0;
  for (double width = 0x1p-6; in_codes - std::floor(in_codes) < 0.995; width *= 0.9999) {
    ASSERT_GT(width, 0x1p-7);
    capture.records.triangles[1] =
        triangle_of({{{2.5, 0.5, 0.25}, {2.5 + width, 3.75, 0.5}, {2.5, 3.5, 0.75}}}, {1, 1, 1}, 5);
    in_codes = 255 * 64 * kU * bounds_from_origin(capture.records.triangles[1], 2, 2).color.r;
  }
  const double whole = std::floor(in_codes);
  ASSERT_GT(whole, 1);
  ASSERT_LT(whole, 100);
  const auto moved = [&](double by) { return [=](Planes& p) { p.color(2, 2).r += static_cast<float>(by / 255); }; };
  EXPECT_TRUE(passes(run(codes(), moved(1 + whole))));
  EXPECT_TRUE(fails(run(codes(), moved(2 + whole))));
}

TEST_F(PlanePairs, ATriangleOfNoAreaIsNoExcuseToCallAnythingEqual) {
  // Its corners lie on a line, the snapped ones not: there is no gradient to take a bound from.
  auto& t = capture.records.triangles[1];
  t = triangle_of({{{1, 1, 0.25}, {3, 2, 0.5}, {5, 3, 0.75}}}, {1, 1, 1}, 5);
  t.v[1].snapped.y += 1;
  const auto open = [](const Measurement& m) { return m.ambiguous + m.differing > 0; };
  EXPECT_TRUE(open(run(depth(), [](Planes& p) { p.depth(2, 2) = 0; })));
  EXPECT_TRUE(open(run(codes(), [](Planes& p) { p.color(2, 2).r = 1; })));
  EXPECT_TRUE(open(run(shaded(), [](Planes& p) { p.shaded(2, 2).r = 1; })));
  for (double bad : not_numbers()) {
    EXPECT_TRUE(fails(run(depth(), [&](Planes& p) { p.depth(2, 2) = bad; })));
    EXPECT_TRUE(fails(run(shaded(), [&](Planes& p) { p.shaded(2, 2).r = static_cast<float>(bad); })));
  }
}

TEST_F(PlanePairs, WhereTheWinnersDifferValuesAreVisibilitysMatter) {
  const PlaneChange other = [](Planes& p) {
    p.id(3, 1) = 5;
    p.depth(3, 1) = 0;
    p.shaded(3, 1) = p.color(3, 1) = glm::vec4(1);
  };
  for (const auto& compare : {depth(), shaded(), codes()}) {
    EXPECT_TRUE(passes(run(compare, other)));
  }
  EXPECT_TRUE(fails(run(winners(), other)));
}

TEST_F(PlanePairs, MergedCodesAreRoundingsOfTheExactColour) {
  // Exact hands out unrounded colours; 100.5 lies between two codes.
  const auto exactly = [&](double value) {
    return [=](Planes& p) { p.color(3, 1).r = static_cast<float>(value / 255); };
  };
  EXPECT_TRUE(passes(run(merge(), kUnchangedPlanes, exactly(100.3))));
  EXPECT_TRUE(passes(run(merge(), kUnchangedPlanes, exactly(100.5))));
  EXPECT_TRUE(passes(run(merge(), kUnchangedPlanes, exactly(99.5))));
  EXPECT_TRUE(fails(run(merge(), kUnchangedPlanes, exactly(100.501)))) << "truncated";
  EXPECT_TRUE(fails(run(merge(), kUnchangedPlanes, exactly(99.499))));
  EXPECT_TRUE(fails(run(merge(), kUnchangedPlanes, exactly(101)))) << "1/255";
  EXPECT_EQ(run(merge(), kUnchangedPlanes, exactly(99)).worst.place.x, 3);
  EXPECT_NEAR(run(merge(), kUnchangedPlanes, exactly(99)).max_difference, 2, 1e-3) << "in halves of 1/255";
}

TEST_F(PlanePairs, MergedTwelveBitCodesToo) {
  scene.frame.color = ColorFormat::rgba12;
  for (glm::vec4& c : capture.planes.color.values()) c = glm::round(c * 4095.0f) / 4095.0f;
  const auto exactly = [&](double value) {
    return [=](Planes& p) { p.color(3, 1).r = static_cast<float>(value / 4095); };
  };
  const PlaneChange is = exactly(1000);
  EXPECT_TRUE(passes(run(merge(), is, exactly(1000.3))));
  EXPECT_TRUE(passes(run(merge(), is, exactly(1000.5))));
  EXPECT_TRUE(passes(run(merge(), is, exactly(999.5))));
  EXPECT_TRUE(fails(run(merge(), is, exactly(1000.502)))) << "truncated";
  EXPECT_TRUE(fails(run(merge(), is, exactly(999.498))));
  EXPECT_NEAR(run(merge(), is, exactly(999)).max_difference, 2, 5e-3) << "in half codes";
  EXPECT_FALSE(passes(run(merge(), exactly(1000.4), exactly(1000.4)))) << "never rounded to the format";
  const PlaneChange of_8_bits = [](Planes& p) { p.color(3, 1).r = 100 / 255.0f; };
  EXPECT_FALSE(passes(run(merge(), of_8_bits, of_8_bits))) << "rounded to 8 bits: 1605.9 of 4095";
  EXPECT_FALSE(passes(run(merge(), exactly(4096), exactly(4096)))) << "never clamped";
}

TEST_F(PlanePairs, WhatIsNoCodeFailsInA8BitFrame) {
  const PlaneChange between = [](Planes& p) { p.color(3, 1).r = 100.4f / 255; };
  EXPECT_FALSE(passes(run(merge(), between, between))) << "never rounded to the format";
  const PlaneChange beyond = [](Planes& p) { p.color(3, 1).r = 256 / 255.0f; };
  EXPECT_FALSE(passes(run(merge(), beyond, beyond))) << "never clamped";
}

TEST_F(PlanePairs, MergedFloatsAndDepthsAreEqual) {
  const PlaneChange depth_ulp = [](Planes& p) { p.depth(3, 1) = above(p.depth(3, 1)); };
  EXPECT_TRUE(fails(run(merge(), depth_ulp)));
  EXPECT_EQ(run(merge(), depth_ulp).worst.place.field[0], 'z');
  scene.frame.color = ColorFormat::rgba32f;
  for (int c = 0; c < 4; ++c) {
    const PlaneChange ulp = [&](Planes& p) { p.color(0, 2)[c] = static_cast<float>(float_above(p.color(0, 2)[c])); };
    EXPECT_TRUE(fails(run(merge(), ulp)));
    EXPECT_TRUE(fails(run(merge(), kUnchangedPlanes, ulp)));
  }
  EXPECT_TRUE(fails(run(merge(), depth_ulp)));
}

TEST_F(PlanePairs, WhatIsNoNumberFails) {
  for (double bad : not_numbers()) {
    const auto number = static_cast<float>(bad);
    for (const auto& pixel : {std::pair(3, 1), std::pair(0, 0)}) {  // drawn, and the background
      const int x = pixel.first, y = pixel.second;
      const PlaneChange z = [&](Planes& p) { p.depth(x, y) = bad; };
      for (const auto& compare : {depth(), merge()}) {
        EXPECT_TRUE(fails(run(compare, z)));
        EXPECT_TRUE(fails(run(compare, kUnchangedPlanes, z)));
      }
      for (int c = 0; c < 4; ++c) {
        const PlaneChange color = [&](Planes& p) { p.shaded(x, y)[c] = p.color(x, y)[c] = number; };
        for (const auto& compare : {shaded(), codes(), merge()}) {
          EXPECT_TRUE(fails(run(compare, color)));
          EXPECT_TRUE(fails(run(compare, kUnchangedPlanes, color)));
          if (std::isnan(bad)) {
            EXPECT_TRUE(fails(run(compare, color, color))) << "NaN on both sides";
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace plumbline::check
