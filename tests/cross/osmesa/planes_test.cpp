// The planes that the OSMesa reference hands out, against what can be told by hand.
#include <cmath>

#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "tests/cross/osmesa_scenes.h"

namespace plumbline::test {
namespace {

Planes planes_of(const Scene& scene) { return make_opengl()->capture(scene, {}).planes; }

// The hypotenuse runs through centres, with the interior on its left: they are out.
TEST(OsmesaPlanes, CountsATrianglesPixels) {
  Scene scene = pixel_scene(8, 6);
  add(scene, triangle({1, 1, 0}, {5, 1, 0}, {1, 5, 0}));
  EXPECT_EQ(picture(planes_of(scene).count, 0u), (Picture{"........",  //
                                                          "........",  //
                                                          ".1......",  //
                                                          ".11.....",  //
                                                          ".111....",  //
                                                          "........"}));
}

// A rectangle from centre to centre: left and bottom edges are in, right and top ones are out.
TEST(OsmesaPlanes, LeftAndBottomEdgesAreIn) {
  Scene scene = pixel_scene(6, 5);
  add(scene, rectangle(1.5f, 1.5f, 4.5f, 3.5f, 0));
  EXPECT_EQ(picture(planes_of(scene).count, 0u), (Picture{"......",  //
                                                          "......",  //
                                                          ".111..",  //
                                                          ".111..",  //
                                                          "......"}));
}

TEST(OsmesaPlanes, IdIsTheNearestPrimitive) {
  Scene scene = pixel_scene(7, 5);
  add(scene, rectangle(0, 0, 4, 4, 0));                            // primitives 0, 1
  add(scene, triangle({2, 1, 0.5f}, {6, 1, 0.5f}, {2, 5, 0.5f}));  // 2, nearer
  add(scene, rectangle(1, 0, 7, 2, -0.5f));                        // 3, 4, farther
  const Planes planes = planes_of(scene);
  EXPECT_EQ(picture(planes.id, kBackground), (Picture{".......",  //
                                                      "1120...",  //
                                                      "1122...",  //
                                                      "1022233",  //
                                                      "0000333"}));
  EXPECT_EQ(planes.count(3, 1), 3u);
  EXPECT_EQ(planes.id_sum(3, 1), id_weight(0) + id_weight(2) + id_weight(4));
  EXPECT_EQ(planes.id_sum(6, 4), 0u);
}

// Numbers are drawn lit where alpha is tested: a separate specular term must not be added to them.
TEST(OsmesaPlanes, IdUnderAlphaTestKnowsNoSeparateSpecularTerm) {
  Scene scene = pixel_scene(4, 3);
  scene.light_model.separate_specular = true;
  scene.lights.emplace_back();  // from +z, white
  add(scene, triangle({-1, -1, 0}, {9, -1, 0}, {-1, 9, 0}));
  scene.draws.back().lit = true;
  scene.draws.back().material.specular = {0.25f, 0.5f, 0.75f, 1};
  scene.draws.back().alpha_test = AlphaTest{CompareFunc::greater, 0.5f};
  EXPECT_EQ(picture(planes_of(scene).id, kBackground), (Picture{"0000", "0000", "0000"}));
}

TEST(OsmesaPlanes, IdSumAddsEveryPrimitiveOfALargeNumber) {
  Scene scene = pixel_scene(3, 2);
  Mesh mesh;
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < 4096; ++i) {  // as many as can be told apart
    for (const glm::vec3& p : {glm::vec3(0), glm::vec3(3, 0, 0), glm::vec3(0, 2, 0)}) mesh.positions.push_back(p);
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    sum += id_weight(i);
  }
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
  add(scene, mesh);
  const Planes planes = planes_of(scene);
  EXPECT_EQ(planes.count(0, 0), 4096u);
  EXPECT_EQ(planes.id_sum(0, 0), sum);

