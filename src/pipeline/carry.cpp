#include "pipeline/carry.h"

#include "pipeline/light.h"

namespace plumbline::pipeline {

namespace {

// A varying that is not lit: texture, normal or position.
Vec4<float> of_vertex(Varying varying, const Mesh& mesh, const Vertex<float>& vertex, std::size_t number) {
  if (varying == Varying::texture) return {mesh.texcoords.at(number), 0.0f, 1.0f};
  if (varying == Varying::normal) return {vertex.n_eye, 0.0f};
  return vertex.p_eye;
}

}  // namespace

void carry(const Scene& scene, const Draw& draw, Varying varying, Lights lights,
           std::span<const Vertex<float>> vertices, std::vector<Vec4<float>>& out) {
  if (!carries(scene, draw, varying)) return out.resize(out.size() + vertices.size(), Vec4<float>(0.0f));
  if (is_lit(varying)) {
    return light_part(scene, draw, {is_back(varying), is_secondary(varying)}, lights, vertices, out);
  }
  const Mesh& mesh = scene.meshes[draw.mesh];
  for (std::size_t i = 0; i < vertices.size(); ++i) out.push_back(of_vertex(varying, mesh, vertices[i], i));
}

}  // namespace plumbline::pipeline
