// A stranger's blending in float frames: a few roundings a layer, and no more.
#include "check/compare/blending.h"

#include <cmath>

#include "check/compare/compare_planes.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// Two fragments at pixel (1, 0) of a frame of 2 x 1 pixels, blended.
struct TwoLayers : testing::Test {
  TwoLayers() {
    scene.frame.width = 2;
    scene.frame.height = 1;
    scene.frame.color = ColorFormat::rgba32f;
    scene.draws.resize(1);
    scene.draws[0].merge.blend = Blend{};
    records.triangles.resize(2);
    for (std::uint32_t t : {0u, 1u}) {
      records.covered.push_back({t, 1, 0});
      records.drawn.push_back({true});
      records.shaded.push_back({{0.5, 2, 0, 1}});
    }
  }
  Scene scene;
  Records<double> records;
};

TEST_F(TwoLayers, RoundFourTimesEach) {
  EXPECT_EQ(blending_roundings(scene, records)(0, 0), 0);
  EXPECT_EQ(blending_roundings(scene, records)(1, 0), 4 * 2 * (1 + 2 + 2)) << "of the clear colour and both layers";
  scene.draws[0].merge.blend->rgb.destination = BlendFactor::destination_color;
  EXPECT_EQ(blending_roundings(scene, records)(1, 0), 4 * 3 * 5) << "an error of the frame counts twice";
  records.drawn[0].drawn = false;
  EXPECT_EQ(blending_roundings(scene, records)(1, 0), 4 * 1 * 3);
}

TEST_F(TwoLayers, AreHeldToTheirRoundings) {
  const Plane<double> roundings = blending_roundings(scene, records);
  Planes exact, mine;
  exact.color = Plane<glm::vec4>(2, 1, glm::vec4(1));
  const auto differing = [&](int x, double by) {
    mine.color = exact.color;
    mine.color(x, 0).g += static_cast<float>(by * kU);
    return compare_merge(scene, mine, exact, 1, {}, {}, roundings).differing;
  };
  EXPECT_EQ(differing(1, 38), 0u);
  EXPECT_EQ(differing(1, 42), 1u);
  EXPECT_EQ(differing(0, 2), 1u) << "nothing is drawn";
  EXPECT_EQ(differing(1, NAN), 1u);
}

}  // namespace
}  // namespace plumbline::check
