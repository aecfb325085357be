// Stage 1: the float recipe to the bit, and normals.
#include "pipeline/geometry.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace plumbline::pipeline {
namespace {

/// Sums of float products, each rounded: from the left, as the recipe has it.
float left_to_right(std::array<float, 4> a, std::array<float, 4> b) {
  float sum = a[0] * b[0];
  for (std::size_t i = 1; i < 4; ++i) sum = sum + a[i] * b[i];
  return sum;
}
float right_to_left(std::array<float, 4> a, std::array<float, 4> b) {
  float sum = a[3] * b[3];
  for (std::size_t i = 3; i-- > 0;) sum = a[i] * b[i] + sum;
  return sum;
}
float in_pairs(std::array<float, 4> a, std::array<float, 4> b) {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}
float fused(std::array<float, 4> a, std::array<float, 4> b) {
  float sum = a[0] * b[0];
  for (std::size_t i = 1; i < 4; ++i) sum = std::fma(a[i], b[i], sum);
  return sum;
}
using Dot = float (*)(std::array<float, 4>, std::array<float, 4>);

glm::vec4 times(Dot dot, const glm::mat4& m, const glm::vec4& v) {
  glm::vec4 out;
  for (int row = 0; row < 4; ++row) out[row] = dot({m[0][row], m[1][row], m[2][row], m[3][row]}, {v.x, v.y, v.z, v.w});
  return out;
}
glm::mat4 times(Dot dot, const glm::mat4& a, const glm::mat4& b) {
  glm::mat4 out;
  for (int column = 0; column < 4; ++column) out[column] = times(dot, a, b[column]);
  return out;
}

Matrices<float> identity() { return {Mat4<float>(1), Mat4<float>(1), Mat3<float>(1), Vec3<float>(1), Vec3<float>(0)}; }

TEST(PipelineVertex, ByHand) {
  Matrices<float> m = identity();
  m.model_view = Mat4<float>({0, 2, 0, 0}, {-1, 0, 0, 0}, {0, 0, 3, 0}, {10, 20, 30, 1});
  m.projection = Mat4<float>({0.5f, 0, 0, 0}, {0, 4, 0, 0}, {0, 0, -1, -1}, {0, 0, -2, 0});
  Mesh mesh;
  mesh.positions = {{1, 2, 3}};
  mesh.normals = {{0, 0, 1}};
  std::vector<Vertex<float>> out;
  transform(m, Normals::normalize, mesh, out);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].p_eye, Vec4<float>(8, 22, 39, 1));
  EXPECT_EQ(out[0].p_clip, Vec4<float>(4, 88, -41, -39));
}

TEST(PipelineVertex, NormalsGoByTheirOwnMatrixToUnitLength) {
  Matrices<float> m = identity();
  m.model_view = Mat4<float>(7);
  m.normal = Mat3<float>({0, 0, 3}, {8, 0, 0}, {0, 0.25f, 0});
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  mesh.normals = {{1, 0, 0}, {0.6f, 0.8f, 0}, {0, 0, -1}};
  std::vector<Vertex<float>> out;
  transform(m, Normals::normalize, mesh, out);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_EQ(out[0].n_eye, Vec3<float>(0, 0, 1));
  EXPECT_EQ(out[2].n_eye, Vec3<float>(0, -1, 0));
  const double length = std::hypot(6.4, 1.8);
  EXPECT_NEAR(out[1].n_eye.x, 6.4 / length, 1e-7);
  EXPECT_EQ(out[1].n_eye.y, 0);
  EXPECT_NEAR(out[1].n_eye.z, 1.8 / length, 1e-7);
}

TEST(PipelineVertex, AppendsOnePerVertexInOrder) {
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {2, 0, 0}};
  mesh.normals = {{0, 0, 1}, {0, 1, 0}};
  std::vector<Vertex<float>> out;
  transform(identity(), Normals::normalize, mesh, out);
  transform(identity(), Normals::normalize, mesh, out);
  ASSERT_EQ(out.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(out[i].p_clip, Vec4<float>(mesh.positions[i % 2], 1));
    EXPECT_EQ(out[i].n_eye, mesh.normals[i % 2]);
  }
}

TEST(PipelineVertex, TheRecipeToTheBit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(-4, 4);
  int other_order = 0, other_pairs = 0, other_fused = 0, other_matrix = 0, two_steps = 0;
  for (int i = 0; i < 200; ++i) {
    Matrices<float> m = identity();
    for (int k = 0; k < 16; ++k) {
      m.model_view[k / 4][k % 4] = number(random);
      m.projection[k / 4][k % 4] = number(random);
    }
    Mesh mesh;
    mesh.positions = {{number(random), number(random), number(random)}};
    mesh.normals = {{0, 0, 1}};
    const glm::vec4 p(mesh.positions[0], 1);
    std::vector<Vertex<float>> out;
    transform(m, Normals::normalize, mesh, out);
    const glm::mat4 to_clip = times(left_to_right, m.projection, m.model_view);
    ASSERT_EQ(out[0].p_eye, times(left_to_right, m.model_view, p));
    ASSERT_EQ(out[0].p_clip, times(left_to_right, to_clip, p));
    other_order += out[0].p_clip != times(right_to_left, to_clip, p);
    other_pairs += out[0].p_clip != times(in_pairs, to_clip, p);
    other_fused += out[0].p_clip != times(fused, to_clip, p);
    other_matrix += out[0].p_clip != times(left_to_right, times(fused, m.projection, m.model_view), p);
    two_steps += out[0].p_clip != times(left_to_right, m.projection, out[0].p_eye);
  }
  // Each other way to add the same products shows.
  EXPECT_GT(other_order, 20);
  EXPECT_GT(other_pairs, 20);
  EXPECT_GT(other_fused, 20);
  EXPECT_GT(other_matrix, 20);
  EXPECT_GT(two_steps, 20);
}

TEST(PipelineVertex, NormalsAreNormalisedRescaledOrAsTheyAre) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}};
  mesh.normals = {{0.6f, 0, 0.8f}};
  Matrices<float> m = identity();
  m.normal = Mat3<float>(0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.25f);  // of a scale by 2, 2, 4
  const auto normal = [&](Normals normals) {
    std::vector<Vertex<float>> out;
    transform(m, normals, mesh, out);
    return out.at(0).n_eye;
  };
  EXPECT_EQ(normal(Normals::as_they_are), Vec3<float>(0.3f, 0, 0.2f));
  EXPECT_EQ(normal(Normals::rescale), Vec3<float>(1.2f, 0, 0.8f)) << "by the third row of the inverse: times 4";
  EXPECT_NEAR(glm::length(normal(Normals::normalize)), 1, 1e-6);
}

}  // namespace
}  // namespace plumbline::pipeline
