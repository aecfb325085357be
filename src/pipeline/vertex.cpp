#include "pipeline/geometry.h"

#include "kernels/math.h"

namespace plumbline::pipeline {

Mat4<float> clip_matrix(const Matrices<float>& matrices) {
  const Mat4<float>& p = matrices.projection;
  Mat4<float> out;
  for (int column = 0; column < 4; ++column) {
    const Vec4<float>& m = matrices.model_view[column];
    out[column] = ((p[0] * m.x + p[1] * m.y) + p[2] * m.z) + p[3] * m.w;
  }
  return out;
}

void transform(const Matrices<float>& matrices, Normals normals, const Mesh& mesh, std::vector<Vertex<float>>& out) {
  const Mat4<float> to_clip = clip_matrix(matrices);
  const float of_all = normals == Normals::rescale ? length(matrices.normal[2]) : 1.0f;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3<float> p_model = mesh.positions[i];
    const Vec3<float> n = product<float>(matrices.normal, mesh.normals[i]);
    const float divisor = normals == Normals::normalize ? length(n) : of_all;
    out.push_back({product<float>(matrices.model_view, p_model), product<float>(to_clip, p_model), n / divisor});
  }
}

}  // namespace plumbline::pipeline
