// The records that the OSMesa reference hands out, against the float recipe of Mesa's vertex stage, transcribed here,
// and against what can be told by hand.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "tests/cross/osmesa_scenes.h"

namespace plumbline::test {
namespace {

Capture capture_all(const Scene& scene) {
  Request request;
  request.records = StageSet::all();
  return make_opengl()->capture(scene, request);
}

Scene soup_scene(int triangles, double size, Cull cull) {
  Scene scene;
  scene.name = "test/soup";
  scene.frame.width = 331;
  scene.frame.height = 187;
  scene.camera.eye = {0.3, 0.2, 3};
  Draw& draw = add(scene, make_soup(triangles, 7, 2.5, size));
  draw.transforms = {Rotate{33, {1, 2, 3}}, Translate{{0.1, 0.2, 0.3}}, Scale{{1, 1.5, 0.75}}};
  draw.cull = cull;
  return scene;
}

// MVP and clip position: products summed from the left, rounded each time.
glm::mat4 recipe_product(const glm::mat4& p, const glm::mat4& m) {
  glm::mat4 mvp;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      mvp[j][i] = ((p[0][i] * m[j][0] + p[1][i] * m[j][1]) + p[2][i] * m[j][2]) + p[3][i] * m[j][3];
    }
  }
  return mvp;
}
glm::vec4 recipe_clip(const glm::mat4& mvp, const glm::vec3& p) {
  glm::vec4 clip;
  for (int i = 0; i < 4; ++i) clip[i] = ((mvp[0][i] * p.x + mvp[1][i] * p.y) + mvp[2][i] * p.z) + mvp[3][i];
  return clip;
}

