// Legal answers by a renderer's conventions: what each allows, and what none does.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "capture/float_depth.h"
#include "reference/arithmetic/error_in_float.h"
#include "reference/oracle/oracle.h"
#include "scene/scene.h"
#include "tests/oracle/window_answers.h"

namespace plumbline::math {
namespace {

using C = Conventions;

const std::vector<std::array<glm::vec3, 3>> kOne = {
    {glm::vec3(3.2f, 2.1f, 0.5f), {29.7f, 5.3f, 0.5f}, {9.9f, 27.8f, 0.5f}}};

// An alpha of 0 stays 0 by any weights: no fragment passes, whether alpha is tested in float or in codes.
TEST(OracleConventions, AnAlphaOfZeroIsZeroInAnyArithmetic) {
  Scene scene = window_scene(kOne);
  AlphaTest test;
  test.func = DepthFunc::greater, test.reference = 0;
  scene.draws[0].alpha_test = test;
  const auto answers_at = [&](float alpha) {
    for (glm::vec4& color : scene.meshes[0].colors) color.a = alpha;
    C in_float;
    in_float.alpha_test = C::AlphaTest::in_float;
    return legal(scene, in_float).at(14, 12).size();
  };
  EXPECT_EQ(answers_at(0), 1u) << "the background";
  EXPECT_EQ(answers_at(1e-9f), 2u) << "may be rounded to 0, or may not";
  EXPECT_EQ(answers_at(1), 1u);
}

// A texel that is a code is that code wherever codes are rounded to the nearest. Rounded down, float's error may take
// it to the code below.
TEST(OracleConventions, ACodeOfAFragmentIsNotRounded) {
  Scene scene = window_scene(kOne);
  scene.frame.color = ColorFormat::rgba8;
  scene.meshes[0].texcoords.assign(3, glm::vec2(0.5f));
  scene.textures.emplace_back().levels = {{1, 1, {glm::vec4(1, 0, 128 / 255.0f, 1)}}};
  scene.textures[0].format = TextureFormat::rgba;
  scene.draws[0].texture = DrawTexture{0, TextureEnvironment::replace, glm::vec4(0)};
  const auto bound = [&](C::Rounding rounding, float blue) {
    scene.textures[0].levels[0].texels[0].b = blue;
    C codes;
    codes.fragment_colors = C::ColorNumbers::in_codes, codes.color_rounding = rounding;
    return 255 * legal(scene, codes).at(14, 12).front().color_bound;
  };
  EXPECT_LT(bound(C::Rounding::nearest, 128 / 255.0f), 0.01);
  EXPECT_GE(bound(C::Rounding::nearest, 128.3f / 255), 0.5);
  EXPECT_GE(bound(C::Rounding::down, 128 / 255.0f), 0.5);
}

// A depth of slope 1/30 per pixel: corners that snapping moves by half a step of 1/256 pixel move it by 1/15360 more.
TEST(OracleConventions, DepthsBetweenCornersAsTheyAreDoNotMoveWithTheGrid) {
  const Scene scene =
      window_scene({{glm::vec3(3.201f, 2.103f, 0.1f), {29.703f, 5.301f, 0.9834f}, {9.905f, 27.807f, 0.32347f}}});
  const auto half = [&](C::DepthCorners corners) {
    C c;
    c.depth_corners = corners;
    const LegalAnswer winner = legal(scene, c).at(14, 12).front();
    return (winner.z_hi - winner.z_lo) / 2;
  };
  const double as_they_are = half(C::DepthCorners::as_they_are);
  EXPECT_GT(as_they_are, 0);
  EXPECT_LT(as_they_are, 3e-6);
  EXPECT_NEAR(half(C::DepthCorners::either), as_they_are + 1.0 / 15360, 1e-7);
  EXPECT_EQ(half(C::DepthCorners::either), half(C::DepthCorners::snapped));
}

// A corner on the near plane makes a piece of the cut triangle thin, so that any depth is legal beside its border; what
// lies beyond the plane is cut off all the same.
TEST(OracleConventions, ThinPiecesOfACutDoNotReachBeyondThePlane) {
  const Scene scene = window_scene({{glm::vec3(4, 4, 0), {28, 4, -1}, {4, 28, 1}}});
  const Legal answers = legal(scene, {});
  EXPECT_EQ(answers.at(20, 5).size(), 1u);
  EXPECT_EQ(answers.at(20, 5).front().primitive, kBackground);
  EXPECT_EQ(answers.at(6, 20).back().primitive, 0);
}

// Light of 1/4 that two triangles add: once on the diagonal that they share, whichever of them does. On the border the
// tie rule says whether one does.
TEST(OracleConventions, OneOfTwoTrianglesBlendsOnTheirEdge) {
  const glm::vec3 a(4.5f, 4.5f, 0.5f), c(28.5f, 28.5f, 0.5f);
  Scene scene = window_scene({{a, glm::vec3(28.5f, 4.5f, 0.5f), c}, {a, c, glm::vec3(4.5f, 28.5f, 0.5f)}});
  for (glm::vec4& color : scene.meshes[0].colors) color = glm::vec4(0.25f);
  scene.draws[0].merge.blend = Blend{{}, {}, glm::vec4(0)};
  scene.draws[0].merge.blend->rgb.destination = BlendFactor::one;
  const auto highest = [&](C::TieRule rule) {
    C c_of_rule;
    c_of_rule.tie_rule = rule;
    const Legal answers = legal(scene, c_of_rule);
    return std::array{answers.color_hi(14, 14).r, answers.color_hi(14, 9).r, answers.color_hi(1, 1).r,
                      answers.color_hi(28, 14).r};
  };
  for (const C::TieRule rule : {C::TieRule::any, C::TieRule::left_bottom}) {
    for (const float red : {highest(rule)[0], highest(rule)[1]}) EXPECT_NEAR(red, 0.25f, 1e-5f);
    EXPECT_EQ(highest(rule)[2], 0);
  }
  EXPECT_FALSE(highest(C::TieRule::inclusive)[0] < 0.4f);
  EXPECT_FALSE(std::isfinite(highest(C::TieRule::any)[3]));
}

// A renderer that leaves the sides to the raster cuts at the near plane alone: its corners lie far outside the window,
// and its depths in float are off by more.
TEST(OracleConventions, CornersOfTheNearPlanesCutsMayLieFarOutside) {
  Scene scene = window_scene({{glm::vec3(-4, -1, 20), {4, -1, 20}, {0, -1, -1}}});  // a floor, from behind the eye
  scene.projection = Perspective{60, 0.01f, 100};
  scene.draws[0].depth_range = {0, 1};
  C in_float;
  in_float.depth_arithmetic = C::DepthArithmetic::in_float;
  const auto width_at = [&](const C& conventions) {
    const Legal legal_here = legal(scene, conventions);
    const auto answers = legal_here.at(kSize / 2, kSize / 4);
    return answers.empty() ? -1 : answers.back().z_hi - answers.back().z_lo;
  };
  Projected projected = project(scene, in_float);
  Triangle& floor = projected.triangles[0];
  EXPECT_GT(floor.guarded.extent.y, 10 * kSize);
  const PieceAltitudes altitudes{floor.altitude, floor.guarded.altitude};
  const double guarded = error_in_float(projected, floor, {0, -4, 1}, altitudes);
  floor.guarded.extent = glm::dvec2(0);
  EXPECT_LT(10 * error_in_float(projected, floor, {0, -4, 1}, altitudes), guarded);
  EXPECT_GT(width_at(in_float), width_at({}));
  EXPECT_EQ(
      project(window_scene({{glm::vec3(-40, -40, 0.5f), {99, 3, 0.5f}, {9, 99, 0.5f}}})).triangles[0].guarded.extent,
      glm::dvec2(0))
      << "cut at the sides alone";
}

TEST(OracleConventions, ACoarserGridLeavesMorePixelsOpen) {
  const Scene scene = window_scene(kOne);
  C of_4, of_none;
  of_4.subpixel_bits = 4, of_none.subpixel_bits = C::kFloat;
  const std::size_t with_4 = open_pixels(legal(scene, of_4)), with_8 = open_pixels(legal(scene, {})),
                    without = open_pixels(legal(scene, of_none));
  EXPECT_GT(with_4, with_8);
  EXPECT_GE(with_8, without);
  EXPECT_LE(without, 1u) << "no centre lies on an edge";
}

// Slack to either side: the declared arithmetic's error; of a cut triangle, that of its pieces.
TEST(OracleConventions, DepthsInFloatLieWithinTheErrorOfTheirArithmetic) {
  using enum C::DepthArithmetic;
  constexpr int kX = 12, kY = 11;
  const WindowCorners whole = {glm::vec3(3.25f, 2.5f, 0.25f), glm::vec3(29.5f, 5.25f, 0.5f),
                               glm::vec3(9.75f, 27.5f, 0.75f)};
  WindowCorners beyond = whole;
  beyond[1].x = 70;
  const auto slack = [&](const WindowCorners& corners, C::DepthArithmetic arithmetic) {
    const Scene scene = window_scene({{glm::vec3(corners[0]), glm::vec3(corners[1]), glm::vec3(corners[2])}});
    C declared;
    declared.depth_arithmetic = arithmetic;
    const auto width = [&](const C& conventions) {
      const Legal of = legal(scene, conventions);
      const LegalAnswer& last = of.at(kX, kY).back();
      EXPECT_EQ(last.primitive, 0);
      return last.z_hi - last.z_lo;
    };
    return (width(declared) - width({})) / 2;
  };
  EXPECT_EQ(slack(whole, in_double), 0);
  for (const auto arithmetic : {in_float, in_float_from_origin}) {
    const double error = depth_error(arithmetic, whole, {kX + 0.5, kY + 0.5}, kNoSides),
                 of_beyond = depth_error(arithmetic, beyond, {kX + 0.5, kY + 0.5}, kNoSides);
    EXPECT_GT(error, 0x1p-23);
    EXPECT_NEAR(slack(whole, arithmetic), error, 0.01 * error);
    EXPECT_GT(slack(beyond, arithmetic), 1.05 * of_beyond) << "pieces near the pixel";
    EXPECT_LT(slack(beyond, arithmetic), 3 * of_beyond) << "pieces elsewhere";
  }
}

// A corner half way between two places of the grid leaves open what it decides, and no more.
TEST(OracleConventions, AnUncertainCornerLeavesOpenWhatItDecides) {
  const Scene scene =
      window_scene({{glm::vec3(10.5f, 10.5f, 0.5f), {20.5f + 1.0f / 512, 13.5f, 0.5f}, {13, 25, 0.5f}}});
  using enum C::TieRule;
  for (const C::TieRule rule : {left_bottom, left_top, right_bottom, right_top, inclusive, exclusive}) {
    C declared;
    declared.tie_rule = rule;
    const Legal of = legal(scene, declared);
    EXPECT_EQ(of.certain(10, 10), of.possible(10, 10)) << "at the corner that is certain";
    // The other corner is the sample, or 1/256 pixel to the right of it.
    if (rule == inclusive) {
      EXPECT_EQ(of.certain(20, 13), 1u);
    } else if (rule == exclusive) {
      EXPECT_NE(of.certain(20, 13), of.possible(20, 13));
    }
  }
}

// A sample at the lower left corner sees what the centre sees of a picture half a pixel farther.
TEST(OracleConventions, ASampleIsAPlace) {
  std::vector<std::array<glm::vec3, 3>> moved = kOne;
  for (glm::vec3& p : moved[0]) p += glm::vec3(0.5f, 0.5f, 0);
  C corner;
  corner.sample = {0, 0};
  const Legal a = legal(window_scene(kOne), corner), b = legal(window_scene(moved), {}),
              centre = legal(window_scene(kOne), {});
  EXPECT_EQ(a.certain.values(), b.certain.values());
  EXPECT_EQ(a.possible.values(), b.possible.values());
  EXPECT_NE(a.certain.values(), centre.certain.values());
}

TEST(OracleConventions, AHalfVolumeIsCutInItsMiddle) {
  // From depth 0 at the left to 1 at the right.
  const Scene scene =
      window_scene({{glm::vec3(0, 0, 0), {32, 0, 1}, {32, 32, 1}}, {glm::vec3(0, 0, 0), {32, 32, 1}, {0, 32, 0}}});
  C half, none;
  half.clip_depth = C::ClipDepth::zero_to_w, none.depth_planes = C::DepthPlanes::clamped;
  EXPECT_EQ(legal(scene, {}).certain(8, 8), 1u);
  const Legal cut = legal(scene, half);
  EXPECT_EQ(cut.possible(8, 8), 0u);
  ASSERT_EQ(cut.at(24, 8).size(), 1u);
  EXPECT_NEAR(cut.at(24, 8)[0].z_lo, 2 * (24.5 / 32) - 1, 1e-3) << "z / w";
  Scene nearer = scene;
  for (glm::vec3& p : nearer.meshes[0].positions) p.z += 0.5f;  // depths from -1/2 to 1/2
  EXPECT_EQ(legal(nearer, {}).possible(8, 8), 0u);
  EXPECT_EQ(legal(nearer, none).certain(8, 8), 1u);
}

TEST(OracleConventions, WithoutPerspectiveColoursGoByTheWindow) {
  const auto at = [](float x, float y, float w) { return glm::vec3(0.9f * x * w, 0.9f * y * w, w); };
  Scene scene =
      window_scene({{at(-1, -1, 2), at(1, -1, 16), at(1, 1, 16)}, {at(-1, -1, 2), at(1, 1, 16), at(-1, 1, 2)}});
  scene.projection = Perspective{90, 1, 100};
  const std::array<float, 6> shares = {0, 1, 1, 0, 1, 0};
  for (std::size_t i = 0; i < 6; ++i) scene.meshes[0].colors[i] = glm::vec4(glm::vec3(shares[i]), 1);
  C affine;
  affine.interpolation = C::Interpolation::affine;
  const double s = (0.03125 / 0.9 + 1) / 2;  // of the way from the left to the right
  EXPECT_NEAR(legal(scene, affine).at(16, 16)[0].color.r, s, 1e-5);
  EXPECT_NEAR(legal(scene, {}).at(16, 16)[0].color.r, (s / 16) / ((1 - s) / 2 + s / 16), 1e-5);
}

// A cut at the frame's side, where pixels' lower left corners are sampled: float may leave it beside the side, where
// even an inclusive rule takes no sample on the side; a grid puts it back.
TEST(OracleConventions, SamplesOnASideThatCutsAreOpenWithoutAGrid) {
  const Scene scene = window_scene({{{{-20, 4.25f, 0.5f}, {25, 10.25f, 0.5f}, {-20, 28.25f, 0.5f}}}});
  const auto certain = [&](C::TieRule rule, int bits) {
    C c;
    c.sample = glm::dvec2(0);
    c.tie_rule = rule;
    c.subpixel_bits = bits;
    const Legal of = legal(scene, c);
    EXPECT_GE(of.possible(0, 14), 1u);
    EXPECT_EQ(of.certain(6, 14), 1u);
    return of.certain(0, 14);
  };
  EXPECT_EQ(certain(C::TieRule::inclusive, 8), 1u);
  EXPECT_EQ(certain(C::TieRule::inclusive, C::kFloat), 0u);
  EXPECT_EQ(certain(C::TieRule::left_bottom, 8), 1u);
  EXPECT_EQ(certain(C::TieRule::exclusive, 8), 0u);
}

// Samples on a diagonal of a cut triangle are in both pieces by an inclusive rule; which diagonal is unknown.
TEST(OracleConventions, AnInclusiveRuleCoversByBothPiecesBesideADiagonal) {
  const Scene scene = window_scene({{glm::vec3(-20, -20, 0.5f), {100, -20, 0.5f}, {10, 60, 0.5f}}});
  C inclusive, left_bottom;
  inclusive.tie_rule = C::TieRule::inclusive, left_bottom.tie_rule = C::TieRule::left_bottom;
  const Legal both = legal(scene, inclusive), one = legal(scene, left_bottom);
  EXPECT_EQ(both.certain(16, 16), 1u);
  EXPECT_EQ(both.possible(16, 16), 2u);
  EXPECT_EQ(one.possible(16, 16), 1u);
}

// Both pieces blend, and both run the stencil operation.
TEST(OracleConventions, AnInclusiveRuleBlendsAndCountsByBothPieces) {
  Scene scene = window_scene({{glm::vec3(-10, -10, 0.5f), {90, -10, 0.5f}, {-10, 90, 0.5f}}});
  C inclusive, left_bottom;
  inclusive.tie_rule = C::TieRule::inclusive, left_bottom.tie_rule = C::TieRule::left_bottom;
  scene.draws[0].merge.blend = Blend{};
  EXPECT_FALSE(std::isfinite(legal(scene, inclusive).color_hi(16, 16).r));
  EXPECT_TRUE(std::isfinite(legal(scene, inclusive).color_hi(5, 20).r)) << "on no diagonal";
  EXPECT_TRUE(std::isfinite(legal(scene, left_bottom).color_hi(16, 16).r));
  scene.draws[0].merge.blend.reset();
  scene.frame.stencil = StencilFormat::s8;
  StencilFace counts;
  counts.func = CompareFunc::always, counts.pass = StencilOp::increment;
  scene.draws[0].stencil = Stencil{counts, counts};
  const auto stencils = [&](const C& by, glm::ivec2 pixel = {16, 16}) {
    const Legal answers = legal(scene, by);
    std::vector<int> out;
    for (const LegalAnswer& answer : answers.at(pixel.x, pixel.y)) out.push_back(answer.stencil);
    std::ranges::sort(out);
    return out;
  };
  EXPECT_EQ(stencils(inclusive), (std::vector{1, 2}));
  EXPECT_EQ(stencils(inclusive, {5, 20}), std::vector{1});
  EXPECT_EQ(stencils(left_bottom), std::vector{1});
}

// A triangle that the frame's sides may cut: uncut, its colour without perspective is within the bound of any pieces',
// as is that with perspective. Without a difference in w nothing is added to the bound.
TEST(OracleConventions, WithoutPerspectiveCutColoursAreBounded) {
  const auto at = [](float x, float y, float w) { return glm::vec3(x * w, y * w, w); };
  const auto answer = [&](float w, C::Interpolation interpolation) {
    Scene scene = window_scene({{at(-1.5f, -1, 2), at(1.5f, -1, w), at(1.5f, 1, w)}});
    scene.projection = Perspective{90, 1, 100};
    for (std::size_t i = 0; i < 3; ++i) scene.meshes[0].colors[i] = glm::vec4(glm::vec3(i == 0 ? 0 : 1), 1);
    C conventions;
    conventions.interpolation = interpolation;
    return legal(scene, conventions).at(24, 8)[0];
  };
  const double s = (24.5 / 16 - 1 + 1.5) / 3;  // of the way from the left to the right
  for (const float w : {2.0f, 3.0f, 16.0f}) {
    const LegalAnswer affine = answer(w, C::Interpolation::affine);
    const double with_perspective = (s / w) / ((1 - s) / 2 + s / w),
                 range = std::max(with_perspective, 1 - with_perspective);
    EXPECT_LE(std::abs(affine.color.r - with_perspective), affine.color_bound) << w;
    EXPECT_LE(std::abs(affine.color.r - s), affine.color_bound) << w;
    EXPECT_LE(affine.color_bound, 2.1 * (1 - 2 / w) * range + 1e-5) << w;
    EXPECT_LE(answer(w, C::Interpolation::perspective).color_bound, 3e-5) << w;
  }
}

// Two triangles that share an edge through centres: in one of them, whichever; on a border, in one or none.
TEST(OracleConventions, SharedEdgesAreCoveredOnce) {
  const Scene scene = window_scene(
      {{glm::vec3(4, 4, 0.5f), {28, 4, 0.5f}, {28, 28, 0.5f}}, {glm::vec3(4, 4, 0.5f), {28, 28, 0.5f}, {4, 28, 0.5f}}});
  const Legal both = legal(scene, {});
  for (int i = 6; i < 26; ++i) {
    EXPECT_EQ(both.certain(i, i), 1u) << i;
    EXPECT_EQ(both.possible(i, i), 1u) << i;
    EXPECT_EQ(both.shared(i, i), 1u) << i;
    EXPECT_EQ(both.at(i, i).size(), 2u) << i;
  }
  EXPECT_EQ(both.shared(20, 8), 0u);
  Scene single = scene;
  single.meshes[0].triangles.pop_back();
  const Legal one = legal(single, {});
  EXPECT_EQ(one.certain(10, 10), 0u);
  EXPECT_EQ(one.possible(10, 10), 1u);
  EXPECT_EQ(one.shared(10, 10), 0u);
}

}  // namespace
}  // namespace plumbline::math
