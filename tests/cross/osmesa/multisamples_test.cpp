// OSMesa's multisampling: the behaviour that our passes rely on.
#include <random>

#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "renderers/pipeline_renderer.h"
#include "scene/antialias.h"
#include "tests/pipeline/window_scene.h"

namespace plumbline {
namespace {

constexpr int kSize = 64;

// Triangles of one colour each, tilted in depth, over each other.
Scene soup(int triangles, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](int most) { return static_cast<float>(random() % static_cast<unsigned>(most)); };
  std::vector<test::ThreeCorners> out;
  for (int i = 0; i < triangles; ++i) {
    const auto p = [&] { return glm::vec3(number(kSize * 97) / 97, number(kSize * 89) / 89, number(1000) / 1001); };
    out.push_back({p(), p(), p()});
  }
  Scene scene = test::window_scene(kSize, kSize, out);
  Mesh& mesh = scene.meshes[0];
  for (int i = 0; i < triangles; ++i) {
    const glm::vec4 color(number(256) / 255, number(256) / 255, number(256) / 255, number(256) / 255);
    mesh.colors.insert(mesh.colors.end(), 3, color);
  }
  scene.frame.antialias.kind = Antialias::Kind::multisample;
  return scene;
}

TEST(OsmesaMultisamples, EachSampleIsCoveredAsOurPassSays) {
  const Scene scene = soup(60, 1);
  const auto osmesa = make_opengl();
  const auto ours = pipeline::make_pipeline();
  std::size_t covered = 0;
  for (const Scene& pass : passes_of(scene)) {
    const Planes theirs = osmesa->capture(pass, {}).planes, mine = ours->capture(pass, {}).planes;
    EXPECT_EQ(theirs.count.values(), mine.count.values());
    EXPECT_EQ(theirs.id_sum.values(), mine.id_sum.values());
    EXPECT_EQ(theirs.id.values(), mine.id.values());
    for (const std::uint32_t n : mine.count.values()) covered += n;
  }
  EXPECT_GT(covered, 10000u);
}

TEST(OsmesaMultisamples, TheResolvedColourIsOursAndHalvesGoBothWays) {
  int up = 0, down = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Scene scene = soup(40, seed);
    const Capture theirs = make_opengl()->capture(scene, {}), mine = pipeline::make_pipeline()->capture(scene, {});
    EXPECT_EQ(theirs.planes.color.values(), mine.planes.color.values()) << seed;
    for (std::size_t i = 0; i < theirs.planes.color.size(); ++i) {
      for (int c = 0; c < 4; ++c) {
        int sum = 0;
        for (const auto& sample : theirs.samples) sum += static_cast<int>(std::lround(255 * sample.values()[i][c]));
        if (sum % 4 != 2) continue;
        (std::lround(255 * theirs.planes.color.values()[i][c]) == sum / 4 ? down : up) += 1;
      }
    }
  }
  EXPECT_GT(up, 100);
  EXPECT_GT(down, 100) << "neither up nor to even: a matter of the sum's order";
}

// Mesa's blit turns 24-bit depths into floats and back: a code more at most. Our reading undoes the first step.
TEST(OsmesaMultisamples, TheResolvedDepthIsSampleZeros) {
  for (const DepthFormat format : {DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f}) {
    Scene scene = soup(30, 3);
    scene.frame.depth = format;
    scene.frame.clear_depth = 0.7;
    const auto osmesa = make_opengl();
    const Plane<double> resolved = osmesa->capture(scene, {}).planes.depth;
    const Plane<double> sample = osmesa->capture(passes_of(scene)[0], {}).planes.depth;
    const double within = format == DepthFormat::z24 ? 1.001 / 16777215 : 0;
    int apart = 0;
    for (std::size_t i = 0; i < resolved.size(); ++i) {
      ASSERT_LE(std::abs(resolved.values()[i] - sample.values()[i]), within);
      apart += resolved.values()[i] != sample.values()[i] ? 1 : 0;
    }
    EXPECT_EQ(apart > 0, format == DepthFormat::z24);
  }
}

// A pixel beside the box has samples in its far half: the scissor test is the pixel's (OpenGL 2.1, section 4.1.2), but
// llvmpipe draws those to the left of a box and below it. A Mesa that no longer does has one dispute less.
TEST(OsmesaMultisamples, AScissorBoxIsHalfAPixelTooWide) {
  Scene scene = test::window_scene(8, 8, {{{-99, -99, 0.5}, {99, -99, 0.5}, {0, 99, 0.5}}});
  scene.draws[0].scissor = Scissor{2, 3, 4, 2};
  scene.frame.antialias.kind = Antialias::Kind::multisample;
  const auto passes = passes_of(scene);
  const auto count = [](const Scene& pass, Renderer& renderer) {
    std::size_t n = 0;
    const Planes drawn = renderer.capture(pass, {}).planes;
    for (const std::uint32_t c : drawn.count.values()) n += c;
    return n;
  };
  const auto osmesa = make_opengl();
  const auto ours = pipeline::make_pipeline();
  const std::size_t expected[] = {8, 10, 12, 15};  // 4 x 2; a column more, a row more, both
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(count(passes[i], *ours), 8u);
    EXPECT_EQ(count(passes[i], *osmesa), expected[i]) << i;
  }
}

}  // namespace
}  // namespace plumbline
