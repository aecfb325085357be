// What the painter's steps hand on (painter.h): vertices in one array, triangles as three of its numbers, bins of
// triangles' numbers. Its memory is kept from frame to frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernels/light_equation.h"
#include "painter/fragments.h"

namespace plumbline::pipeline {

/// Room for `count` values in memory that only grows; what is there stays.
template <class T>
T* room_for(std::size_t count, std::vector<T>& values) {
  if (count > values.size()) values.resize(count);
  return values.data();
}

/// Where a tile keeps its pixel (x, y), as pixel_offset() has it, of integers or lanes; and back.
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

/// A vertex in window space, as lanes load it.
struct PaintVertex {
  Vec3<float> p_win;
  float inv_w;
  glm::ivec2 snapped;
  Vec4<float> color;
};

/// A draw whose vertices go through stages 1, 2 and 4 at once, as many as there are lanes.
struct VertexWork {
  const Mesh* mesh;
  Matrices<float> matrices;
  Mat4<float> to_clip;
  bool normalizes;       ///< normals are divided by their own length
  float normal_divisor;  ///< else by this
  bool wants_normals;
  const Illumination* illumination;           ///< null: vertices have the mesh's colours, or `color`
  Reflectance<float> reflectance, secondary;  ///< as LitPart
  glm::vec4 color;
  PaintVertex* out;
  std::uint8_t* outside;
  std::array<Vec4<float>*, kVaryings> varyings;  ///< null: not carried
};

/// A window triangle (stages.h), its corners by number.
struct PaintTriangle {
  std::uint32_t corner[3];
  bool front;
  std::uint8_t corners;
  std::uint16_t width;
};
/// The tiles that it touches, last ones included.
struct TileBox {
  std::uint8_t x0, y0, x1, y1;
};

/// In 1/256 pixel: triangles with longer edges do not fit lanes (set_up_lanes.h).
inline constexpr std::int32_t kLongestEdge = 1 << 22;

/// A share of the scene's primitives, in draw order, and its own bins.
struct Chunk {
  std::uint32_t first_primitive, end_primitive;
  std::vector<PaintTriangle> triangles;
  std::vector<TileBox> boxes;
  std::uint32_t count = 0;
  bool any_long_edge = false;  ///< whether any may have an edge longer than kLongestEdge
  struct OfDraw {
    std::uint32_t draw, end;  ///< its triangles end there
  };
  std::vector<OfDraw> draws;
  std::vector<std::uint32_t> first;  ///< tile t has [first[t], first[t + 1]) of numbers
  std::vector<std::uint32_t> numbers;
};

/// Triangles of one chunk in a tile, of one draw or of consecutive draws that can_share_run() (paint_tile.h).
struct PaintRun {
  std::uint32_t draw;  ///< the first of them
  const PaintTriangle* triangles;
  std::span<const std::uint32_t> numbers;
};

/// All that the tiles of a frame are painted from.
struct Painting {
  FrameFormat format;
  Formats formats;
  /// Sample offsets from the pixel's centre [1/256 pixel]: the pass' own (Formats::sample), or the four of a
  /// multisampled pixel (takes_samples(), painter.cpp); within each_sample(), one of these.
  std::span<const glm::ivec2> samples;
  int columns, rows;  ///< of tiles
  const PaintVertex* vertices;
  std::array<const Vec4<float>*, kVaryings> varyings;  ///< beside vertices
  std::span<const Chunk> chunks;
  std::span<const PaintDraw> draws;
  bool any_long_edge;  ///< Chunk's

  /// Bounds of the samples.
  std::pair<glm::ivec2, glm::ivec2> sample_bounds() const {
    glm::ivec2 low = samples[0], high = low;
    for (const glm::ivec2& sample : samples) low = glm::min(low, sample), high = glm::max(high, sample);
    return {low, high};
  }
  /// Depth code that a tile is cleared to; for depth formats with codes.
  double clear_code() const { return depth_code(format.clear_depth, formats.depth_scale); }
};

/// A thread's own.
struct TileMemory {
  alignas(64) Tile tile;
  alignas(64) PackedTile packed[4];  ///< one, or one for each sample
  std::vector<PaintRun> runs;
};

}  // namespace plumbline::pipeline