TEST(OsmesaRecords, VerticesAndWindowAreTheFloatRecipesBits) {
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "Mesa computes other bits on a processor without FMA";
  const Scene scene = soup_scene(3000, 0.8, Cull::none);
  const Capture capture = capture_all(scene);
  const Matrices<double>& m = capture.records.matrices.at(0);
  const glm::mat4 mvp = recipe_product(glm::mat4(m.projection), glm::mat4(m.model_view));
  std::vector<glm::vec4> clip;
  for (const glm::vec3& p : scene.meshes[0].positions) clip.push_back(recipe_clip(mvp, p));

  ASSERT_EQ(capture.records.vertices.size(), clip.size());
  for (std::size_t i = 0; i < clip.size(); ++i) ASSERT_EQ(capture.records.vertices[i].p_clip, glm::dvec4(clip[i])) << i;

  const auto inside = [&](std::uint32_t i) {
    return glm::all(glm::lessThanEqual(glm::abs(glm::vec3(clip[i])), glm::vec3(clip[i].w)));
  };
  int compared = 0;
  for (const WindowTriangle<double>& t : capture.records.triangles) {
    const glm::uvec3 corners = scene.meshes[0].triangles[t.primitive];
    if (!inside(corners.x) || !inside(corners.y) || !inside(corners.z)) continue;
    for (int i = 0; i < 3; ++i) {
      const WindowVertex<double>& v = t.v[static_cast<std::size_t>(i)];
      const glm::vec4 c = clip[corners[i]];
      const float iw = 1 / c.w;
      for (int axis = 0; axis < 3; ++axis) {
        const float window =
            std::fma(c[axis] * iw, static_cast<float>(m.win_scale[axis]), static_cast<float>(m.win_translate[axis]));
        ASSERT_EQ(v.p_win[axis], static_cast<double>(window));
        if (axis < 2) {
          ASSERT_EQ(v.snapped[axis], std::lrint((window - 0.5f) * 256));
        }
      }
      ASSERT_NEAR(v.inv_w, static_cast<double>(iw), std::ldexp(static_cast<double>(iw), -22));
    }
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST(OsmesaRecords, MatricesAreReadBack) {
  Scene scene = soup_scene(1, 1, Cull::none);
  scene.draws[0].transforms = {Translate{{1, 2, 3}}, Scale{{2, 4, 8}}};
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  scene.projection = Perspective{90, 1, 3};
  const Matrices<double> m = capture_all(scene).records.matrices.at(0);
  EXPECT_EQ(m.model_view, glm::dmat4(2, 0, 0, 0, 0, 4, 0, 0, 0, 0, 8, 0, 1, 2, -2, 1));
  EXPECT_EQ(m.normal, glm::dmat3(0.5, 0, 0, 0, 0.25, 0, 0, 0, 0.125));
  EXPECT_EQ(m.projection,
            glm::dmat4(static_cast<double>(187.0f / 331.0f), 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, -1, 0, 0, -3, 0));
  EXPECT_EQ(m.win_scale, glm::dvec3(165.5, 93.5, 0.5));
  EXPECT_EQ(m.win_translate, glm::dvec3(165.5, 93.5, 0.5));
}

TEST(OsmesaRecords, NormalsAndEyePositions) {
  Scene scene = pixel_scene(4, 4);
  Draw& draw = add(scene, triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  scene.meshes[0].normals = {{0, 0, 1}, {1, 0, 0}, {0.6f, 0.8f, 0}};
  draw.transforms = {Translate{{3, 2, 1}}, Scale{{1, 2, 1}}};
  const auto vertices = capture_all(scene).records.vertices;
  ASSERT_EQ(vertices.size(), 3u);
  EXPECT_EQ(vertices[2].p_eye, glm::dvec4(3, 4, 1, 1));
  const double length = std::hypot(0.6, 0.4);  // (0.6, 0.8 / 2)
  EXPECT_NEAR(vertices[2].n_eye.x, 0.6 / length, 1e-6);
  EXPECT_NEAR(vertices[2].n_eye.y, 0.4 / length, 1e-6);
  EXPECT_EQ(vertices[0].n_eye, glm::dvec3(0, 0, 1));
}

// Vertices outside the frame, and behind each other, are lit as well.
TEST(OsmesaRecords, LightOfADirectionByHand) {
  Scene scene = pixel_scene(4, 4);
  scene.light_model.ambient = {0.5f, 0.25f, 0};
  Light light;
  light.vector = {0, 0, 7};  // any length
  light.ambient = {0.1f, 0.1f, 0.1f};
  light.diffuse = {1, 0.5f, 0.25f};
  light.specular = {0.5f, 0.5f, 1};
  scene.lights = {light};
  Draw& draw = add(scene, triangle({1000, 0, 0}, {1, -500, 300}, {0, 1, 0}));
  scene.meshes[0].normals = {{0, 0, 1}, {0.6f, 0, 0.8f}, {0, 0, -1}};
  draw.lit = true;
  draw.material.ambient = {0.2f, 0.4f, 0.6f, 1};
  draw.material.diffuse = {0.3f, 0.4f, 0.5f, 0.75f};
  draw.material.specular = {0.2f, 0.2f, 0.3f, 1};
  draw.material.emission = {0.01f, 0.02f, 0.03f, 1};
  draw.material.shininess = 10;

  const auto lit = capture_all(scene).records.lit;
  ASSERT_EQ(lit.size(), 3u);
  const glm::dvec3 unlit(0.01 + 0.2 * 0.6, 0.02 + 0.4 * 0.35, 0.03 + 0.6 * 0.1);
  const glm::dvec3 diffuse(0.3, 0.4 * 0.5, 0.5 * 0.25), specular(0.2 * 0.5, 0.2 * 0.5, 0.3);
  const double n_dot_h = 0.8;  // the half vector is (0, 0, 1): light and viewer are both straight ahead
  const glm::dvec3 expected[] = {unlit + diffuse + specular, unlit + 0.8 * diffuse + std::pow(n_dot_h, 10) * specular,
                                 unlit};
  for (std::size_t i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(lit[i].color[c], expected[i][c], 2.5e-5) << "vertex " << i << ", channel " << c;
    EXPECT_NEAR(lit[i].color.a, 0.75, 1e-6);
  }
}

// The camera turns the light's place into eye space once; the draw's transforms do not.
TEST(OsmesaRecords, LightOfAPlaceByHand) {
  Scene scene = pixel_scene(4, 4);
  scene.camera = {{0, 0, 10}, {0, 0, 0}, {0, 1, 0}};
  Light light;
  light.kind = Light::Kind::point;
  light.vector = {3, 0, 4};
  scene.lights = {light};
  Draw& draw = add(scene, triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  draw.transforms = {Scale{{2, 2, 2}}};
  draw.lit = true;
  draw.material.diffuse = {0.5f, 0.5f, 0.5f, 1};
  const auto lit = capture_all(scene).records.lit;
  EXPECT_NEAR(lit[0].color.r, 0.5 * 4 / 5, 2.5e-5);                        // (3, 0, 4) from (0, 0, 0)
  EXPECT_NEAR(lit[1].color.r, 0.5 * 4 / std::sqrt(1.0 + 16), 2.5e-5);      // from (2, 0, 0)
  EXPECT_NEAR(lit[2].color.r, 0.5 * 4 / std::sqrt(9.0 + 4 + 16), 2.5e-5);  // from (0, 2, 0)
}

TEST(OsmesaRecords, UnlitVerticesHaveTheirOwnColorClamped) {
  Scene scene = pixel_scene(4, 4);
  Mesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.colors = {{0.25f, 0.5f, 1.5f, 0.5f}, {-1, 0, 0, 2}, {1, 1, 1, 1}};
  add(scene, mesh);
  add(scene, triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), {0.125f, 0.25f, 0.5f, 1});
  const auto lit = capture_all(scene).records.lit;
  ASSERT_EQ(lit.size(), 6u);
  EXPECT_EQ(lit[0].color, glm::dvec4(0.25, 0.5, 1, 0.5));
  EXPECT_EQ(lit[1].color, glm::dvec4(0, 0, 0, 1));
  EXPECT_EQ(lit[4].color, glm::dvec4(0.125, 0.25, 0.5, 1));
}

struct ClipCase {
  const char* what;
  Mesh mesh;
  std::vector<glm::dvec2> corners;  // of the polygon in NDC, in any order
  int cuts;
};

TEST(OsmesaRecords, PolygonsAfterClipping) {
  const ClipCase cases[] = {
      {"inside", triangle({1, 1, 0}, {7, 1, 0}, {1, 7, 0}), {{-0.75, -0.75}, {0.75, -0.75}, {-0.75, 0.75}}, 0},
      {"one vertex outside",
       triangle({4, 2, 0}, {12, 4, 0}, {4, 6, 0}),
       {{0, -0.5}, {1, -0.25}, {1, 0.25}, {0, 0.5}},
       2},
      {"two vertices outside", triangle({4, 4, 0}, {12, 2, 0}, {12, 6, 0}), {{0, 0}, {1, -0.25}, {1, 0.25}}, 2},
      {"round the frame", triangle({-20, -1, 0}, {28, -1, 0}, {4, 40, 0}), {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 4},
      {"all corners cut off",
       triangle({-2, 2, 0}, {10, 2, 0}, {4, 14, 0}),
       {{-1, -0.5}, {1, -0.5}, {1, 0.5}, {0.75, 1}, {-0.75, 1}, {-1, 0.5}},
       6},
      {"outside", triangle({9, 1, 0}, {12, 1, 0}, {9, 7, 0}), {}, 0},
      {"behind the near plane", triangle({1, 1, 2}, {7, 1, 2}, {1, 7, 2}), {}, 0},
  };
  for (const ClipCase& c : cases) {
    for (const Cull cull : {Cull::none, Cull::front}) {  // the stage is before culling
      Scene scene = pixel_scene(8, 8);
      add(scene, c.mesh).cull = cull;
      const Records<double> records = capture_all(scene).records;
      if (c.corners.empty()) {
        EXPECT_TRUE(records.polygons.polygons.empty()) << c.what;
        continue;
      }
      ASSERT_EQ(records.polygons.polygons.size(), 1u) << c.what;
      const ClipPolygon& polygon = records.polygons.polygons[0];
      EXPECT_EQ(polygon.primitive, 0u);
      EXPECT_EQ(polygon.count, c.corners.size()) << c.what;
      EXPECT_EQ(records.polygons.vertices.size(), c.corners.size()) << c.what;
      int cuts = 0;
      double doubled_area = 0;
      for (std::size_t i = 0; i < records.polygons.vertices.size(); ++i) {
        const ClipVertex<double>& v = records.polygons.vertices[i];
        const ClipVertex<double>& next = records.polygons.vertices[(i + 1) % records.polygons.vertices.size()];
        cuts += v.cut;
        doubled_area += v.p_clip.x * next.p_clip.y - v.p_clip.y * next.p_clip.x;
        const bool expected = std::any_of(c.corners.begin(), c.corners.end(), [&](const glm::dvec2& p) {
          return glm::distance(p, glm::dvec2(v.p_clip)) < 1e-6;
        });
        EXPECT_TRUE(expected) << c.what << ": a corner at " << v.p_clip.x << ", " << v.p_clip.y;
        EXPECT_EQ(v.p_clip.w, 1);
        EXPECT_NEAR(v.p_clip.z, 0, 1e-7);
      }
      EXPECT_EQ(cuts, c.cuts) << c.what;
      EXPECT_GT(doubled_area, 0.1) << c.what << ": counter-clockwise";
      EXPECT_EQ(records.triangles.size(), cull == Cull::none ? c.corners.size() - 2 : 0) << c.what;
    }
  }
}

TEST(OsmesaRecords, ColorsAtACutArePerspectiveCorrect) {
  Scene scene;
  scene.name = "test/cut";
  scene.frame.width = scene.frame.height = 8;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Perspective{90, 1, 5};
  Mesh mesh = triangle({0, -1, -2}, {0.5f, -1, -2}, {0, -1, -8});  // the far plane cuts halfway to the last
  mesh.colors = {{1, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
  add(scene, mesh);
  const Records<double> records = capture_all(scene).records;
  ASSERT_EQ(records.polygons.vertices.size(), 4u);
  for (const ClipVertex<double>& v : records.polygons.vertices) {
    EXPECT_EQ(v.cut, v.p_clip.w > 3) << v.p_clip.w;
    EXPECT_NEAR(v.p_clip.w, v.cut ? 5 : 2, 1e-5);
    EXPECT_NEAR(v.color.g, v.cut ? 0.5 : 0, 1e-6);
    EXPECT_NEAR(v.p_clip.y, -1, 1e-5);
  }
}

// Several batches, and numbers over 16 bits.
TEST(OsmesaRecords, PolygonsOfAQuarterMillionPrimitives) {
  Scene scene = pixel_scene(1024, 256);
  add(scene, make_grid(512, 256)).transforms = {Scale{{512, 128, 1}}, Translate{{1, 1, 0}}};
  const Records<double> records = capture_all(scene).records;
  ASSERT_EQ(records.triangles.size(), 262144u);
  ASSERT_EQ(records.polygons.polygons.size(), 262144u);
  for (std::uint32_t p = 0; p < 262144; ++p) {
    ASSERT_EQ(records.triangles[p].primitive, p);
    ASSERT_EQ(records.polygons.polygons[p].primitive, p);
    ASSERT_EQ(records.polygons.polygons[p].first, 3 * p);
  }
}

TEST(OsmesaRecords, OnlyTheStagesAndPrimitivesAskedFor) {
  const Scene scene = soup_scene(500, 0.8, Cull::none);
  const auto osmesa = make_opengl();
  const Records<double> none = osmesa->capture(scene, {}).records;
  EXPECT_TRUE(none.matrices.empty() && none.vertices.empty() && none.lit.empty() && none.triangles.empty());
  EXPECT_TRUE(none.polygons.polygons.empty());

  const Records<double> all = capture_all(scene).records;
  Request request;
  request.records = {Stage::clip, Stage::window};
  request.primitives = {3, 4, 77, 499};
  const Records<double> some = osmesa->capture(scene, request).records;
  EXPECT_TRUE(some.vertices.empty() && some.lit.empty());
  const auto wanted = [&](std::uint32_t p) {
    return std::binary_search(request.primitives.begin(), request.primitives.end(), p);
  };
  const auto of = [&](const Records<double>& records) {
    std::vector<std::pair<std::uint32_t, glm::dvec3>> seen;
    for (const auto& t : records.triangles) {
      if (wanted(t.primitive)) seen.emplace_back(t.primitive, t.v[0].p_win);
    }
    return seen;
  };
  EXPECT_FALSE(some.triangles.empty());
  EXPECT_EQ(of(some).size(), some.triangles.size());
  EXPECT_EQ(of(some), of(all));
}

}  // namespace
}  // namespace plumbline::test
