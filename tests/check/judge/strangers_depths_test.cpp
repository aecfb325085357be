// Renderers of others that keep depths of double in a frame that asks for float, interpolate between corners that they
// do not snap, or round a clear depth otherwise.
#include <algorithm>
#include <memory>
#include <vector>

#include "capture/by_conventions.h"
#include "capture/fragment_outcomes.h"
#include "check/bounds/bounds.h"
#include "check/compare/compare_planes.h"
#include "check/compare/compare_records.h"
#include "check/judge/rows.h"
#include "renderers/pipeline_renderer.h"
#include "tests/check/fixtures.h"
#include "tests/check/judge/row_of.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

constexpr std::size_t kPixels = 16;

// Two triangles that both cover the whole of a frame of 4 x 4 pixels, the second at depth 3/4.
struct DepthInDouble : testing::Test {
  DepthInDouble() {
    scene.name = "test/depth_in_double";
    scene.frame.width = scene.frame.height = 4;
    scene.frame.depth = DepthFormat::z32f;
    scene.meshes.push_back(make_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 2}}, {}));
    scene.draws.emplace_back();
    candidate.width = candidate.height = 4;
    candidate.planes.id = {4, 4, kBackground};
    Records<double>& r = candidate.records;
    for (std::uint32_t t : {0u, 1u}) {
      r.triangles.push_back(triangle_of({glm::dvec3(0, 0, 0), {8, 0, 0}, {0, 8, 0}}, {1, 1, 1}, t));
      for (std::uint16_t y = 0; y < 4; ++y)
        for (std::uint16_t x = 0; x < 4; ++x) r.covered.push_back({.triangle = t, .x = x, .y = y});
    }
    r.depth.assign(2 * kPixels, 0.75);
    r.drawn.resize(2 * kPixels);
    allow({0, 1});
  }
  // The oracle's winners, at each pixel.
  void allow(const std::vector<std::int32_t>& winners) {
    legal = {};
    legal.certain = legal.possible = Plane<std::uint32_t>(4, 4, 2);
    legal.first = {0};
    for (std::size_t i = 0; i < kPixels; ++i) {
      for (const std::int32_t id : winners) legal.answers.push_back({id, 0, 0, 1, {}});
      legal.first.push_back(static_cast<std::uint32_t>(legal.answers.size()));
    }
  }
  // Tests the depths in double by "less", and judges what is drawn.
  Comparison row(bool foreign = true) {
    for (std::size_t i = 0; i < kPixels; ++i) {
      const bool nearer = candidate.records.depth[kPixels + i] < candidate.records.depth[i];
      candidate.records.drawn[i].drawn = true;
      candidate.records.drawn[kPixels + i].drawn = nearer != (i == wrong);
      candidate.planes.id.values()[i] = candidate.records.drawn[kPixels + i].drawn ? 1 : 0;
    }
    std::vector<Comparison> out;
    const SceneJudgement c{.scene = scene,
                           .candidate = candidate,
                           .legal = legal,
                           .referee = exact.get(),
                           .rows = out,
                           .foreign = foreign};
    run_exact_stage(c, *exact, Stage::visibility, "exact");
    return out.at(0);
  }

  Scene scene;
  Capture candidate;
  Legal legal;
  std::size_t wrong = kPixels;  // number of a pixel whose test comes out wrong
  std::unique_ptr<Renderer> exact = exact::make_exact();
};

TEST_F(DepthInDouble, WhatOneFloatHoldsMayBeOrdered) {
  candidate.records.depth[0] = above(0.75);
  candidate.records.depth[5] = 0.75 + 0x1p-26;
  const Comparison c = row();
  EXPECT_EQ(c.outcome, Outcome::ambiguous_only);
  EXPECT_EQ(c.measurement.items, kPixels);
  EXPECT_EQ(c.measurement.ambiguous, 2u);
}

TEST_F(DepthInDouble, ATestThatIsWrongElsewhereIsFound) {
  candidate.records.depth[0] = above(0.75);
  wrong = 3;
  const Comparison equal_depths = row();
  EXPECT_EQ(equal_depths.outcome, Outcome::different);
  EXPECT_EQ(equal_depths.measurement.differing, 1u);
  EXPECT_EQ(equal_depths.measurement.worst.place.x, 3);
  candidate.records.depth[3] = float_above(0.75);
  EXPECT_EQ(row().measurement.differing, 1u) << "two floats";
}

