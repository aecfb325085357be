// Depths of renderers that interpolate 1/w, legal to the oracle and to the judge of records.
#include <array>

#include <gtest/gtest.h>

#include "capture/float_depth.h"
#include "check/compare/compare_records.h"
#include "reference/arithmetic/matrices.h"
#include "reference/exact/exact.h"
#include "tests/oracle/window_answers.h"

namespace plumbline::math {
namespace {

using C = Conventions;

C declared(C::DepthArithmetic arithmetic, C::DepthOf number) {
  C out;
  out.depth_arithmetic = arithmetic, out.depth_of = number;
  return out;
}

// One triangle between a near plane at 1/2 and a far one 1/512 of that behind it: z = 513 - 256.5 / w.
Scene steep(float beyond = 0) {
  Scene scene =
      window_scene({{glm::vec3(-0.3f, -0.4f, 0.5002f), {0.41f, -0.3f, 0.5003f}, {0.1f, 0.42f + beyond, 0.5001f}}});
  scene.projection = Perspective{90, 0.5, 0.5 + 0x1p-10};
  scene.frame.depth = DepthFormat::z32f;
  return scene;
}
constexpr double kOfZero = 513;

TEST(DepthOfInvW, HasAnOriginInEachProjection) {
  using enum C::ClipDepth;
  const auto of = [](const Scene& scene, C::ClipDepth volume) {
    return z_view_of_zero(double_matrices(scene, scene.draws[0]).projection, volume);
  };
  EXPECT_NEAR(of(steep(), minus_w_to_w).value(), kOfZero, 1e-9);
  EXPECT_NEAR(of(steep(), zero_to_w).value(), 2 * kOfZero - 1, 1e-9);
  Scene level = steep();
  level.projection = Orthographic{-1, 1, -1, 1, 100, 104};
  EXPECT_NEAR(of(level, minus_w_to_w).value(), -25, 1e-9) << "a distance of 0";
  Scene by_plane = steep();
  by_plane.dialect = Dialect::gzrender;
  by_plane.projection = ViewPlane{60};
  EXPECT_TRUE(of(by_plane, minus_w_to_w).has_value());
  glm::dmat4 skewed = double_matrices(steep(), steep().draws[0]).projection;
  skewed[0][2] = 0.125;
  EXPECT_FALSE(z_view_of_zero(skewed, minus_w_to_w).has_value()) << "z_ndc depends on more than 1/w";
}

// Slack of depths to either side, which a renderer of window z does not have.
TEST(DepthOfInvW, WidensLegalDepths) {
  using enum C::DepthArithmetic;
  const auto width = [](const Scene& scene, const C& conventions) {
    const LegalAnswer last = legal(scene, conventions).at(18, 17).back();
    EXPECT_EQ(last.primitive, 0);
    return last.z_hi - last.z_lo;
  };
  for (const float beyond : {0.0f, 3.0f}) {
    const Scene scene = steep(beyond);
    const double of_double = width(scene, declared(in_double, C::DepthOf::inv_w)),
                 by_z = width(scene, declared(in_float, C::DepthOf::z)),
                 by_inv_w = width(scene, declared(in_float, C::DepthOf::inv_w));
    EXPECT_LT(by_z - of_double, 1e-5) << beyond;
    EXPECT_GT(by_inv_w - of_double, 2 * 4 * kOfZero * 0x1p-24) << beyond << ": 4 u of 513 at least, to either side";
    EXPECT_LT(by_inv_w - of_double, 1e-2) << beyond;
  }
}

TEST(DepthOfInvW, IsDeclaredForRecords) {
  using enum C::DepthArithmetic;
  const Scene scene = steep();
  Request all;
  all.records = StageSet::all();
  const Capture exact = exact::make_exact()->capture(scene, all);
  ASSERT_GT(exact.records.depth.size(), 20u);
  const auto differing = [&](double by, const C& conventions) {
    Records<double> moved = exact.records;
    for (double& z : moved.depth) z += by;
    return check::compare_depth(scene, moved, exact.records, 0.501, conventions, 4).differing;
  };
  constexpr double kStepOfInvW = 256.5 * 0x1p-23;  // window z
  EXPECT_GT(differing(kStepOfInvW, declared(in_float, C::DepthOf::z)), 0u);
  EXPECT_EQ(differing(kStepOfInvW, declared(in_float, C::DepthOf::inv_w)), 0u);
  EXPECT_GT(differing(100 * kStepOfInvW, declared(in_float, C::DepthOf::inv_w)), 0u);
  EXPECT_EQ(differing(kStepOfInvW, declared(in_double, C::DepthOf::inv_w)), 0u) << "kept in a float";
  EXPECT_GT(differing(100 * kStepOfInvW, declared(in_double, C::DepthOf::inv_w)), 0u);
}

}  // namespace
}  // namespace plumbline::math
