// Edges and areas of meshes, for tests of their winding.
#pragma once

#include <map>
#include <utility>

#include "scene/scene.h"

namespace plumbline {

/// How often each directed edge occurs.
inline std::map<std::pair<unsigned, unsigned>, int> directed_edges(const Mesh& mesh) {
  std::map<std::pair<unsigned, unsigned>, int> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  return edges;
}

inline glm::dvec3 twice_area(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  return glm::cross(b - a, c - a);
}

}  // namespace plumbline
