// Shaded colours beyond [0, 1], which a frame of codes cannot hold.
#include "check/compare/compare_records.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// A fragment of colour `value`, where (1.5, 0.5, -0.5, 1) is computed.
Measurement compared(ColorFormat format, double copies, const Vec4<double>& value) {
  Scene scene;
  scene.frame.color = format;
  Records<double> wanted;
  wanted.triangles = {triangle_of({{{2, 2, 0.25}, {8, 2, 0.5}, {2, 8, 0.75}}}, {1, 0.5, 0.25}, 0)};
  wanted.covered = {{0, 3, 3}};
  wanted.shaded = {{{1.5, 0.5, -0.5, 1}}};
  Records<double> candidate = wanted;
  candidate.shaded[0].color = value;
  return compare_shaded(scene, candidate, wanted, 0, copies);
}

TEST(ShadedBeyondOne, MayBeClampedByAForeignRendererWhereTheFrameHoldsCodes) {
  const Vec4<double> as_it_is(1.5, 0.5, -0.5, 1), clamped(1, 0.5, 0, 1);
  EXPECT_TRUE(passes(compared(ColorFormat::rgba8, 4, as_it_is)));
  EXPECT_TRUE(passes(compared(ColorFormat::rgba8, 4, clamped)));
  EXPECT_TRUE(fails(compared(ColorFormat::rgba8, 4, {1.25, 0.5, 0, 1})));
  EXPECT_TRUE(fails(compared(ColorFormat::rgba8, 4, {1, 0.5, -0.25, 1})));
  EXPECT_TRUE(fails(compared(ColorFormat::rgba8, 4, {1, 0.25, 0, 1})));
  EXPECT_TRUE(fails(compared(ColorFormat::rgba8, 4, {std::nan(""), 0.5, 0, 1})));
  EXPECT_TRUE(fails(compared(ColorFormat::rgba32f, 4, clamped)));
  EXPECT_TRUE(fails(compared(ColorFormat::rgba8, 0, clamped))) << "ours";
}

// No code shows a difference of half a float's step beside 1/2.
TEST(ShadedBelowCodes, MayBeZeroInAForeignRendererWhereTheFrameHoldsCodes) {
  const double unseen = kU / (2 * 255);
  const auto black = [](ColorFormat format, double copies, double expected, double value) {
    Records<double> wanted;
    wanted.triangles = {triangle_of({{{2, 2, 0.25}, {8, 2, 0.5}, {2, 8, 0.75}}}, {1, 0.5, 0.25}, 0)};
    wanted.covered = {{0, 3, 3}};
    wanted.shaded = {{{0.5, expected, 0, 1}}};
    Records<double> candidate = wanted;
    candidate.shaded[0].color.g = value;
    Scene scene;
    scene.frame.color = format;
    return compare_shaded(scene, candidate, wanted, 0, copies);
  };
  EXPECT_TRUE(passes(black(ColorFormat::rgba8, 4, 4e-17, 0)));
  EXPECT_TRUE(passes(black(ColorFormat::rgba8, 4, 0.99 * unseen, 0)));
  EXPECT_TRUE(fails(black(ColorFormat::rgba8, 4, 1.01 * unseen, 0)));
  EXPECT_TRUE(fails(black(ColorFormat::rgba16, 4, 0.99 * unseen, 0))) << "finer codes";
  EXPECT_TRUE(fails(black(ColorFormat::rgba32f, 4, 4e-17, 0)));
  EXPECT_TRUE(fails(black(ColorFormat::rgba8, 0, 4e-17, 0))) << "ours";
  EXPECT_TRUE(fails(black(ColorFormat::rgba8, 4, 4e-17, std::nan(""))));
}

}  // namespace
}  // namespace plumbline::check
