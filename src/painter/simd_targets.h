// The painter's kernels (painter.h), with dispatch at run time. One source; every target makes the same bits.
#pragma once

#include <span>
#include <string_view>

#include "painter/assemble.h"

namespace plumbline::pipeline {

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

}  // namespace plumbline::pipeline
