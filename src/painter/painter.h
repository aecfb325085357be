// The fast path from a scene to its frame: stages 0 to 12 in SIMD lanes and on threads, in memory that is kept from
// frame to frame. render() (pipeline/render.h) defines its bits.
//
//   vertices (paint_vertices.h)   stages 1, 2 and 4, each once, as many at a time as there are lanes
//   triangles (assemble.h)        culled and put into bins of tiles, in shares ("chunks") of the scene's primitives
//   tiles (paint_tile.h)          stages 5 to 11, each tile by one thread, triangles in draw order
//
// Clipped primitives, flat-shaded draws of lines, points or outlines, and draws lit at the vertices from two sides or
// with a colour material go through stages 0 to 4 one by one, by the definition (scalar_geometry.cpp).
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "painter/assemble.h"
#include "pipeline/frame.h"

namespace plumbline::pipeline {

/// The painter's kernels, of which the machine's are chosen at run time. Each draws the same bits.
struct SimdTarget {
  std::string_view name;  ///< "float" (one vertex, triangle or pixel at a time), "sse4", "avx2", "avx512"
  /// Vertices [from, to) of a draw; returns the OR of their outcodes.
  std::uint8_t (*vertices)(const VertexWork& work, std::size_t from, std::size_t to);
  CullTriangles cull;
  /// A tile of the frame.
  void (*tile)(const Painting& painting, int number, TileMemory& memory, Frame& frame);
};
/// Targets that this machine has, the widest last.
std::span<const SimdTarget> simd_targets();

class Painter {
 public:
  /// `threads`: from 1 to 256; beyond, the nearer of them.
  explicit Painter(int threads = 1, const SimdTarget& target = simd_targets().back());
  ~Painter();

  /// The frame is the painter's, until it draws the next; a caller may move it away. Another scene each time is fine.
  /// Its meshes' arrays are as long as scene.h says, normals as many as positions: nothing checks it here.
  Frame& draw(const Scene& scene);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// The frame by a painter of one thread, with the widest SIMD target.
Frame paint(const Scene& scene);

}  // namespace plumbline::pipeline
