// Triangles that are drawn again: which ones have one depth in every renderer, and what is legal then.
#include <gtest/gtest.h>

#include "reference/oracle/oracle.h"

namespace plumbline::math {
namespace {

// One triangle in two draws, which cover the middle of the frame.
Scene drawn_twice() {
  Scene scene;
  scene.name = "twice";
  scene.frame.width = scene.frame.height = 16;
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0.5f}, {0, 1, -0.5f}};
  mesh.normals.assign(3, glm::vec3(0, 0, 1));
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh, mesh};
  Draw draw;
  draw.lit = false;
  scene.draws = {draw, draw};
  scene.draws[1].mesh = 1;
  return scene;
}

// Legal winners of the pixel in the middle.
std::vector<int> winners(const Scene& scene) {
  const Legal legal = legal_by_boxes(scene, {});
  std::vector<int> out;
  for (const LegalAnswer& answer : legal.at(8, 8)) out.push_back(answer.primitive);
  return out;
}

TEST(Repeated, IsATriangleOfTheSameVerticesAndState) {
  Scene scene = drawn_twice();
  EXPECT_EQ(winners(scene), std::vector<int>{0});
  for (Draw& draw : scene.draws) draw.depth_func = DepthFunc::less_equal;
  EXPECT_EQ(winners(scene), std::vector<int>{1});
  for (Draw& draw : scene.draws) draw.transforms = {Rotate{30, {0, 0, 1}}, Scale{{1, 0.5, 1}}};
  EXPECT_EQ(winners(scene), std::vector<int>{1});
  scene.draws[0].depth_func = scene.draws[1].depth_func = DepthFunc::less;
  EXPECT_LT(legal_by_boxes(scene, {}).predicted_ambiguous, 4);
  scene.draws[1].fog = Fog{};
  EXPECT_GT(legal_by_boxes(scene, {}).predicted_ambiguous, 10) << "nearly all that it covers";
}

TEST(Repeated, IsFoundWithinOneDraw) {
  Scene scene = drawn_twice();
  scene.draws.pop_back();
  Mesh& mesh = scene.meshes[0];
  mesh.positions.insert(mesh.positions.end(), {mesh.positions[0], mesh.positions[1], mesh.positions[2]});
  mesh.normals.assign(6, glm::vec3(0, 0, 1));
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 1, 2}};
  EXPECT_EQ(winners(scene), std::vector<int>{0});
}

TEST(Repeated, IsNoneByAnotherStateOrOrderOrPlace) {
  const std::vector<int> both{0, 1};
  const auto changed = [](auto change) {
    Scene scene = drawn_twice();
    change(scene);
    return winners(scene);
  };
  EXPECT_EQ(changed([](Scene& s) { s.draws[1].transforms = {Translate{{0, 0, 0}}}; }), both);
  EXPECT_EQ(changed([](Scene& s) { s.draws[1].polygon_offset.units = 0.25f; }), both);
  EXPECT_EQ(changed([](Scene& s) { s.draws[1].lit = true; }), both);
  EXPECT_EQ(changed([](Scene& s) { s.draws[1].fog = Fog{}; }), both);
  EXPECT_EQ(changed([](Scene& s) { s.draws[1].shading = Shading::flat; }), both);
  EXPECT_EQ(changed([](Scene& s) { s.meshes[1].triangles = {{1, 2, 0}}; }), both) << "another corner is the first";
  EXPECT_EQ(changed([](Scene& s) {
              float& z = s.meshes[1].positions[1].z;
              z = std::nextafter(z, 1.0f);
            }),
            both)
      << "one bit";
}

// A plane of the view volume cuts it into pieces, each of a plane of its own.
TEST(Repeated, IsNoneWhereItIsCut) {
  Scene scene = drawn_twice();
  for (Mesh& mesh : scene.meshes) mesh.positions[0].x = -40;
  EXPECT_EQ(winners(scene), (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace plumbline::math