TEST_F(DepthInDouble, AWinnerThatTheOracleDoesNotAllowIsFound) {
  candidate.records.depth[0] = above(0.75);
  allow({0});
  EXPECT_EQ(row().outcome, Outcome::different) << "it shows the second";
  legal = {};
  EXPECT_EQ(row().outcome, Outcome::different) << "no oracle says";
}

TEST_F(DepthInDouble, NoOtherRendererAndNoOtherFormatIsExcused) {
  candidate.records.depth[0] = above(0.75);
  EXPECT_EQ(row(false).measurement.differing, 1u);
  scene.frame.depth = DepthFormat::z24;
  EXPECT_EQ(row().measurement.differing, 1u);
}

TEST_F(DepthInDouble, TheDepthOfTheClearedFrameCountsToo) {
  for (double& z : candidate.records.depth) z = 0.5;
  scene.frame.clear_depth = 0.75;
  candidate.records.depth[2] = 0.75 - 0x1p-27;
  EXPECT_EQ(row().outcome, Outcome::ambiguous_only);
  candidate.records.depth[2] = kNaN;
  EXPECT_EQ(row().outcome, Outcome::different);
}

// Corners on a grid of 1/256 pixel turn this triangle over; at pixel (39, 43) its plane has depth 0.3758316779.
TEST(TurnedOver, ARendererThatSnapsNothingInterpolatesBetweenItsOwnCorners) {
  Scene scene;
  scene.name = "test/turned_over";
  scene.frame.width = scene.frame.height = 64;
  scene.meshes.push_back(make_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}));
  scene.draws.emplace_back();
  Capture candidate;
  candidate.width = candidate.height = 64;
  const glm::vec3 first(33.7331543f, 44.4609375f, 0.888888896f), second(7.79931641f, 48.7861328f, 0.055555582f),
      third(41.5056152f, 43.1657715f, 0.222222239f);
  candidate.records.triangles = {triangle_of({glm::dvec3(first), glm::dvec3(second), glm::dvec3(third)})};
  candidate.records.covered = {{.triangle = 0, .x = 39, .y = 43}};
  const auto outcome = [&](double z, bool foreign, int bits) {
    candidate.records.depth = {std::round(z * 16777215) / 16777215};
    Conventions conventions;
    conventions.subpixel_bits = bits;
    return row_of_stage(scene, candidate, Stage::depth, conventions, foreign).outcome;
  };
  EXPECT_NE(outcome(0.3758316779, true, Conventions::kFloat), Outcome::different);
  EXPECT_EQ(outcome(0.3758318, true, Conventions::kFloat), Outcome::different) << "two steps off";
  EXPECT_EQ(outcome(0.3758316779, true, 8), Outcome::different);
  EXPECT_EQ(outcome(0.3758316779, false, Conventions::kFloat), Outcome::different);
}

// 0.3 of a depth of 24 bits is 5033164.5 codes.
TEST(ClearDepth, HalfWayBetweenTwoCodesMayBeEitherOfAStrangers) {
  Scene scene;
  scene.name = "test/clear_depth";
  scene.frame.width = scene.frame.height = 4;
  scene.frame.clear_depth = 0.3;
  const auto exact = exact::make_exact();
  Capture candidate = exact->capture(scene, {.records = StageSet::all()});
  const auto outcome = [&](double code, bool foreign) {
    candidate.planes.depth.values()[5] = code / 16777215;
    const Legal none;
    std::vector<Comparison> out;
    const SceneJudgement c{
        .scene = scene, .candidate = candidate, .legal = none, .referee = exact.get(), .rows = out, .foreign = foreign};
    run_exact_stage(c, *exact, Stage::merge, "exact");
    return out.at(0).outcome;
  };
  for (const bool foreign : {false, true}) {
    EXPECT_EQ(outcome(5033165, foreign), Outcome::different) << "other pixels are cleared to 5033164";
    std::ranges::fill(candidate.planes.depth.values(), 5033165.0 / 16777215);
    EXPECT_EQ(outcome(5033165, foreign) == Outcome::different, !foreign);
    EXPECT_EQ(outcome(5033164, foreign), Outcome::different) << "one pixel is cleared otherwise";
    std::ranges::fill(candidate.planes.depth.values(), 5033164.0 / 16777215);
    EXPECT_EQ(outcome(5033163, foreign), Outcome::different);
    EXPECT_NE(outcome(5033164, foreign), Outcome::different);
    EXPECT_EQ(outcome(5033166, foreign), Outcome::different);
    EXPECT_EQ(outcome(5033164.5, foreign), Outcome::different) << "no code";
    EXPECT_EQ(outcome(kNaN, foreign), Outcome::different);
  }
  scene.frame.clear_depth = 0.30000001;
  candidate = exact->capture(scene, {.records = StageSet::all()});
  EXPECT_EQ(outcome(5033164, true), Outcome::different);
}