  scene.draws.push_back(scene.draws[0]);
  try {
    planes_of(scene);
    ADD_FAILURE() << "8192 fragments at a pixel were taken";
  } catch (const Unsupported& failure) {
    EXPECT_NE(std::string(failure.what()).find("8192 fragments at pixel (0, 0)"), std::string::npos) << failure.what();
  }
}

// One pixel for each of 262,144 triangles: their numbers need three bytes.
TEST(OsmesaPlanes, IdsOfAQuarterMillionPrimitives) {
  Scene scene = pixel_scene(1024, 256);
  Draw& draw = add(scene, make_grid(512, 256));
  draw.transforms = {Scale{{512, 128, 1}}, Translate{{1, 1, 0}}};  // two pixels by one a cell
  const Planes planes = planes_of(scene);
  const auto& triangles = scene.meshes[0].triangles;
  const auto& positions = scene.meshes[0].positions;
  for (std::uint32_t p = 0; p < triangles.size(); ++p) {
    const glm::uvec3 t = triangles[p];
    const glm::vec3 middle = (positions[t.x] + positions[t.y] + positions[t.z]) / 3.0f;
    const int x = static_cast<int>((middle.x + 1) * 512), y = static_cast<int>((middle.y + 1) * 128);
    ASSERT_EQ(planes.id(x, y), static_cast<std::int32_t>(p)) << "at " << x << ", " << y;
  }
}

struct DepthCase {
  DepthFormat format;
  double quarter, clear;  // what window z 1/4 and 0.123 are in the format
};

TEST(OsmesaPlanes, DepthIsInTheFramesFormat) {
  const DepthCase cases[] = {{DepthFormat::z16, 16384 / 65535.0, 8061 / 65535.0},
                             {DepthFormat::z24, 4194304 / 16777215.0, 2063597 / 16777215.0},
                             {DepthFormat::z8, 4194304 / 16777215.0, 2063597 / 16777215.0},  // of 24 bits: GL has none
                             {DepthFormat::z32f, 0.25, static_cast<double>(0.123f)}};
  for (const DepthCase& expected : cases) {
    for (const ColorFormat color :
         {ColorFormat::rgba8, ColorFormat::rgba12, ColorFormat::rgba16, ColorFormat::rgba32f}) {
      Scene scene = pixel_scene(5, 3);
      scene.frame.depth = expected.format;
      scene.frame.color = color;
      scene.frame.clear_depth = 0.123;
      add(scene, rectangle(0, 0, 2, 2, 0.5f)).depth_func = DepthFunc::always;
      const Planes planes = planes_of(scene);
      EXPECT_EQ(planes.depth(1, 1), expected.quarter);
      EXPECT_EQ(planes.depth(3, 1), expected.clear);
      EXPECT_EQ(planes.depth(0, 2), expected.clear);
    }
  }
}

TEST(OsmesaPlanes, ColorIsInTheFramesFormat) {
  // No code is near the middle between two: which of them OpenGL takes there is its own affair.
  const glm::vec4 paint(0.31f, 0.6f, 0.87f, 0.123f), clear(0.11f, 0.72f, 0.2f, 0.45f);
  for (const ColorFormat color : {ColorFormat::rgba8, ColorFormat::rgba12, ColorFormat::rgba32f}) {
    Scene scene = pixel_scene(5, 3);
    scene.frame.color = color;
    scene.frame.clear_color = clear;
    add(scene, rectangle(0, 0, 2, 2, 0), paint);
    const Planes planes = planes_of(scene);
    for (int i = 0; i < 4; ++i) {
      const auto stored = [&](float v) { return color == ColorFormat::rgba8 ? std::round(v * 255) / 255 : v; };
      EXPECT_EQ(planes.color(1, 1)[i], stored(paint[i]));
      EXPECT_EQ(planes.color(4, 2)[i], stored(clear[i]));
      EXPECT_EQ(planes.shaded(1, 1)[i], paint[i]);
      EXPECT_EQ(planes.shaded(4, 2)[i], clear[i]);
    }
  }
}

TEST(OsmesaPlanes, FlatTrianglesHaveTheLastCornersColor) {
  Scene scene = pixel_scene(8, 8);
  Mesh mesh = triangle({0, 0, 0}, {8, 0, 0}, {0, 8, 0});
  mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  add(scene, mesh).shading = Shading::flat;
  EXPECT_EQ(planes_of(scene).shaded(1, 1), glm::vec4(0, 0, 1, 1));
  scene.draws[0].shading = Shading::gouraud;
  const glm::vec4 mixed = planes_of(scene).shaded(1, 1);  // at (1.5, 1.5)
  EXPECT_NEAR(mixed.r, 1 - 3 / 8.0, 1e-6);
  EXPECT_NEAR(mixed.g, 1.5 / 8, 1e-6);
  EXPECT_NEAR(mixed.b, 1.5 / 8, 1e-6);
}

TEST(OsmesaPlanes, CullsBySide) {
  Scene scene = pixel_scene(4, 4);
  add(scene, triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0}));  // counter-clockwise: the front
  add(scene, triangle({0, 0, 0}, {0, 4, 0}, {4, 0, 0}));
  const auto count = [&](Cull cull) {
    for (Draw& draw : scene.draws) draw.cull = cull;
    const Planes planes = planes_of(scene);
    return std::pair(planes.count(0, 0), planes.id_sum(0, 0));
  };
  EXPECT_EQ(count(Cull::none), std::pair(2u, id_weight(0) + id_weight(1)));
  EXPECT_EQ(count(Cull::back), std::pair(1u, id_weight(0)));
  EXPECT_EQ(count(Cull::front), std::pair(1u, id_weight(1)));
}

