// Antialiasing: the passes of a scene, where each takes its values, and what is made of them.
#include "scene/antialias.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "pipeline/render.h"
#include "renderers/pipeline_renderer.h"
#include "tests/pipeline/window_scene.h"

namespace plumbline::pipeline {
namespace {

using Kind = Antialias::Kind;

TEST(Antialias, TheTablesAreMesasAndGzRenders) {
  const double samples[4][2] = {{.375, .125}, {.875, .375}, {.125, .625}, {.625, .875}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(kSamples[i].x / 256.0 + 0.5, samples[i][0]);
    EXPECT_EQ(kSamples[i].y / 256.0 + 0.5, samples[i][1]);
  }
  const double taps[6][3] = {{-.52, .38, .128},  {.41, .56, .119},  {.27, .08, .294},
                             {-.17, -.29, .249}, {.58, -.55, .104}, {-.31, -.71, .106}};
  int sum = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(kTaps[i].dx, taps[i][0]);
    EXPECT_EQ(kTaps[i].dy, taps[i][1]);
    EXPECT_EQ(kTaps[i].weight / 1000.0, taps[i][2]);
    sum += kTaps[i].weight;
  }
  EXPECT_EQ(sum, 1000) << "a picture of one colour keeps it";
}

TEST(Antialias, PassesAreScenesOfOneSample) {
  Scene scene = test::window_scene(10, 6, {{{0, 0, 0.5}, {10, 0, 0.5}, {0, 6, 0.5}}});
  scene.path = "a.json";
  scene.draws[0].scissor = Scissor{1, 2, 3, 4};
  ASSERT_EQ(passes_of(scene).size(), 1u);
  EXPECT_EQ(passes_of(scene)[0].path, "a.json") << "itself";

  scene.frame.antialias = {Kind::multisample, 1};
  auto passes = passes_of(scene);
  ASSERT_EQ(passes.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    const Scene& pass = passes[static_cast<std::size_t>(i)];
    EXPECT_EQ(pass.frame.antialias.kind, Kind::none);
    EXPECT_EQ(pass.frame.pass.sample, i);
    EXPECT_EQ(pass.frame.pass.shift, glm::dvec2(0));
    EXPECT_EQ(pass.path, "");
  }

  scene.frame.antialias = {Kind::supersample, 3};
  passes = passes_of(scene);
  ASSERT_EQ(passes.size(), 1u);
  EXPECT_EQ(passes[0].frame.width, 30);
  EXPECT_EQ(passes[0].frame.height, 18);
  const Scissor box = *passes[0].draws[0].scissor;
  EXPECT_EQ(glm::ivec4(box.x, box.y, box.width, box.height), glm::ivec4(3, 6, 9, 12));

  scene.frame.antialias = {Kind::taps, 1};
  passes = passes_of(scene);
  ASSERT_EQ(passes.size(), 6u);
  EXPECT_EQ(passes[0].frame.pass.shift, glm::dvec2(.52, -.38));
  EXPECT_EQ(passes[5].frame.pass.shift, glm::dvec2(.31, .71));
}

TEST(Antialias, SamplesOfAPixel) {
  EXPECT_EQ(samples_of({}).size(), 1u);
  EXPECT_EQ(samples_of({Kind::multisample, 1}).size(), 4u);
  EXPECT_EQ(samples_of({Kind::taps, 1})[2].weight, 294);
  const auto nine = samples_of({Kind::supersample, 3});
  ASSERT_EQ(nine.size(), 9u);
  EXPECT_EQ(nine[5].offset, glm::ivec2(2, 1));
  EXPECT_EQ(nine[5].pass, 0u);
}

// Red where covered, in the middle row of three: the share of each pixel's samples.
std::vector<double> shares(const Scene& scene) {
  const Frame frame = render(scene);
  std::vector<double> out;
  for (int x = 0; x < frame.color_rgba32f.width(); ++x) {
    out.push_back(static_cast<double>(frame.color_rgba32f(x, 1).r));
  }
  return out;
}

// Two rectangles that share the side x = 1.375, which runs through sample 0 of pixel 1.
TEST(Antialias, ASampleOnASideBelongsToOneOfTwo) {
  const auto rectangle = [](float left, float right) {
    return std::vector<test::ThreeCorners>{{{left, -9, 0.5}, {right, -9, 0.5}, {right, 9, 0.5}},
                                           {{left, -9, 0.5}, {right, 9, 0.5}, {left, 9, 0.5}}};
  };
  Scene right = test::window_scene(4, 3, rectangle(1.375f, 9)), left = test::window_scene(4, 3, rectangle(-9, 1.375f));
  for (Scene* scene : {&right, &left}) scene->frame.color = ColorFormat::rgba32f;
  EXPECT_EQ(shares(right), (std::vector<double>{0, 1, 1, 1})) << "the centre, 1.5, is to its right";
  for (Scene* scene : {&right, &left}) scene->frame.antialias = {Kind::multisample, 1};
  EXPECT_EQ(shares(right), (std::vector<double>{0, 0.75, 1, 1}));
  EXPECT_EQ(shares(left), (std::vector<double>{1, 0.25, 0, 0}));
  for (Scene* scene : {&right, &left}) scene->frame.antialias = {Kind::supersample, 8};  // the side between two columns
  EXPECT_EQ(shares(right), (std::vector<double>{0, 0.625, 1, 1}));
  EXPECT_EQ(shares(left), (std::vector<double>{1, 0.375, 0, 0}));
  for (Scene* scene : {&right, &left}) scene->frame.antialias = {Kind::taps, 1};
  // The side of tap i is at 1.375 - dx: it is left of the centre 1.5, and the pixel covered, where dx > -.125; of the
  // pixel to the left, where dx > .875; to the right all.
  EXPECT_FLOAT_EQ(static_cast<float>(shares(right)[1]), .119f + .294f + .104f);
  EXPECT_FLOAT_EQ(static_cast<float>(shares(left)[1]), .128f + .249f + .106f);
}

// z and red rise by 1/8 a pixel.
TEST(Antialias, DepthIsTheSamplesAndColourTheCentres) {
  Scene scene = test::window_scene(8, 8, {{{0, 0, 0}, {16, 0, 2}, {0, 16, 0}}});
  scene.frame.color = ColorFormat::rgba32f;
  scene.frame.depth = DepthFormat::z32f;
  scene.meshes[0].colors = {{0, 0, 0, 1}, {2, 0, 0, 1}, {0, 0, 0, 1}};
  scene.depth_clamp = true;
  scene.frame.antialias = {Kind::multisample, 1};
  const auto passes = passes_of(scene);
  for (std::size_t i = 0; i < 4; ++i) {
    const Frame frame = render(passes[i]);
    const double x = 3 + 0.5 + kSamples[i].x / 256.0;
    EXPECT_NEAR(static_cast<double>(frame.depth_z32f(3, 2)), x / 8, 1e-7) << i;
  }
  EXPECT_EQ(render(scene).depth_z32f(3, 2), render(passes[0]).depth_z32f(3, 2)) << "sample 0's";
}

TEST(Resolve, OfFourRoundsTheMeanOfFloats) {
  const PixelSamples samples = samples_of({Kind::multisample, 1});
  const auto mean = [&](std::vector<float> codes) { return mean_of_four(codes, samples, 255); };
  EXPECT_EQ(mean({0, 0, 0, 0}), 0);
  EXPECT_EQ(mean({255, 255, 255, 255}), 255);
  EXPECT_EQ(mean({0, 0, 0, 1}), 0) << "a quarter";
  EXPECT_EQ(mean({0, 1, 1, 1}), 1) << "three quarters";
  EXPECT_EQ(mean({255, 255, 0, 0}), 128) << "127.5, as llvmpipe has it";
  for (int i = 0; i < 256; ++i) {  // of equal codes, that code
    const auto code = static_cast<float>(i);
    ASSERT_EQ(mean({code, code, code, code}), code);
  }
  EXPECT_EQ(mean_of_four(std::vector<float>{0.5f, -1, 2, 0.25f}, samples, 0), 0.4375f) << "no codes: not clamped";
}

TEST(Resolve, OfWeightsIsExactButForOneRounding) {
  const PixelSamples taps = samples_of({Kind::taps, 1}), four = samples_of({Kind::supersample, 2});
  EXPECT_EQ(weighted_mean(std::vector<float>{1, 0, 0, 1}, four, 255), 1) << "halves up";
  EXPECT_EQ(weighted_mean(std::vector<float>{1, 0, 0, 0}, four, 255), 0);
  EXPECT_EQ(weighted_mean(std::vector<float>{7, 7, 7, 7, 7, 7}, taps, 4095), 7);
  // 500 of 1000: .294 + .106 + .1 would be needed; .128 + .119 + .249 = .496 is below a half, with .294 for .249 above.
  EXPECT_EQ(weighted_mean(std::vector<float>{1, 1, 0, 1, 0, 0}, taps, 255), 0);
  EXPECT_EQ(weighted_mean(std::vector<float>{1, 1, 1, 0, 0, 0}, taps, 255), 1);
  EXPECT_EQ(weighted_mean(std::vector<float>{1, 0, 0, 0, 0, 0}, taps, 0), 0.128f);
}

TEST(Antialias, SupersampledByOneIsNotAntialiased) {
  Scene scene = test::window_scene(9, 7, {{{0.3f, 0.2f, 0.1f}, {8.1f, 1.9f, 0.9f}, {2.2f, 6.6f, 0.4f}}});
  const Frame plain = render(scene);
  scene.frame.antialias = {Kind::supersample, 1};
  const Frame one = render(scene);
  EXPECT_EQ(one.color_rgba8.values(), plain.color_rgba8.values());
  EXPECT_EQ(one.depth_code.values(), plain.depth_code.values());
}

TEST(Antialias, ItsBytesAreThoseOfALargestPassAndAllSamples) {
  Scene scene = test::window_scene(100, 50, {});
  const std::size_t plain = plane_bytes(scene), color = 100 * 50 * sizeof(glm::vec4);
  scene.frame.antialias = {Kind::supersample, 4};
  EXPECT_EQ(plane_bytes(scene), 16 * plain + 17 * color);
  EXPECT_EQ(plane_bytes(passes_of(scene)[0]), 16 * plain);
  scene.frame.antialias = {Kind::taps, 1};
  EXPECT_EQ(plane_bytes(scene), plain + 7 * color);
}

TEST(Antialias, ItsCaptureHoldsTheSamplesAndRunsTheStageAlone) {
  for (const ColorFormat color : {ColorFormat::rgba8, ColorFormat::rgba12, ColorFormat::rgba32f}) {
    Scene scene = test::window_scene(9, 7, {{{0.3f, 0.2f, 0.1f}, {8.1f, 1.9f, 0.9f}, {2.2f, 6.6f, 0.4f}}});
    scene.frame.color = color;
    for (const Antialias& antialias : {Antialias{Kind::multisample, 1}, {Kind::supersample, 3}, {Kind::taps, 1}}) {
      scene.frame.antialias = antialias;
      const auto ours = make_pipeline();
      Capture drawn = ours->capture(scene, {});
      ASSERT_EQ(drawn.samples.size(), passes_of(scene).size());
      EXPECT_TRUE(drawn.planes.id.empty()) << "the passes'";
      const Capture made = ours->run_stage(scene, Stage::resolve, drawn);
      EXPECT_EQ(made.planes.color.values(), drawn.planes.color.values());
      drawn.samples.pop_back();
      EXPECT_THROW(ours->run_stage(scene, Stage::resolve, drawn), std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace plumbline::pipeline
