// One context serves many scenes; planes and records of one scene tell the same story.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "tests/capture/differing_arrays.h"
#include "tests/cross/osmesa_scenes.h"

namespace plumbline::test {
namespace {

Request everything() {
  Request request;
  request.records = StageSet::all();
  return request;
}

Scene plain_scene() {
  Scene scene = pixel_scene(24, 16);
  add(scene, triangle({1, 1, 0}, {20, 3, 0}, {4, 14, 0.5f}), {0.2f, 0.4f, 0.8f, 1});
  return scene;
}

// A scene whose frame, lights, material and depth state all differ from those of plain_scene() and lit_scene().
Scene busy_scene() {
  Scene scene;
  scene.name = "test/busy";
  scene.frame = {40, 70, ColorFormat::rgba32f, DepthFormat::z16, {0.5f, 0.25f, 2, 0}, 0.3};
  scene.light_model.ambient = glm::vec3(0.9f);
  scene.lights.resize(8);
  for (Light& light : scene.lights) light.kind = Light::Kind::point;
  Draw& draw = add(scene, make_uv_sphere(12, 8));
  draw.lit = true;
  draw.shading = Shading::flat;
  draw.cull = Cull::front;
  draw.depth_func = DepthFunc::greater_equal;
  draw.material.specular = glm::vec4(1);
  draw.material.emission = glm::vec4(0.5f);
  draw.material.shininess = 100;
  scene.meshes[0].colors.assign(scene.meshes[0].positions.size(), glm::vec4(0.1f));
  return scene;
}

Scene lit_scene() {
  Scene scene = plain_scene();
  scene.lights.emplace_back();
  scene.draws[0].lit = true;
  return scene;
}

TEST(OsmesaState, NothingOfASceneIsLeftForTheNext) {
  for (const Scene& scene : {plain_scene(), lit_scene()}) {
    const Capture fresh = make_opengl()->capture(scene, everything());
    const auto used = make_opengl();
    expect_same_captures(used->capture(scene, everything()), fresh);
    used->capture(busy_scene(), everything());
    expect_same_captures(used->capture(scene, everything()), fresh);
  }
}

TEST(OsmesaState, TwoRenderersTakeTurns) {
  const auto a = make_opengl(), b = make_opengl();
  const Capture first = a->capture(lit_scene(), everything());
  b->capture(busy_scene(), everything());
  expect_same_captures(a->capture(lit_scene(), everything()), first);
}

TEST(OsmesaState, AFailureLeavesTheRendererUsable) {
  const auto osmesa = make_opengl();
  const Capture before = osmesa->capture(plain_scene(), everything());

  Scene torn = plain_scene();
  torn.meshes[0].triangles[0].z = 3;
  try {
    osmesa->capture(torn, everything());
    ADD_FAILURE() << "an index beyond the vertices was taken";
  } catch (const RendererFailed& failure) {
    EXPECT_STREQ(failure.what(), "test/pixels: mesh 0: triangle 0 (0, 1, 3) has a vertex beyond the 3 that there are");
  }
  torn = plain_scene();
  torn.meshes[0].normals.pop_back();
  EXPECT_THROW(osmesa->capture(torn, everything()), RendererFailed);
  torn = plain_scene();
  torn.frame.width = 16385;
  torn.frame.height = 1;
  EXPECT_THROW(osmesa->capture(torn, everything()), RendererFailed);
  torn.lights.resize(9);
  EXPECT_THROW(osmesa->capture(torn, everything()), RendererFailed);

  Request poor = everything();
  poor.memory_budget = plane_bytes(plain_scene()) - 1;
  EXPECT_THROW(osmesa->capture(plain_scene(), poor), OverBudget);

  expect_same_captures(osmesa->capture(plain_scene(), everything()), before);
}

TEST(OsmesaState, TellsWhatItShows) {
  const auto osmesa = make_opengl();
  const RendererInfo info = osmesa->info();
  EXPECT_TRUE(info.name == "osmesa" || info.name == "egl") << info.name;
  EXPECT_EQ(info.version.find("llvmpipe"), 0u) << info.version;
  EXPECT_FALSE(info.legal);
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const Ability& ability = info.stages[i];
    EXPECT_FALSE(ability.runs);
    EXPECT_TRUE(ability.shows) << kStageNames[i];
    EXPECT_EQ(ability.shows, ability.reason.empty());
  }
  EXPECT_THROW(osmesa->run_stage(plain_scene(), Stage::window, {}), Unsupported);
  EXPECT_THROW(make_opengl(MesaDriver::softpipe), RendererFailed);
}

// Counts pixels whose centre is within the snapped edges, or on a left or bottom one.
void paint(const WindowTriangle<double>& t, Plane<std::uint32_t>& count, Plane<std::uint64_t>& id_sum) {
  using P = glm::i64vec2;
  const auto edge_in = [](const P& a, const P& b, const P& p) {  // counter-clockwise: inside is on the left
    const std::int64_t e = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    return e > 0 || (e == 0 && (b.y < a.y || (b.y == a.y && b.x > a.x)));
  };
  P a(t.v[0].snapped), b(t.v[1].snapped), c(t.v[2].snapped);
  if (!t.front) std::swap(b, c);
  const P low = glm::max((glm::min(glm::min(a, b), c) >> std::int64_t{8}), P(0));
  const P high = glm::min((glm::max(glm::max(a, b), c) >> std::int64_t{8}), P(count.width() - 1, count.height() - 1));
  for (int y = static_cast<int>(low.y); y <= high.y; ++y) {
    for (int x = static_cast<int>(low.x); x <= high.x; ++x) {
      const P p(256 * x, 256 * y);
      if (!edge_in(a, b, p) || !edge_in(b, c, p) || !edge_in(c, a, p)) continue;
      ++count(x, y);
      id_sum(x, y) += id_weight(t.primitive);
    }
  }
}

void expect_coverage_of_triangles(const Capture& capture) {
  Plane<std::uint32_t> count(capture.width, capture.height);
  Plane<std::uint64_t> id_sum(capture.width, capture.height);
  for (const auto& t : capture.records.triangles) paint(t, count, id_sum);
  EXPECT_GT(*std::max_element(count.values().begin(), count.values().end()), 1u);
  EXPECT_EQ(capture.planes.count.values(), count.values());
  EXPECT_EQ(capture.planes.id_sum.values(), id_sum.values());
}

TEST(OsmesaState, WindowTrianglesCoverWhatThePlanesCount) {
  for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
    for (const double size : {1.5, 0.1}) {
      Scene scene;
      scene.name = "test/soup";
      scene.frame.width = 211;
      scene.frame.height = 157;
      scene.camera.eye = {0.3, 0.2, 3};
      add(scene, make_soup(2000, 11, 2.5, size)).cull = cull;
      expect_coverage_of_triangles(make_opengl()->capture(scene, everything()));
    }
  }
}

// Slivers along rows of centres, thinner than the snapping: their sign, and so whether culling takes them, is often
// another before snapping than after.
TEST(OsmesaState, SliversAreCulledByTheirSnappedArea) {
  std::mt19937 random(5);
  const auto jitter = [&] { return (static_cast<float>(random() % 2001) - 1000) / 300000; };
  for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
    Scene scene = pixel_scene(256, 256);
    std::vector<glm::vec3> corners;
    std::vector<glm::uvec3> triangles;
    for (unsigned i = 0; i < 800; ++i) {
      const float y = static_cast<float>(random() % 256) + 0.5f;
      for (const float x : {static_cast<float>(random() % 100) + 0.5f, static_cast<float>(150 + random() % 100) + 0.5f,
                            static_cast<float>(100 + random() % 50) + 0.5f}) {
        corners.emplace_back(x + jitter(), y + jitter(), 0);
      }
      triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    add(scene, make_triangles(corners, triangles, {})).cull = cull;
    expect_coverage_of_triangles(make_opengl()->capture(scene, everything()));
  }
}

}  // namespace
}  // namespace plumbline::test
