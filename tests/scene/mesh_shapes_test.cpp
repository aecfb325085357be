// The mesh generators: closed, wound counter-clockwise from outside, the same everywhere.
#include "scene/mesh/mesh_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "tests/scene/mesh_edges.h"

namespace plumbline {
namespace {

class Sphere : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(Sphere, IsClosedAndFacesOutward) {
  const auto [slices, stacks] = GetParam();
  const Mesh mesh = make_uv_sphere(slices, stacks);
  EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * slices * (stacks - 1)));
  EXPECT_EQ(mesh.positions.size(), static_cast<std::size_t>(slices * (stacks - 1) + 2));
  const auto edges = directed_edges(mesh);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << edge.first << " " << edge.second;
  }
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 middle(mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]);
    EXPECT_GT(glm::dot(twice_area(mesh, t), middle), 1e-6);
  }
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    EXPECT_NEAR(glm::length(glm::dvec3(mesh.normals[i])), 1, 1e-6);
    EXPECT_EQ(mesh.normals[i], mesh.positions[i]);
  }
  EXPECT_EQ(mesh.positions.front(), glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh.positions.back(), glm::vec3(0, -1, 0));
}
INSTANTIATE_TEST_SUITE_P(Sizes, Sphere,
                         testing::Values(std::pair{3, 2}, std::pair{3, 3}, std::pair{12, 8}, std::pair{64, 33}));

TEST(Grid, IsTheSquareOfBothTrianglesPerCell) {
  const Mesh mesh = make_grid(3, 5);
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.triangles.size(), 30u);
  EXPECT_EQ(mesh.positions.front(), glm::vec3(-1, -1, 0));
  EXPECT_EQ(mesh.positions.back(), glm::vec3(1, 1, 0));
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    EXPECT_GT(twice_area(mesh, t).z, 0);
    area += twice_area(mesh, t).z / 2;
  }
  EXPECT_NEAR(area, 4, 1e-6);
  for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
  for (const auto& [edge, count] : directed_edges(mesh)) EXPECT_EQ(count, 1);
}

TEST(Soup, IsTheSameForASeedAndWithinItsBox) {
  const Mesh a = make_soup(500, 7, 2, 0.25), b = make_soup(500, 7, 2, 0.25), c = make_soup(500, 8, 2, 0.25);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_NE(a.positions, c.positions);
  EXPECT_EQ(a.triangles.size(), 500u);
  EXPECT_EQ(a.colors.size(), 1500u);
  glm::vec3 lo(9), hi(-9);
  for (const glm::vec3& p : a.positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(lo[k], -2.25f);
    EXPECT_LE(hi[k], 2.25f);
    EXPECT_LT(lo[k], -1.8f);  // and fills it
    EXPECT_GT(hi[k], 1.8f);
  }
  for (const glm::vec4& color : a.colors) EXPECT_EQ(color.a, 1);
}

/// SplitMix64 from seed 0 begins with e220a8397b1dcdaf, 6e789e6aa1b965f4, 06c45d188009454f (the generator's published
/// outputs): the first triangle's middle, where size is 0.
TEST(Soup, DrawsFromSplitMix64) {
  const Mesh mesh = make_soup(1, 0, 1, 0);
  const auto number = [](std::uint64_t bits) {
    return static_cast<float>(2 * static_cast<double>(bits >> 40) * 0x1p-24 - 1);
  };
  EXPECT_EQ(mesh.positions[0],
            glm::vec3(number(0xe220a8397b1dcdafu), number(0x6e789e6aa1b965f4u), number(0x06c45d188009454fu)));
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));  // no area: +z
}

TEST(AreaWeightedNormals, WeighByAreaAndFallBackToZ) {
  // A corner of three faces x, y, z whose areas are 1, 2 and 3 halves; then a vertex of no triangle.
  const std::vector<glm::vec3> p{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {3, 0, 0}, {5, 5, 5}};
  const std::vector<glm::uvec3> t{{0, 1, 2}, {0, 2, 3}, {0, 4, 1}};
  const auto n = area_weighted_normals(p, t);
  const glm::vec3 expected = glm::normalize(glm::vec3(1, 2, 3));
  for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(n[0][k], expected[k]);
  EXPECT_EQ(n[5], glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace plumbline
