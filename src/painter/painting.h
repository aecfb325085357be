// Data that the painter's steps (painter.h) hand on: vertices in one array, triangles as three indices of vertices,
// bins of indices of triangles. The memory is kept from frame to frame.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernels/light_equation.h"
#include "painter/fragments.h"

namespace plumbline::pipeline {

/// Data of `values`, grown to at least `count` values; existing values stay.
template <class T>
T* room_for(std::size_t count, std::vector<T>& values) {
  if (count > values.size()) values.resize(count);
  return values.data();
}

/// Index of pixel (x, y) in a tile's arrays, as pixel_offset() (tile.h), for integers or lanes; and the inverses:
/// column and row of an index.
template <class I>
[[gnu::always_inline]] inline I place_in_tile(const I& x, const I& y) {
  const I within(kBlock - 1);
  return shifted_left<8>(shifted_right<2>(y)) + shifted_left<4>(shifted_right<2>(x)) + shifted_left<2>(y & within) +
         (x & within);
}
template <class I>
[[gnu::always_inline]] inline I x_of_place(const I& place) {
  return (shifted_right<2>(place) & I(kTile - kBlock)) | (place & I(kBlock - 1));
}
template <class I>
[[gnu::always_inline]] inline I y_of_place(const I& place) {
  return (shifted_right<6>(place) & I(kTile - kBlock)) | (shifted_right<2>(place) & I(kBlock - 1));
}

/// Vertex outcode. Bits 0-5: violated clip planes in the order of geometry.h's view_volume().
inline constexpr std::uint8_t kNotFinite = 1 << 6;    ///< bit 6: a coordinate is not finite
inline constexpr std::uint8_t kNotDrawable = 1 << 7;  ///< bit 7: outside the drawable window range (geometry.h)

/// Vertex in window space, in the layout that lanes load and store: eight floats. Its snapped position stands beside it
/// (Painting::snapped), for culling reads nothing else.
struct alignas(32) PaintVertex {
  Vec3<float> p_win;
  float inv_w;
  Vec4<float> color;
};

/// Per-draw input and output of stages 1, 2 and 4 in lanes. Output arrays have one entry per vertex of the draw.
struct VertexWork {
  const Mesh* mesh;
  Matrices<float> matrices;
  Mat4<float> to_clip;  ///< clip_matrix()
  bool normalizes;      ///< normals are divided by their length, else by normal_divisor
  float normal_divisor;
  bool wants_normals;                         ///< light or a varying needs n_eye
  const Illumination* illumination;           ///< null: vertices have the mesh's colours, or `color`
  Reflectance<float> reflectance, secondary;  ///< of the front's LitParts
  glm::vec4 color;                            ///< unlit vertices without colours, [0,1]
  PaintVertex* out;
  glm::ivec2* snapped;                           ///< snapped positions [1/256 pixel]
  std::uint8_t* outside;                         ///< outcodes
  std::array<Vec4<float>*, kVaryings> varyings;  ///< null: not carried
};

/// Window triangle, line or point (window_triangle.h), its corners as indices of Painting::vertices.
struct PaintTriangle {
  std::uint32_t corner[3];
  bool front;
  std::uint8_t corners;
  std::uint16_t width;
};
/// Tiles that a primitive may touch: columns x0 to x1 and rows y0 to y1, both included.
struct TileBox {
  std::uint8_t x0, y0, x1, y1;
};

/// Longest edge, along x or y, of a triangle that fits lanes [1/256 pixel] (set_up_lanes.h).
inline constexpr std::int32_t kLongestEdge = 1 << 22;

/// Share of the scene's primitives, [first_primitive, end_primitive): its triangles in draw order, and their bins.
struct Chunk {
  std::uint32_t first_primitive, end_primitive;
  std::vector<PaintTriangle> triangles;  ///< `count` are in use
  std::vector<TileBox> boxes;            ///< beside triangles
  std::uint32_t count = 0;
  bool any_long_edge = false;  ///< whether a triangle has an edge longer than kLongestEdge
  struct OfDraw {
    std::uint32_t draw, end;  ///< the draw's number, and the end of its triangles
  };
  std::vector<OfDraw> draws;           ///< draws with triangles, in draw order
  std::vector<std::uint32_t> first;    ///< the bin of tile t is [first[t], first[t + 1]) of numbers
  std::vector<std::uint32_t> numbers;  ///< of triangles, ascending within a bin
};

/// Triangles of one chunk in a tile, of one draw or of consecutive draws that can_share_run() (paint_tile.h).
struct PaintRun {
  std::uint32_t draw;  ///< the first of the draws
  const PaintTriangle* triangles;
  std::span<const std::uint32_t> numbers;  ///< indices of `triangles`, in draw order
};

/// Input of stages 5 to 11 of all tiles of a frame.
struct Painting {
  FrameFormat format;
  Formats formats;
  /// Sample offsets from the pixel's centre [1/256 pixel]: the pass' own (Formats::sample), or the four of a
  /// multisampled pixel (takes_samples(), painter.cpp); within each_sample(), one of these.
  std::span<const glm::ivec2> samples;
  int columns, rows;  ///< of tiles
  const PaintVertex* vertices;
  const glm::ivec2* snapped;                           ///< beside vertices: snapped positions [1/256 pixel]
  std::array<const Vec4<float>*, kVaryings> varyings;  ///< beside vertices
  std::span<const Chunk> chunks;
  std::span<const PaintDraw> draws;
  bool any_long_edge;  ///< OR of the chunks'

  /// Least and greatest sample offsets in x and y [1/256 pixel].
  std::pair<glm::ivec2, glm::ivec2> sample_bounds() const {
    glm::ivec2 low = samples[0], high = low;
    for (const glm::ivec2& sample : samples) low = glm::min(low, sample), high = glm::max(high, sample);
    return {low, high};
  }
  /// Depth code that a tile is cleared to; for depth formats with codes.
  double clear_code() const { return depth_code(format.clear_depth, formats.depth_scale); }
};

/// Counter that deals out a frame's tiles, numbered row by row, to its threads. A claim is a share of the tiles left,
/// down to one tile: few claims, for an atomic operation waits until the thread's streamed stores are in memory, and
/// threads that end at about the same time.
class TileCounter {
 public:
  TileCounter(int tiles, int threads) : tiles_(tiles), per_claim_(4 * threads) {}

  struct Range {
    int begin, end;
  };
  /// Tiles for the calling thread; none where all are dealt out.
  Range claim() {
    int begin = next_, end = 0;
    do {
      end = begin + (tiles_ - begin + per_claim_ - 1) / per_claim_;
    } while (!next_.compare_exchange_weak(begin, end));
    return {begin, end};
  }

 private:
  const int tiles_, per_claim_;
  std::atomic<int> next_{0};
};

/// Working memory of one thread.
struct TileMemory {
  alignas(64) Tile tile;
  alignas(64) PackedTile packed[4];  ///< one, or one for each sample
  std::vector<PaintRun> runs;
};

}  // namespace plumbline::pipeline
