// Stages 0 to 4 of primitives that do not go through them in lanes (clipped triangles, for one), by the definition.
#pragma once

#include <span>
#include <vector>

#include "painter/assemble.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// Its memory is kept from frame to frame.
class ScalarGeometry {
 public:
  /// `draws`: one for each of the scene's. Window triangles in draw order.
  std::span<const ShadedTriangle> run(const Scene& scene, std::span<const AssemblyWork> draws);

 private:
  void find(const AssemblyWork& draw);
  void run_draw(const Scene& scene, const AssemblyWork& work, const Mesh& mesh);

  Mesh clipped_;                         // of one draw
  std::vector<std::uint32_t> of_draw_;   // the draw's primitives, in the mesh
  std::vector<Vertex<float>> vertices_;  // of one draw
  std::vector<Attributes> attributes_;
  std::vector<ShadedTriangle> triangles_;
};

}  // namespace plumbline::pipeline
