// The curved generators: closed, wound counter-clockwise from outside.
#include "scene/mesh/mesh_solids.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "tests/scene/mesh_edges.h"

namespace plumbline {
namespace {

/// Whether each edge belongs to two triangles, in opposite directions, vertices at one place being one.
void expect_closed(const Mesh& mesh) {
  std::map<std::array<float, 3>, unsigned> place;
  Mesh welded = mesh;
  for (glm::uvec3& t : welded.triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 p = mesh.positions[t[k]];
      t[k] = place.try_emplace({p.x, p.y, p.z}, static_cast<unsigned>(place.size())).first->second;
    }
    EXPECT_TRUE(t.x != t.y && t.y != t.z && t.z != t.x);
  }
  const auto edges = directed_edges(welded);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << edge.first << " " << edge.second;
  }
}

double volume(const Mesh& mesh) {
  double six = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    six += glm::dot(a, glm::cross(b, c));
  }
  return six / 6;
}

/// Unit length, and each on the side to which its triangles face.
void expect_outward_normals(const Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const glm::vec3& n : mesh.normals) EXPECT_NEAR(glm::length(glm::dvec3(n)), 1, 1e-6);
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) EXPECT_GT(glm::dot(twice_area(mesh, t), glm::dvec3(mesh.normals[t[k]])), 0);
  }
}

TEST(Cube, IsClosedAndFacesOutward) {
  const Mesh mesh = make_cube();
  EXPECT_EQ(mesh.positions.size(), 24u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  expect_closed(mesh);
  EXPECT_NEAR(volume(mesh), 8, 1e-12);
  expect_outward_normals(mesh);
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(glm::vec3(glm::normalize(twice_area(mesh, t))), mesh.normals[t[k]]);
    }
  }
}

class Icosphere : public testing::TestWithParam<int> {};
TEST_P(Icosphere, IsClosedAndFacesOutward) {
  const Mesh mesh = make_icosphere(GetParam());
  const std::size_t triangles = 20u << 2 * GetParam();
  EXPECT_EQ(mesh.triangles.size(), triangles);
  EXPECT_EQ(mesh.positions.size(), triangles / 2 + 2);  // Euler
  expect_closed(mesh);
  expect_outward_normals(mesh);
  for (const glm::vec3& p : mesh.positions) EXPECT_NEAR(glm::length(glm::dvec3(p)), 1, 1e-6);
  EXPECT_NEAR(volume(mesh), 4.18879, GetParam() == 0 ? 1.7 : 3.0 / static_cast<double>(triangles / 20));
}
INSTANTIATE_TEST_SUITE_P(Subdivisions, Icosphere, testing::Values(0, 1, 2, 4));

TEST(TorusKnot, IsClosedAndFacesOutward) {
  for (const TorusKnot& knot : {TorusKnot{.segments = 128, .sides = 12}, TorusKnot{5, 3, 240, 7, 0.05},
                                TorusKnot{1, 0, 48, 24, 0.2}, TorusKnot{3, 1, 90, 5, 0.1}}) {
    const Mesh mesh = make_torus_knot(knot);
    EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * knot.segments * knot.sides));
    expect_closed(mesh);
    expect_outward_normals(mesh);
    EXPECT_GT(volume(mesh), 0.01);
  }
  // A torus of radii 0.85 and 0.2: 2 pi^2 R r^2, less what 48 x 24 pieces lack.
  EXPECT_NEAR(volume(make_torus_knot({1, 0, 48, 24, 0.2})), 0.6711, 0.011);
}

TEST(Revolution, IsClosedBetweenTips) {
  const std::vector<glm::dvec2> cone{{0, 0}, {1, 0}, {0, 3}};
  const Mesh mesh = make_revolution(cone, 64);
  EXPECT_EQ(mesh.triangles.size(), 128u);
  expect_closed(mesh);
  EXPECT_NEAR(volume(mesh), 3.14159, 0.006);
  const Mesh tube = make_revolution(std::vector<glm::dvec2>{{1, 0}, {1, 2}}, 5);
  EXPECT_EQ(tube.triangles.size(), 10u);
  for (const glm::uvec3& t : tube.triangles) {
    const glm::dvec3 a(tube.positions[t.x]);
    EXPECT_GT(glm::dot(twice_area(tube, t), glm::dvec3(a.x, 0, a.z)), 0);
  }
}

TEST(Revolution, FollowsItsCurves) {
  const std::vector<glm::dvec2> control{{1, 0}, {1, 1}, {2, 2}, {2, 3}, {3, 3}, {4, 4}, {0, 5}};
  const std::vector<glm::dvec2> profile = bezier_profile(control, 2);
  ASSERT_EQ(profile.size(), 5u);
  EXPECT_EQ(profile[0], control[0]);
  EXPECT_EQ(profile[1], glm::dvec2(1.5, 1.5));  // (p0 + 3 p1 + 3 p2 + p3) / 8
  EXPECT_EQ(profile[2], control[3]);
  EXPECT_EQ(profile[4], control[6]);
}

}  // namespace
}  // namespace plumbline
