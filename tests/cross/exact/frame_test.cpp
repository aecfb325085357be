// Stages 10 and 11 of the exact reference.
#include <gtest/gtest.h>

#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

constexpr std::array<DepthFunc, 8> kFuncs = {DepthFunc::never,         DepthFunc::less,    DepthFunc::equal,
                                             DepthFunc::less_equal,    DepthFunc::greater, DepthFunc::not_equal,
                                             DepthFunc::greater_equal, DepthFunc::always};

/// A fragment per depth at pixel (1, 0), one per primitive in turn; primitive i belongs to draw i.
Records<double> stack(std::initializer_list<double> depths) {
  Records<double> r;
  for (double z : depths) {
    const auto i = static_cast<std::uint32_t>(r.triangles.size());
    r.triangles.push_back(snapped_triangle({}, i));
    r.covered.push_back({i, 1, 0});
    r.depth.push_back(z);
    r.shaded.push_back({glm::dvec4(i + 1, 0, -1, 0.3)});
  }
  return r;
}

std::int32_t winner(const Scene& scene, const Records<double>& records) {
  const auto id = run(scene, Stage::visibility, records).planes.id;
  EXPECT_EQ(id(0, 0), kBackground);
  return id(1, 0);
}

TEST(ExactVisibility, EachDepthFunction) {
  // Rows in kFuncs' order: whether a fragment nearer than, equal to, farther than the stored one passes.
  constexpr std::array<std::array<bool, 3>, 8> kPasses = {{{false, false, false},
                                                           {true, false, false},
                                                           {false, true, false},
                                                           {true, true, false},
                                                           {false, false, true},
                                                           {true, false, true},
                                                           {false, true, true},
                                                           {true, true, true}}};
  for (std::size_t f = 0; f < 8; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Scene scene = scene_of(2, 1, 1, {DepthFunc::always, kFuncs[f]});
      const std::array<double, 3> incoming = {0.4, 0.5, 0.6};
      EXPECT_EQ(winner(scene, stack({0.5, incoming[k]})), kPasses[f][k] ? 1 : 0) << "function " << f << ", case " << k;
    }
}

TEST(ExactVisibility, FoldsInDrawOrderAgainstTheClearedDepth) {
  Scene scene = scene_of(2, 1, 1, {DepthFunc::less, DepthFunc::less, DepthFunc::greater, DepthFunc::less});
  EXPECT_EQ(winner(scene, stack({0.7, 0.5, 0.4, 0.6})), 1);
  EXPECT_EQ(winner(scene, stack({0.7, 0.5, 0.6, 0.55})), 3);
  EXPECT_EQ(winner(scene, stack({1.0})), kBackground) << "the far plane is not less than the cleared depth";
  scene.frame.clear_depth = 0.3;
  EXPECT_EQ(winner(scene, stack({0.7, 0.5})), kBackground);
  EXPECT_EQ(winner(scene, stack({0.7, 0.5, 0.4})), 2);
}

TEST(ExactVisibility, ComparesCodesOfTheFormat) {
  Scene scene = scene_of(2, 1, 1, {DepthFunc::always, DepthFunc::equal});
  const auto equal = [&](DepthFormat format, double a, double b) {
    scene.frame.depth = format;
    return winner(scene, stack({a, b})) == 1;
  };
  EXPECT_TRUE(equal(DepthFormat::z8, 99.6 / 255, 100.4 / 255));
  EXPECT_TRUE(equal(DepthFormat::z8, 100.5 / 255, 101.0 / 255)) << "half up, as int(z + .5)";
  EXPECT_FALSE(equal(DepthFormat::z8, 100.5 / 255, 100.0 / 255));
  EXPECT_FALSE(equal(DepthFormat::z16, 99.6 / 255, 100.4 / 255));
  EXPECT_TRUE(equal(DepthFormat::z16, 1000.6 / 65535, 1001.4 / 65535));
  EXPECT_FALSE(equal(DepthFormat::z16, 1000.4 / 65535, 1000.6 / 65535));
  EXPECT_FALSE(equal(DepthFormat::z24, 1000.6 / 65535, 1001.4 / 65535));
  EXPECT_TRUE(equal(DepthFormat::z24, 1000.6 / 16777215, 1001.4 / 16777215));
  EXPECT_FALSE(equal(DepthFormat::z32f, 1000.6 / 16777215, 1001.4 / 16777215));
  EXPECT_TRUE(equal(DepthFormat::z32f, 0.1, static_cast<double>(0.1f)));
}

