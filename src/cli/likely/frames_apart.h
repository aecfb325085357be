// Pixels in which two frames differ.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "capture/conventions.h"
#include "capture/plane.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// Frame that a renderer left: rows in the scene's order. Depth, window z, may be empty.
struct ColorAndDepth {
  Plane<glm::vec4> color;
  Plane<double> depth;
};

/// A frame, by whose conventions it is drawn, and which of its pixels are legal.
struct GivenFrame : ColorAndDepth {
  Conventions conventions;
  /// 1: the pixel is legal. Where it differs from ours, it counts for no fault, and against none. Empty: not known.
  Plane<std::uint8_t> is_legal;
  bool has_alpha = false;  ///< else nothing is told by alpha
  StageSet right{};        ///< stages that are judged right, or given: their faults are no causes
  StageSet wrong{};        ///< stages that are wrong of what they were given: their faults are named before others
};

/// Rule of what counts as a difference: coarse, more than a code of 8 bits and a step of depth, with alpha or without;
/// fine, half a code, or a quarter of a step, which only truncation makes.
enum Look { kCoarseByAlpha, kCoarse, kFineColor, kFineDepth };
constexpr std::size_t kLooks = 4;
constexpr bool is_fine(Look look) { return look >= kFineColor; }
/// Pixels that differ, by each look.
using Apart = std::array<std::size_t, kLooks>;

/// Red, green or blue differ by more than so many codes of 8 bits, or b's are no numbers; alpha, too, if asked.
bool colors_apart(const glm::vec4& a, const glm::vec4& b, float codes, bool by_alpha = false);

/// Pixels in which frames differ from the one given; where a legal one differs from `ours`, none.
class FramesApart {
 public:
  FramesApart(DepthFormat format, const GivenFrame& given, const ColorAndDepth& ours);
  Apart from(const ColorAndDepth& frame) const;

 private:
  DepthFormat format_;
  const GivenFrame& given_;
  std::array<std::vector<std::uint8_t>, kLooks> passed_over_;
};

}  // namespace plumbline::cli
