// Assembly of primitives. Primitives whose vertices went through stages 1, 2 and 4 in lanes: trivial accept and reject
// (stage 3), culling (stage 4). Other primitives: stages 0 to 4 by the definition. All primitives: binning.
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
  const std::uint8_t* outside;  ///< outcodes of the draw's vertices; null: all its triangles are OtherTriangles
  std::uint8_t any_outside;     ///< OR of `outside[]` over the draw's vertices
};

/// Facing of a triangle that is drawn; none: culled, without area, or with no sample of the frame in its bounding box.
enum class Kept : std::int32_t { none, back, front };
struct KeptTriangle {
  Kept kept;
  TileBox box;
};
/// Function that culls filled triangles (cull_lanes.h). `corners`: indices of the mesh's vertices, per triangle; `to`:
/// one result per triangle, without meaning where a corner is outside of the view volume.
using CullTriangles = void (*)(const Painting& painting, const AssemblyWork& draw, std::span<const glm::uvec3> corners,
                               KeptTriangle* to);

/// Stages 0 to 4 by the definition, of primitives that do not go through lanes: clipped primitives, and all primitives
/// of the draws that painter.h names. Memory is kept from frame to frame.
class ScalarGeometry {
 public:
  /// Window triangles of these primitives, in draw order; valid until the next call. `draws`: one per draw of the
  /// scene.
  std::span<const ShadedTriangle> run(const Scene& scene, std::span<const AssemblyWork> draws);

 private:
  void find(const AssemblyWork& draw);
  void run_draw(const Scene& scene, const AssemblyWork& work, const Mesh& mesh);

  Mesh clipped_;                         // of one draw
  std::vector<std::uint32_t> of_draw_;   // indices, in the mesh, of the draw's primitives that find() chose
  std::vector<Vertex<float>> vertices_;  // of one draw
  std::vector<Attributes> attributes_;
  std::vector<ShadedTriangle> triangles_;
};
/// Window triangles, lines and points that ScalarGeometry made, sorted by primitive.
struct OtherTriangles {
  std::span<const ShadedTriangle> triangles;
  std::uint32_t first_vertex;  ///< vertex number of triangles[0]'s corner 0; each triangle has three of its own
};

/// Fills the chunk: its triangles, and the bins of the tiles that they touch. Throws std::length_error where the
/// bins' sizes add up to 2^32 or more.
void assemble(Chunk& chunk, std::span<const AssemblyWork> draws, const OtherTriangles& others, const Painting& painting,
              CullTriangles cull);

}  // namespace plumbline::pipeline
