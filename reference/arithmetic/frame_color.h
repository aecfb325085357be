// The colour of one pixel of the frame, as fragments are written to it (OpenGL 2.1 spec 4.1.8, 4.1.10, 4.2.2), in
// intervals: what may be there where a colour is known to a bound only, or its rounding may go either way. The interval
// is never narrower than what is legal.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "capture/conventions.h"
#include "scene/scene.h"

namespace plumbline::math {

struct Interval {
  double lo, hi;
};
using ColorInterval = std::array<Interval, 4>;

/// color +- bound, per channel.
ColorInterval around(const glm::dvec4& color, double bound);
glm::vec4 low(const ColorInterval& color);
glm::vec4 high(const ColorInterval& color);
glm::dvec4 middle(const ColorInterval& color);

class FrameColor {
 public:
  /// Cleared. Where colours are blended in codes, each factor and each product may be half a code off.
  explicit FrameColor(const FrameFormat& frame, Conventions::Blending blending = Conventions::Blending::in_float);

  /// A fragment's colour is blended or combined with what is there, masked, and stored in the frame's format.
  void write(const Merge& state, const ColorInterval& color);

  /// What was last written to each channel, clamped to the format's range but not yet rounded to codes (rgba32f:
  /// rounded to float); codes as code / (2^n - 1).
  ColorInterval written() const;

 private:
  double unit_;  // the largest code; 1 for float, which is neither clamped nor rounded to codes
  bool codes_;
  bool blends_codes_;
  ColorInterval written_, stored_;  // times unit_
};

}  // namespace plumbline::math
