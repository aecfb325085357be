// Triangles of vertices that went through stages 1, 2 and 4 in lanes: trivial accept and reject (3), culling and
// binning (4).
#pragma once

#include <span>
#include <vector>

#include "painter/painting.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// Per-draw input of triangle assembly.
struct AssemblyWork {
  const Draw* draw;
  const Mesh* mesh;
  DrawRange range;
  std::uint8_t planes;          ///< outcode bits of the planes that cut (geometry.h)
  const std::uint8_t* outside;  ///< null: its window triangles are all in `others`
  std::uint8_t any_outside;     ///< OR of `outside[]` over the draw's vertices
};

/// Drawn face of a triangle.
enum class Kept : std::int32_t { none, back, front };
struct KeptTriangle {
  Kept kept;
  TileBox box;
};
/// One for each of `corners`, numbers of the mesh's vertices, of a draw of filled triangles (cull_lanes.h). Any value,
/// where a corner is outside the view volume.
using CullTriangles = void (*)(const Painting& painting, const AssemblyWork& draw, std::span<const glm::uvec3> corners,
                               KeptTriangle* to);

/// Stages 0 to 4 by the definition, of primitives that do not go through them in lanes (clipped triangles, for one).
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
/// Window triangles, lines and points that ScalarGeometry made, sorted by primitive.
struct OtherTriangles {
  std::span<const ShadedTriangle> triangles;
  std::uint32_t first_vertex;  ///< vertex number of triangles[0]'s corner 0; each triangle has three of its own
};

/// The chunk's triangles, and which tiles they touch.
void assemble(Chunk& chunk, std::span<const AssemblyWork> draws, const OtherTriangles& others, const Painting& painting,
              CullTriangles cull);

}  // namespace plumbline::pipeline
