#include "pipeline/light.h"

#include <algorithm>
#include <cmath>

#include "dialect/dialect.h"
#include "pipeline/math.h"

namespace plumbline::pipeline {

namespace {

Vec3<float> unit(const Vec3<float>& v) { return v / std::sqrt((v.x * v.x + v.y * v.y) + v.z * v.z); }

// A light in eye space, its colours already times the material's.
struct EyeLight {
  bool directional;
  Vec3<float> vector;  // unit direction towards it, or its place
  Vec3<float> ambient, diffuse, specular;
};

EyeLight eye_light(const Light& light, const Material& material, const glm::dmat4& view) {
  const bool directional = light.kind == Light::Kind::directional;
  const Vec3<float> vector(view * glm::dvec4(light.vector, directional ? 0.0 : 1.0));
  return {directional, directional ? unit(vector) : vector, light.ambient * Vec3<float>(material.ambient),
          light.diffuse * Vec3<float>(material.diffuse), light.specular * Vec3<float>(material.specular)};
}

float positive_dot(const Vec3<float>& a, const Vec3<float>& b) {
  return std::max((a.x * b.x + a.y * b.y) + a.z * b.z, 0.0f);
}

Vec3<float> lit_by(const EyeLight& light, const Vertex<float>& vertex, float shininess) {
  const Vec3<float> to_light = light.directional ? light.vector : unit(light.vector - Vec3<float>(vertex.p_eye));
  Vec3<float> color = light.ambient;
  const float n_dot_l = positive_dot(vertex.n_eye, to_light);
  if (n_dot_l > 0.0f) {
    const Vec3<float> half = unit(to_light + Vec3<float>(0, 0, 1));
    color += n_dot_l * light.diffuse;
    color += power(std::min(positive_dot(vertex.n_eye, half), 1.0f), shininess) * light.specular;
  }
  return color;
}

Vec4<float> clamped(const Vec4<float>& color) { return glm::clamp(color, 0.0f, 1.0f); }

}  // namespace

void light(const Scene& scene, const Draw& draw, std::span<const Vertex<float>> vertices,
           std::vector<Lit<float>>& out) {
  const Material& material = draw.material;
  if (!draw.lit) {
    const Mesh& mesh = scene.meshes[draw.mesh];
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      out.push_back({clamped(mesh.colors.empty() ? material.diffuse : mesh.colors[i])});
    }
    return;
  }
  const glm::dmat4 view = view_matrix(scene);
  std::vector<EyeLight> lights;
  for (const Light& l : scene.lights) lights.push_back(eye_light(l, material, view));
  const Vec3<float> base = Vec3<float>(material.emission) + Vec3<float>(material.ambient) * scene.ambient;
  for (const Vertex<float>& vertex : vertices) {
    Vec3<float> color = base;
    for (const EyeLight& l : lights) color += lit_by(l, vertex, material.shininess);
    out.push_back({clamped(Vec4<float>(color, material.diffuse.a))});
  }
}

}  // namespace plumbline::pipeline