// A plane at window z 1/4, then one nearer, one as near, one farther; all that pass `func` win.
TEST(OsmesaPlanes, DepthFunctions) {
  const auto winner = [](DepthFunc func, float z) {
    Scene scene = pixel_scene(2, 2);
    add(scene, rectangle(0, 0, 2, 2, 0.5f));
    add(scene, rectangle(0, 0, 2, 2, z)).depth_func = func;
    return planes_of(scene).id(0, 1) >= 2;
  };
  struct Case {
    DepthFunc func;
    bool nearer, equal, farther;
  };
  const Case cases[] = {
      {DepthFunc::never, false, false, false},       {DepthFunc::less, true, false, false},
      {DepthFunc::equal, false, true, false},        {DepthFunc::less_equal, true, true, false},
      {DepthFunc::greater, false, false, true},      {DepthFunc::not_equal, true, false, true},
      {DepthFunc::greater_equal, false, true, true}, {DepthFunc::always, true, true, true},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(winner(c.func, 0.75f), c.nearer) << static_cast<int>(c.func);
    EXPECT_EQ(winner(c.func, 0.5f), c.equal) << static_cast<int>(c.func);
    EXPECT_EQ(winner(c.func, 0.25f), c.farther) << static_cast<int>(c.func);
  }
}

TEST(OsmesaPlanes, AFrameAsWideAsGLAllows) {
  Scene scene = pixel_scene(16384, 3);
  add(scene, rectangle(16380, 1, 16384, 2, 0));
  const Planes planes = planes_of(scene);
  EXPECT_EQ(planes.count(16379, 1), 0u);
  EXPECT_EQ(planes.count(16380, 1), 1u);
  EXPECT_EQ(planes.count(16383, 1), 1u);
  EXPECT_EQ(planes.count(16383, 2), 0u);
}

TEST(OsmesaPlanes, AnEmptySceneIsTheClearValues) {
  const Planes planes = planes_of(pixel_scene(3, 2));
  EXPECT_EQ(planes.count.values(), Plane<std::uint32_t>::Values(6, 0));
  EXPECT_EQ(planes.id.values(), Plane<std::int32_t>::Values(6, kBackground));
  EXPECT_EQ(planes.depth.values(), Plane<double>::Values(6, 1.0));
  EXPECT_EQ(planes.color.values(), Plane<glm::vec4>::Values(6, glm::vec4(0, 0, 0, 1)));
}

}  // namespace
}  // namespace plumbline::test
