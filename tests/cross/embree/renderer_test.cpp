// The Embree renderer: what it shows, what it refuses, and that its planes are exact's wherever nothing is ambiguous.
#include "reference/embree/embree.h"

#include <limits>

#include <gtest/gtest.h>

#include "reference/exact/exact.h"
#include "tests/cross/embree_scenes.h"

namespace plumbline {
namespace {

TEST(EmbreeRenderer, SaysWhatItShows) {
  const RendererInfo info = embree::make_embree()->info();
  EXPECT_EQ(info.name, "embree");
  EXPECT_TRUE(info.version.starts_with("3.") || info.version.starts_with("4.")) << info.version;
  EXPECT_TRUE(info.legal);
  for (std::size_t s = 0; s < kStageNames.size(); ++s) {
    EXPECT_FALSE(info.stages[s].runs) << kStageNames[s];
    EXPECT_NE(info.stages[s].shows, !info.stages[s].reason.empty()) << kStageNames[s];
  }
  EXPECT_TRUE(info[Stage::visibility].shows);
  EXPECT_FALSE(info[Stage::vertex].shows);
  EXPECT_THROW(embree::make_embree()->run_stage({}, Stage::coverage, {}), Unsupported);
}

TEST(EmbreeRenderer, HandsOutLegalAnswersOnDemandOnly) {
  const Scene scene = test::sphere_scene(32, 32, 4, 6, Cull::none);
  Request request;
  EXPECT_TRUE(embree::make_embree()->capture(scene, request).legal.empty());
  request.legal = true;
  EXPECT_FALSE(embree::make_embree()->capture(scene, request).legal.empty());
}

TEST(EmbreeRenderer, AnEmptySceneIsTheBackground) {
  Scene scene = test::frame_of(5, 3);
  scene.frame.clear_color = {0.25f, 0.5f, 1, 1};
  Request request;
  request.legal = true;
  const Capture capture = embree::make_embree()->capture(scene, request);
  EXPECT_EQ(capture.planes.id.values(), Plane<std::int32_t>::Values(15, kBackground));
  EXPECT_EQ(capture.planes.color(4, 2), glm::vec4(64 / 255.0f, 128 / 255.0f, 1, 1));
  EXPECT_EQ(capture.legal.at(4, 2).size(), 1u);
  EXPECT_EQ(capture.legal.predicted_ambiguous, 0);
}

TEST(EmbreeRenderer, RefusesVerticesThatEmbreeWouldDrop) {
  Scene scene = test::sphere_scene(32, 32, 4, 6, Cull::none);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e19f}) {
    scene.meshes[0].positions[3].x = bad;
    try {
      embree::make_embree()->capture(scene, Request{});
      ADD_FAILURE() << bad << " was accepted";
    } catch (const Unsupported& error) {
      EXPECT_NE(std::string(error.what()).find("vertex 3"), std::string::npos) << error.what();
    }
  }
}

// Parallel rays begin before whatever a clamped depth leaves before the near plane.
TEST(EmbreeRenderer, MeetsWhatLiesFarBeforeTheNearPlane) {
  Scene scene = test::frame_of(16, 16);
  scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}};
  scene.projection = Orthographic{-1.5, 1.5, -1.5, 1.5, 1, 2};
  scene.depth_clamp = true;
  Mesh mesh;
  mesh.positions = {{-1, -1, 2.8f}, {1, -1, 2.8f}, {1, 1, 2.8f}, {-1, 1, 2.8f}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(mesh);
  Draw draw;
  draw.lit = false;
  draw.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
  scene.draws.push_back(draw);
  const Capture rays = embree::make_embree()->capture(scene, Request{});
  const Capture exact = exact::make_exact()->capture(scene, Request{});
  EXPECT_NE(exact.planes.id(8, 9), kBackground);
  EXPECT_NE(rays.planes.id(8, 9), kBackground);
  EXPECT_EQ(rays.planes.depth(8, 9), 0);
}

class EmbreePlanes : public ::testing::TestWithParam<int> {};

// Exact snaps and covers in integers, embree asks double: away from edges and depth ties both know the winner.
TEST_P(EmbreePlanes, EqualExactsWhereNothingIsAmbiguous) {
  long judged = 0, wrong_winner = 0, wrong_count = 0, wrong_depth = 0, wrong_color = 0, illegal = 0;
  for (unsigned seed = 1; seed <= 25; ++seed) {
    const Scene scene = test::small_scene(GetParam(), seed);
    Request request;
    request.legal = true;
    const Capture rays = embree::make_embree()->capture(scene, request);
    const Capture exact = exact::make_exact()->capture(scene, Request{});
    for (int y = 0; y < scene.frame.height; ++y) {
      for (int x = 0; x < scene.frame.width; ++x) {
        const auto answers = rays.legal.at(x, y);
        const auto is = [&](std::int32_t id) {
          return std::any_of(answers.begin(), answers.end(), [&](const auto& a) { return a.primitive == id; });
        };
        illegal += is(rays.planes.id(x, y)) && is(exact.planes.id(x, y)) ? 0 : 1;
        if (answers.size() > 1) continue;
        ++judged;
        wrong_winner += rays.planes.id(x, y) == exact.planes.id(x, y) ? 0 : 1;
        const LegalAnswer& only = answers.front();
        const double step = depth_step(scene.frame.depth, only.z_hi);
        for (const Capture* c : {&rays, &exact}) {
          const double z = c->planes.depth(x, y);
          wrong_depth += z >= only.z_lo - step && z <= only.z_hi + step ? 0 : 1;
          const glm::vec4 off = glm::abs(c->planes.shaded(x, y) - only.color);
          wrong_color += std::max({off.r, off.g, off.b, off.a}) <= only.color_bound + 1e-6f ? 0 : 1;
        }
        if (rays.legal.certain(x, y) != rays.legal.possible(x, y)) continue;
        wrong_count += rays.planes.count(x, y) == exact.planes.count(x, y) ? 0 : 1;
        if (rays.legal.shared(x, y) != 0) continue;  // which of the triangles has the sample, the tie rule says
        wrong_count += rays.planes.id_sum(x, y) == exact.planes.id_sum(x, y) ? 0 : 1;
      }
    }
  }
  EXPECT_GT(judged, 50000);
  EXPECT_EQ(illegal, 0);
  EXPECT_EQ(wrong_winner, 0);
  EXPECT_EQ(wrong_count, 0);
  EXPECT_EQ(wrong_depth, 0);
  EXPECT_EQ(wrong_color, 0);
}
INSTANTIATE_TEST_SUITE_P(Kinds, EmbreePlanes, ::testing::Range(0, test::kSceneKinds));

}  // namespace
}  // namespace plumbline
