#include "pipeline/vertex.h"

#include <cmath>

namespace plumbline::pipeline {

namespace {

Mat4<float> product(const Mat4<float>& p, const Mat4<float>& m) {
  Mat4<float> out;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      out[column][row] =
          ((p[0][row] * m[column][0] + p[1][row] * m[column][1]) + p[2][row] * m[column][2]) + p[3][row] * m[column][3];
    }
  }
  return out;
}

Vec4<float> product(const Mat4<float>& m, const Vec3<float>& p) {
  Vec4<float> out;
  for (int row = 0; row < 4; ++row) {
    out[row] = ((m[0][row] * p.x + m[1][row] * p.y) + m[2][row] * p.z) + m[3][row];
  }
  return out;
}

float length(const Vec3<float>& v) { return std::sqrt((v.x * v.x + v.y * v.y) + v.z * v.z); }

}  // namespace

Mat4<float> clip_matrix(const Matrices<float>& matrices) { return product(matrices.projection, matrices.model_view); }

void transform(const Matrices<float>& matrices, Normals normals, const Mesh& mesh, std::vector<Vertex<float>>& out) {
  const Mat4<float> to_clip = clip_matrix(matrices);
  const float of_all = normals == Normals::rescale ? length(matrices.normal[2]) : 1.0f;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3<float> p_model = mesh.positions[i];
    const Vec3<float> n = matrices.normal * mesh.normals[i];
    const float divisor = normals == Normals::normalize ? length(n) : of_all;
    out.push_back({product(matrices.model_view, p_model), product(to_clip, p_model), n / divisor});
  }
}

}  // namespace plumbline::pipeline