TEST(ExactVisibility, TheClearedDepthIsInTheFormat) {
  Scene scene = scene_of(2, 1, 1, {DepthFunc::equal});
  scene.frame.clear_depth = 0.30001;
  scene.frame.depth = DepthFormat::z16;
  EXPECT_EQ(winner(scene, stack({19661.0 / 65535})), 0) << "the code is the nearest to 19661.16";
  EXPECT_EQ(winner(scene, stack({19662.0 / 65535})), kBackground);
  scene.frame.depth = DepthFormat::z32f;
  EXPECT_EQ(winner(scene, stack({static_cast<double>(0.30001f)})), 0);
}

TEST(ExactMerge, TheWinnersColourAndDepth) {
  Scene scene = scene_of(2, 1, 1, {DepthFunc::less, DepthFunc::less, DepthFunc::less});
  scene.frame.clear_color = {0.1f, 2, -1, 0.7f};
  scene.frame.clear_depth = 0.35;
  const Records<double> in = stack({0.5, 0.25, 0.4});
  const Capture rgba8 = run(scene, Stage::merge, in);
  // Clamped for rgba8, but no codes: 0.3 and 0.7 are none.
  EXPECT_EQ(rgba8.planes.color(1, 0), glm::vec4(1, 0, 0, 0.3f));
  EXPECT_EQ(rgba8.planes.color(0, 0), glm::vec4(0.1f, 1, 0, 0.7f));
  EXPECT_EQ(rgba8.planes.depth(1, 0), 4194304 / 16777215.0);
  EXPECT_EQ(rgba8.planes.depth(0, 0), 5872025 / 16777215.0) << "the code is the nearest to 5872025.25";

  scene.frame.color = ColorFormat::rgba12;
  scene.frame.depth = DepthFormat::z8;
  const Capture rgba12 = run(scene, Stage::merge, in);
  EXPECT_EQ(rgba12.planes.color(1, 0), glm::vec4(1, 0, 0, 0.3f)) << "clamped as well";
  EXPECT_EQ(rgba12.planes.depth(1, 0), 64 / 255.0) << "63.75";
  EXPECT_EQ(rgba12.planes.depth(0, 0), 89 / 255.0) << "89.25";
  scene.frame.clear_depth = 0.3;
  EXPECT_EQ(run(scene, Stage::merge, in).planes.depth(0, 0), 77 / 255.0) << "76.5";
  scene.frame.clear_depth = 0.35;

  scene.frame.color = ColorFormat::rgba32f;
  scene.frame.depth = DepthFormat::z32f;
  const Capture rgba32f = run(scene, Stage::merge, in);
  EXPECT_EQ(rgba32f.planes.color(1, 0), glm::vec4(2, 0, -1, 0.3f));
  EXPECT_EQ(rgba32f.planes.color(0, 0), glm::vec4(0.1f, 2, -1, 0.7f));
  EXPECT_EQ(rgba32f.planes.depth(1, 0), 0.25);
  EXPECT_EQ(rgba32f.planes.depth(0, 0), static_cast<double>(0.35f));
}

TEST(ExactMerge, HandsOutItsPlanesOnly) {
  const Records<double> in = stack({0.5});
  const Scene scene = scene_of(2, 1);
  const Capture merged = run(scene, Stage::merge, in), seen = run(scene, Stage::visibility, in);
  EXPECT_TRUE(merged.planes.id.empty());
  EXPECT_TRUE(merged.records.depth.empty());
  EXPECT_TRUE(seen.planes.color.empty());
  EXPECT_EQ(merged.renderer, "exact");
}

TEST(ExactMerge, RefusesRecordsThatDoNotFit) {
  const Scene scene = scene_of(2, 1);
  Records<double> in = stack({0.5});
  in.depth.clear();
  EXPECT_THROW(run(scene, Stage::visibility, in), std::invalid_argument);
  in = stack({0.5});
  in.shaded.clear();
  EXPECT_THROW(run(scene, Stage::merge, in), std::invalid_argument);
  in = stack({0.5});
  in.triangles[0].primitive = 1;
  EXPECT_THROW(run(scene, Stage::visibility, in), std::invalid_argument) << "the scene has one primitive";
}

}  // namespace
}  // namespace plumbline
