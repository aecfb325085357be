// Exact's stage 2 by hand: light_cases.h.
#include "tests/pipeline/light_cases.h"

#include <gtest/gtest.h>

#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

TEST(ExactLightCases, ByHand) {
  for (const test::LightCase& of : test::light_cases()) {
    const Scene scene = test::scene_of(of);
    Records<double> in;
    in.vertices.assign(3, {glm::dvec4(of.p_eye, 1), {}, of.n_eye});
    const glm::dvec4 color = run(scene, Stage::light, in).records.lit.at(0).color;
    EXPECT_NEAR(color.r, of.red, 1e-7) << of.name;  // colours and shininess are floats
    EXPECT_NEAR(color.a, of.alpha, 1e-12) << of.name;
  }
}

}  // namespace
}  // namespace plumbline