// A view volume of [0,w] in z keeps clip positions a rounding off; ours are copies.
TEST(StrangersPositions, MayBeARoundingOffWhereNoPlaneCuts) {
  const Scene scene = two_draws();
  const auto exact = exact::make_exact();
  Capture candidate = exact->capture(scene, {.records = StageSet::all()});
  ClipVertex<double>& v = candidate.records.polygons.vertices.at(0);
  ASSERT_FALSE(v.cut);
  v.p_clip.z = float_above(v.p_clip.z);
  const Legal none;
  for (const bool foreign : {false, true}) {
    std::vector<Comparison> out;
    const SceneJudgement c{
        .scene = scene, .candidate = candidate, .legal = none, .referee = exact.get(), .rows = out, .foreign = foreign};
    run_exact_stage(c, *exact, Stage::clip, "exact");
    EXPECT_EQ(out.at(0).outcome == Outcome::different, !foreign);
  }
}

// OpenGL allows the gradient's length, and its larger component for it.
TEST(OffsetSlope, OfAStrangerIsTheGradientsLengthOrItsLargerComponent) {
  const Scene scene = suite_scene("polygon_offset/decals_z24");
  const Records<double> ours = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()}).records;
  const OffsetErrors offsets(scene);
  bool by_grid = false;
  const auto differing = [&](double share, double from_origin) {
    Records<double> theirs = ours;
    for (std::size_t i = 0; i < theirs.depth.size(); ++i) {
      const WindowTriangle<double>& t = theirs.triangles[theirs.covered[i].triangle];
      const double moved = share * (by_grid ? offsets.by_grid(t) : offsets.by_length(t));
      theirs.depth[i] = depth_in_format(scene.frame.depth, theirs.depth[i] + moved);
    }
    return compare_depth(scene, theirs, ours, 1, {}, from_origin).differing;
  };
  EXPECT_EQ(differing(0, 1), 0u);
  EXPECT_EQ(differing(1, 1), 0u);
  EXPECT_GT(differing(1, 0), 100u) << "ours is the larger component";
  EXPECT_GT(differing(2, 1), 100u);
  EXPECT_GT(differing(-1, 1), 100u);
  by_grid = true;  // of the plane through the snapped corners
  EXPECT_EQ(differing(1, 1), 0u);
  EXPECT_GT(differing(1, 0), 0u);
  EXPECT_GT(differing(60, 1), 0u);
}

// Tolerances of two legal depths: 1 step of the background, whose rounding no convention says, 0.501 of a fragment that
// is rounded to the nearest code. The depth counts that is nearest in its own tolerance.
TEST(LegalDepths, ADepthIsComparedWithTheAnswerThatAllowsIt) {
  Scene scene;
  scene.frame.width = scene.frame.height = 1;
  constexpr double kScale = 16777215, kCode = 8388608;
  const auto compared = [&](double background, double fragment) {
    Planes planes;
    planes.depth = Plane<double>(1, 1, kCode / kScale);
    Legal legal;
    legal.certain = Plane<std::uint32_t>(1, 1, 0), legal.possible = Plane<std::uint32_t>(1, 1, 1);
    legal.first = {0, 2};
    legal.answers.resize(2);
    legal.answers[0].z_lo = legal.answers[0].z_hi = (kCode + background) / kScale;
    legal.answers[1].primitive = 0;
    legal.answers[1].z_lo = legal.answers[1].z_hi = (kCode + fragment) / kScale;
    return compare_legal_depth(scene, planes, legal, 0.501,
                               {.has_codes = true, .rounding = Conventions::Rounding::nearest});
  };
  EXPECT_TRUE(passes(compared(-0.7, -0.61)));
  EXPECT_TRUE(passes(compared(1.2, 0.4)));
  EXPECT_TRUE(fails(compared(-1.2, -0.61)));
}

