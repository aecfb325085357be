// What one renderer handed out for one scene: records of stages, and planes.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "capture/legal.h"
#include "capture/plane.h"
#include "capture/stages.h"

namespace plumbline {

/// Planes of the frame's size, or empty: not asked for, or not shown.
struct Planes {
  Plane<std::uint32_t> count;   ///< coverage: fragments of all primitives at the pixel, before any depth test
  Plane<std::uint64_t> id_sum;  ///< coverage: sum of id_weight(primitive) over those fragments
  Plane<std::int32_t> id;       ///< visibility: the winning primitive, or kBackground
  Plane<glm::vec4> texel;       ///< texture: the winner's texel, (0, 0, 0, 1) without a texture, 0 in the background;
                                ///< empty where no draw has one
  Plane<glm::vec4> shaded;      ///< attributes, shade: the winner's colour in float, the clear colour elsewhere
  Plane<glm::vec4> color;       ///< merge: the frame's colour; n-bit codes as code / (2^n - 1)
  Plane<std::uint8_t> stencil;  ///< visibility: the stencil values that the tests leave, where the frame has any
  Plane<double> depth;          ///< merge: the frame's depth as window z; n-bit codes as code / (2^n - 1)
};

/// Weight of a primitive in three 12-bit parts: sums of up to 4096 weights stay below 2^24 in each part, and so are
/// exact in an RGBA32F target. Part 0 is the number's low 12 bits, part 1 the next 12, part 2 12 bits of a hash, which
/// distinguishes pairs of numbers with equal sums.
constexpr std::uint32_t id_weight_part(std::uint32_t primitive, int part) {
  if (part == 0) return primitive & 0xfffu;
  if (part == 1) return (primitive >> 12) & 0xfffu;
  std::uint32_t h = (primitive ^ (primitive >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return (h >> 15) & 0xfffu;
}
/// The three parts in one integer, 20 bits apart: sums of up to 256 weights do not carry from part to part.
constexpr std::uint64_t id_weight(std::uint32_t primitive) {
  return static_cast<std::uint64_t>(id_weight_part(primitive, 0)) |
         static_cast<std::uint64_t>(id_weight_part(primitive, 1)) << 20 |
         static_cast<std::uint64_t>(id_weight_part(primitive, 2)) << 40;
}

/// Origin of window.snapped: handed out by the renderer, or p_win snapped by the conventions.
enum class SnappedBy { renderer, conventions };

struct Capture {
  std::string renderer;  ///< name of the renderer
  std::string version;   ///< the renderer's (RendererInfo)
  int width = 0;
  int height = 0;
  Records<double> records;
  Planes planes;
  /// Frame colours of each pass of an antialiased scene. The capture of such a scene holds no records, and of planes
  /// only color and depth: the passes' own captures hold the rest.
  std::vector<Plane<glm::vec4>> samples;
  /// Columns that a capture folder leaves out and complete_records() fills in, such as "window.front".
  std::set<std::string> derived;
  std::set<std::string> without_records;  ///< groups whose arrays a folder holds with 0 records, such as "window"
  SnappedBy snapped_by = SnappedBy::renderer;
  std::size_t files_of_arrays = 0;  ///< number of files that a folder's manifest names
  bool depth_in_float = false;      ///< planes.depth was read from f32: complete_records() finds the codes
  Legal legal;                      ///< an oracle's legal answers for each pixel
};

}  // namespace plumbline
