// The fast path from a scene to its frame: stages 0 to 12 in SIMD lanes and on threads, in memory that is kept from
// frame to frame. render() (pipeline/render.h) defines its bits.
//
//   vertices (paint_vertices.h)   stages 1, 2 and 4 of each vertex once, as many at a time as there are lanes
//   triangles (assemble.h)        culled and put into bins of tiles, in shares ("chunks") of the scene's primitives
//   tiles (paint_tile.h)          stages 5 to 12, each tile by one thread, triangles in draw order
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

/// Kernels of the painter, compiled for one instruction set. All targets draw the same bits.
struct SimdTarget {
  std::string_view name;  ///< "float" (one vertex, triangle or pixel at a time), "sse4", "avx2", "avx512"
  /// Stages 1, 2 and 4 of vertices [from, to) of a draw; returns the OR of their outcodes.
  std::uint8_t (*vertices)(const VertexWork& work, std::size_t from, std::size_t to);
  CullTriangles cull;
  /// Stages 5 to 12 of the tiles that the counter deals out, from their clear values into `frame`.
  void (*tiles)(const Painting& painting, TileCounter& tiles, TileMemory& memory, Frame& frame);
};
/// Targets that this machine can run, the widest last. Static memory.
std::span<const SimdTarget> simd_targets();

/// Threads and memory that draw scenes, one call of draw() at a time.
class Painter {
 public:
  /// `threads`: clamped to [1, 256].
  explicit Painter(int threads = 1, const SimdTarget& target = simd_targets().back());
  ~Painter();

  /// Frame of the scene. The frame belongs to the painter and is overwritten by the next call; a caller may move it
  /// away. Not checked: that the arrays of the scene's meshes have the lengths that scene.h says. Throws
  /// std::invalid_argument where the projection is not one of the scene's dialect, std::length_error as assemble()
  /// does.
  Frame& draw(const Scene& scene);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Frame of the scene by a new painter of one thread, with the widest target.
Frame paint(const Scene& scene);

}  // namespace plumbline::pipeline