// A clear depth of 0.7 is 45874.5 codes of 16 bits: either is legal beneath a winner that leaves no depth.
TEST(LegalDepths, TheClearedOneBeneathAWinnerMayBeEitherCode) {
  Scene scene;
  scene.frame.width = scene.frame.height = 1;
  scene.frame.depth = DepthFormat::z16;
  scene.frame.clear_depth = 0.7f;
  const auto compared = [&](double code) {
    Planes planes;
    planes.depth = Plane<double>(1, 1, code / 65535);
    Legal legal;
    legal.certain = legal.possible = Plane<std::uint32_t>(1, 1, 1);
    legal.first = {0, 1};
    legal.answers = {LegalFold(scene.frame).winners().front()};
    legal.answers[0].primitive = 0;
    return compare_legal_depth(scene, planes, legal, 0.501,
                               {.has_codes = true, .rounding = Conventions::Rounding::nearest});
  };
  EXPECT_TRUE(passes(compared(45874)));
  EXPECT_TRUE(passes(compared(45875)));
  EXPECT_TRUE(fails(compared(45877)));
}

// Draws that write no depth, over a clear depth half way between two codes: the candidate has the other code
// throughout, but for one pixel.
TEST(LegalDepths, AClearDepthBeneathDrawsWithoutDepthIsOfOneCode) {
  Scene scene = suite_scene("depth/clear_on_half");
  for (Draw& draw : scene.draws) draw.merge.depth_mask = false;
  Capture mine = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
  const double scale = depth_scale(scene.frame.depth), code = scene.frame.clear_depth * scale;
  auto& depth = mine.planes.depth.values();
  const double other = (depth[0] == std::floor(code) / scale ? std::ceil(code) : std::floor(code)) / scale,
               own = depth[0];
  ASSERT_NE(other, own);
  const auto judged = [&] { return row_of_stage(scene, mine, Stage::merge, {}).outcome; };
  std::ranges::fill(depth, other);
  EXPECT_NE(judged(), Outcome::different);
  const auto drawn = std::ranges::find_if(mine.planes.id.values(), [](std::int32_t id) { return id != kBackground; });
  ASSERT_NE(drawn, mine.planes.id.values().end());
  depth[static_cast<std::size_t>(drawn - mine.planes.id.values().begin())] = own;
  EXPECT_EQ(judged(), Outcome::different);
}

// A buffer of float from 1 to 0 rounds 1 - 0.1: the clear depth in window space is 0.1, or 1 minus the rounded
// difference, and no other.
TEST(LegalDepths, AClearDepthInFloatIsRoundedInTheDeclaredRange) {
  using Range = Conventions::DepthRange;
  Scene scene = suite_scene("depth/interpenetrating");
  scene.frame.depth = DepthFormat::z32f, scene.frame.clear_depth = 0.1F;
  for (Draw& draw : scene.draws) draw.depth_func = DepthFunc::always;
  const Capture right = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
  const auto judged = [&](double cleared, Range range) {
    Capture mine = right;
    for (std::size_t i = 0; i < mine.planes.id.size(); ++i)
      if (mine.planes.id.values()[i] == kBackground) mine.planes.depth.values()[i] = cleared;
    Conventions conventions;
    conventions.depth_range = range;
    return row_of_stage(scene, mine, Stage::merge, conventions).outcome;
  };
  const double clear = 0.1F, rounded = rounded_in_range(Range::one_to_zero, clear);
  ASSERT_NE(rounded, clear);
  EXPECT_NE(judged(clear, Range::one_to_zero), Outcome::different);
  EXPECT_NE(judged(rounded, Range::one_to_zero), Outcome::different);
  EXPECT_EQ(judged(rounded, Range::zero_to_one), Outcome::different);
  EXPECT_EQ(judged(2 * rounded - clear, Range::one_to_zero), Outcome::different);
}

