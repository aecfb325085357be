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

/// A frame to be explained, the conventions that it is drawn by, and what is known about it.
struct GivenFrame : ColorAndDepth {
  Conventions conventions;
  /// 1: the pixel is legal; where it differs from ours, from() leaves it out, against() counts it. Empty: not known.
  Plane<std::uint8_t> is_legal{};
  /// Legality of the colour alone: the depth may be wrong.
  Plane<std::uint8_t> is_legal_color{};
  /// Legality of the depth alone: where it differs from ours, the pixel counts by its colour. Clear depths, which
  /// stage merge judges, are not meant.
  Plane<std::uint8_t> is_legal_depth{};
  /// 1: our frame, drawn without a fault, is wrong by the conventions here: the pixel tells nothing. Empty: none.
  Plane<std::uint8_t> is_wrong_in_ours{};
  bool has_alpha = false;  ///< alpha is known; else it is not compared
  StageSet right{};        ///< stages that are judged right, or given: their faults are no causes
  StageSet wrong{};        ///< stages that are wrong on their own input: their faults are named before others
};

/// Threshold of a difference. Coarse: beyond 1.5 codes of 8 bits or 1.5 steps of depth, with alpha or without, or by
/// colour alone, whatever the depths, or by depth alone. Nearer: by colour alone, where the frame is not four times as
/// near as ours: approximations of the renderer, as of levels of detail, count little beside a mistake. Fine: beyond
/// half a code, or a quarter of a step, which only truncation makes. A frame that is half as far as ours, or farther,
/// differs by every look.
enum Look { kCoarseByAlpha, kCoarse, kCoarseColor, kNearerColor, kCoarseDepth, kFineColor, kFineDepth };
constexpr std::size_t kLooks = 7;
constexpr bool is_of_color(Look look) { return look == kCoarseColor || look == kNearerColor || look == kFineColor; }
constexpr bool is_fine(Look look) { return look >= kFineColor; }
/// Number of pixels that differ, by Look.
using Apart = std::array<std::size_t, kLooks>;

/// Whether r, g or b, clamped to [0,1], differ by more than `codes` [1/255], or one is NaN.
bool colors_apart(const glm::vec4& a, const glm::vec4& b, float codes);

/// Whether a depth is the clear depth, within a code of 16 bits.
bool is_clear_depth(const FrameFormat& format, double z);

/// Counts the pixels in which a frame differs from the given one, except those that are legal and differ from `ours`,
/// and those that are wrong in `ours`.
class FramesApart {
 public:
  /// `given` and `ours` have to outlive it.
  FramesApart(const FrameFormat& format, const GivenFrame& given, const ColorAndDepth& ours);
  Apart from(const ColorAndDepth& frame) const;
  /// Legal pixels that differ from ours, by what they say of a fault's frame.
  struct Legal {
    Apart against{};  ///< the fault's frame differs from both: they contradict it
    Apart drawn{};    ///< the fault's frame does not differ from the given one
  };
  Legal legal(const ColorAndDepth& frame) const;

 private:
  /// Whether the frame's depth at pixel i differs from ours.
  bool is_depth_beyond_ours(const ColorAndDepth& frame, std::size_t i, Look look) const;

  DepthFormat format_;
  const GivenFrame& given_;
  const ColorAndDepth& ours_;
  enum Counted : std::uint8_t { whole, by_color, passed_over, left_out };
  std::vector<std::array<Counted, kLooks>> counted_;  // of each pixel
  std::vector<float> rgb_from_ours_;                  // of each pixel: its distance in colour
};

}  // namespace plumbline::cli
