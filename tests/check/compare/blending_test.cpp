// A stranger's blending in float frames: a few roundings a layer, and no more.
#include "check/compare/blending.h"

#include <cmath>

#include "check/compare/compare_planes.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// Two fragments at pixel (1, 0) of a black frame of 2 x 1 pixels, which is blended.
struct TwoLayers : testing::Test {
  TwoLayers() {
    scene.frame.width = 2;
    scene.frame.height = 1;
    scene.frame.color = ColorFormat::rgba32f;
    scene.frame.clear_color = glm::vec4(0, 0, 0, 1);
    scene.meshes.resize(1);
    scene.meshes[0].positions.resize(3);
    scene.meshes[0].triangles.emplace_back(0, 1, 2);
    scene.draws.resize(1);
    scene.draws[0].merge.blend = Blend{};
    blend_by(BlendFactor::one, BlendFactor::one);
    records.triangles.resize(2);
    for (std::uint32_t t : {0u, 1u}) {
      records.covered.push_back({t, 1, 0});
      records.drawn.push_back({true});
      records.shaded.push_back({{0.5, 2, 0, 1}});
    }
  }
  void blend_by(BlendFactor source, BlendFactor destination) {
    Blend& blend = *scene.draws[0].merge.blend;
    blend.rgb = blend.alpha = {source, destination, BlendEquation::add};
  }
  double roundings() const { return blending_roundings(scene, records)(1, 0); }
  Scene scene;
  Records<double> records;
};

// Four roundings of 3 (a held 1 and a 2), then of 5.
TEST_F(TwoLayers, RoundFourTimesEach) {
  EXPECT_EQ(blending_roundings(scene, records)(0, 0), 0);
  EXPECT_EQ(roundings(), 4 * 3 + 4 * 5);
  records.drawn[0].drawn = false;
  EXPECT_EQ(roundings(), 4 * 3);
  scene.draws[0].merge.blend.reset();
  EXPECT_EQ(roundings(), 0) << "a colour that replaces is not rounded";
}

TEST_F(TwoLayers, LetThroughWhatTheirFactorsDo) {
  blend_by(BlendFactor::source_alpha, BlendFactor::one_minus_source_alpha);
  EXPECT_EQ(roundings(), 4 * (2 + 2)) << "d + a (s - d) of 2 and 2; an alpha of 1 hides the first layer's error";
  blend_by(BlendFactor::destination_color, BlendFactor::zero);  // 2 x 1, then 2 x 2
  EXPECT_EQ(roundings(), 4 * 2 * 2 + 4 * 4) << "the product doubles the error, too";
  blend_by(BlendFactor::zero, BlendFactor::destination_color);  // held x held
  EXPECT_EQ(roundings(), 4 * 1 * 2 + 4 * 1);
  scene.draws[0].merge.blend->rgb.equation = scene.draws[0].merge.blend->alpha.equation = BlendEquation::max;
  EXPECT_EQ(roundings(), 0);
}

TEST_F(TwoLayers, ReplaceErrorsWithTheColor) {
  records.shaded[1].color = {0.1, 0, 0, 1};
  scene.meshes[0].triangles.emplace_back(0, 1, 2);
  scene.draws.push_back(scene.draws[0]);
  scene.meshes.push_back(scene.meshes[0]);
  scene.draws[1].mesh = 1, records.triangles[1].primitive = 2;
  const auto second = [&]() -> Merge& { return scene.draws[1].merge; };
  EXPECT_EQ(roundings(), 4 * 3 + 4 * 4);
  second().logic_op = LogicOp::copy;
  EXPECT_EQ(roundings(), 0) << "the logic op takes the place of the blend";
  second().logic_op.reset(), second().blend.reset();
  EXPECT_EQ(roundings(), 0);
  second().color_mask.g = false;
  EXPECT_EQ(roundings(), 4 * 3) << "a masked channel keeps its error";
}

TEST_F(TwoLayers, TakeConstantsAndSaturatedAlphas) {
  records.drawn[1].drawn = false;
  scene.draws[0].merge.blend->color = glm::vec4(0.25f, -3, 0, 0.5f);
  blend_by(BlendFactor::constant_color, BlendFactor::zero);
  EXPECT_EQ(roundings(), 4 * 2 * 3) << "of the largest constant";
  blend_by(BlendFactor::zero, BlendFactor::one_minus_constant_alpha);
  EXPECT_EQ(roundings(), 4 * 0.5);
  blend_by(BlendFactor::source_alpha_saturate, BlendFactor::zero);
  EXPECT_EQ(roundings(), 4 * 2 * 2) << "1 - Ad is at most 2";
}

// Products of colours beyond 1: c1 (c2 clear), rounded as a renderer in float rounds them.
TEST_F(TwoLayers, HoldForProductsOfLargeColors) {
  blend_by(BlendFactor::destination_color, BlendFactor::zero);
  scene.frame.clear_color = glm::vec4(0.7f);
  double most = 0;
  for (float c = 90; c < 99; c += 0.37f) {
    for (auto& shaded : records.shaded) shaded.color = Vec4<double>(c);
    const float in_float = c * (c * 0.7f);
    const double exact = static_cast<double>(c) * (static_cast<double>(c) * static_cast<double>(0.7f)),
                 off = std::abs(static_cast<double>(in_float) - exact) / kU;
    most = std::max(most, off);
    EXPECT_LE(off, roundings()) << c;
  }
  EXPECT_GT(most, 4 * 3 * (1 + 2 * 97)) << "more than colours of at most 1 may have";
}

// An alpha far above 1: s a + d (1 - a), and the same as d + a (s - d), rounded as a renderer in float rounds them.
TEST_F(TwoLayers, HoldForMixesBeyondTheirColors) {
  records.drawn[1].drawn = false;
  blend_by(BlendFactor::source_alpha, BlendFactor::one_minus_source_alpha);
  double most = 0;
  for (float a = 1.25f; a < 110; a *= 1.37f) {
    const glm::vec4 s(37.3f, 0.41f, 12.7f, a), d(0.7f, 0.3f, 0.1f, 1);
    scene.frame.clear_color = d;
    records.shaded[0].color = s;
    for (int k = 0; k < 3; ++k) {
      const double exact =
          static_cast<double>(s[k]) * static_cast<double>(a) + static_cast<double>(d[k]) * (1 - static_cast<double>(a));
      const float sum = s[k] * a + d[k] * (1 - a), mix = d[k] + a * (s[k] - d[k]);
      for (const float in_float : {sum, mix}) {
        const double off = std::abs(static_cast<double>(in_float) - exact) / kU;
        most = std::max(most, off / roundings());
        EXPECT_LE(off, roundings()) << a;
      }
    }
  }
  EXPECT_GT(most, 0.1);
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
  EXPECT_EQ(differing(1, 30), 0u);
  EXPECT_EQ(differing(1, 34), 1u);
  EXPECT_EQ(differing(0, 2), 1u) << "nothing is drawn";
  EXPECT_EQ(differing(1, NAN), 1u);
}

}  // namespace
}  // namespace plumbline::check