// Codes of 16 bits are held to their declared rounding though depths are interpolated in float; of 24 bits they are
// not.
TEST(LegalDepths, OfFewBitsAreHeldToTheirRoundingInAnyArithmetic) {
  using As = Conventions::Depth;
  const auto outcome = [](DepthFormat format, Conventions::Rounding declared, double off, As of_all = As::as_asked,
                          StencilFormat stencil = StencilFormat::none) {
    Scene scene = suite_scene("depth/interpenetrating");
    scene.frame.depth = format, scene.frame.stencil = stencil;
    const auto exact = exact::make_exact();
    const Capture expected = exact->capture(scene, {.records = StageSet::all(), .legal = true});
    Capture mine;
    mine.width = expected.width, mine.height = expected.height;
    mine.planes.depth = expected.planes.depth;
    const double scale = depth_scale(format);
    for (std::size_t i = 0; i < mine.planes.depth.size(); ++i) {
      double& z = mine.planes.depth.values()[i];
      const LegalAnswer& answer = expected.legal.answers.at(expected.legal.first.at(i));
      if (answer.primitive != kBackground) z = std::floor((answer.z_lo + answer.z_hi) / 2 * scale + off) / scale;
    }
    Conventions conventions;
    conventions.depth_arithmetic = Conventions::DepthArithmetic::in_float;
    conventions.depth_rounding = declared;
    conventions.depth_format = of_all;
    const auto judge = [&](const SceneJudgement& c, Renderer&) {
      compare_with_legal(c, expected.legal, Stage::depth, "exact");
    };
    return row_of(scene, mine, conventions, judge).outcome;
  };
  using enum Conventions::Rounding;
  EXPECT_NE(outcome(DepthFormat::z16, nearest, 0.5), Outcome::different);
  EXPECT_EQ(outcome(DepthFormat::z16, nearest, 0), Outcome::different);
  EXPECT_NE(outcome(DepthFormat::z16, down, 0), Outcome::different);
  EXPECT_EQ(outcome(DepthFormat::z16, down, 0.5), Outcome::different);
  EXPECT_NE(outcome(DepthFormat::z24, nearest, 0), Outcome::different);
  EXPECT_NE(outcome(DepthFormat::z16, nearest, 0.5, As::z16), Outcome::different) << "a renderer of 16 bits alone";
  EXPECT_EQ(outcome(DepthFormat::z16, nearest, 0, As::z16), Outcome::different);
  EXPECT_NE(outcome(DepthFormat::z16, nearest, 0.5, As::z16, StencilFormat::s8), Outcome::different);
  EXPECT_EQ(outcome(DepthFormat::z16, nearest, 0, As::z16, StencilFormat::s8), Outcome::different);
  EXPECT_NE(outcome(DepthFormat::z16, nearest, 0, As::as_asked, StencilFormat::s8), Outcome::different)
      << "codes of 16 bits made of codes of 24";
}

// Beside the cut by the near plane of [0,w], snapping turns a piece over, whose plane goes through snapped corners: the
// C renderer of tests/renderers comes to the end of the depth range there.
TEST(LegalDepths, BesideACutMayGoThroughSnappedCorners) {
  const Scene scene = suite_scene("depth_range/halves_z16");
  Conventions conventions;
  conventions.clip_depth = Conventions::ClipDepth::zero_to_w;
  conventions.depth_corners = Conventions::DepthCorners::as_they_are;
  const auto exact = exact::make_exact();
  const Legal legal = exact->capture(scene, {.legal = true, .conventions = conventions}).legal;
  double farthest = 0;
  for (const LegalAnswer& answer : legal.at(8, 34)) farthest = answer.primitive == 25 ? answer.z_hi : farthest;
  EXPECT_GE(farthest, 0.25 - 1e-9);
}

}  // namespace
}  // namespace plumbline::check
