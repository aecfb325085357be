// The colour of one pixel of the frame, as fragments are written to it (OpenGL 2.1 spec 4.1.8, 4.1.10, 4.2.2), in
// interval arithmetic: the values possible where colours have an error bound or a rounding may go either way. An
// interval holds all legal values, and may be wider.
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

/// `v` rounded to a whole number.
double to_whole(Conventions::Rounding rounding, double v);

/// color +- bound, per channel.
ColorInterval around(const glm::dvec4& color, double bound);
/// Lower and upper ends, rounded to the nearest float, and middle of each channel. Rounding is monotone: every float of
/// the interval stays within its rounded ends.
glm::vec4 low(const ColorInterval& color);
glm::vec4 high(const ColorInterval& color);
glm::dvec4 middle(const ColorInterval& color);

/// True: the factors sum to 1, so that a renderer may have s a + d (1 - a) as d + a (s - d).
bool are_complements(BlendFactor a, BlendFactor b);

/// Numbers that a renderer blends in. Their roundings decide which of two codes a sum half way between the two becomes.
enum class BlendedIn { doubles, floats };

class FrameColor {
 public:
  /// A pixel of the clear colour. `blending` in_codes: `rounding` makes codes of each factor and of each product, too;
  /// in_codes_down: of each factor, and products are rounded down.
  /// `rounding`: of colours to the codes that are stored and read again.
  explicit FrameColor(const FrameFormat& frame, Conventions::Blending blending = Conventions::Blending::in_float,
                      Conventions::Rounding rounding = Conventions::Rounding::nearest,
                      BlendedIn numbers = BlendedIn::doubles);

  /// Blends a fragment's colour with the stored one, or combines their codes by the logic op, and stores the channels
  /// that the mask leaves, in the frame's format.
  void write(const Merge& state, const ColorInterval& color);

  /// Colour last written to each channel, clamped to the format's range, not rounded to codes [1: the largest code].
  /// After a logic op: the middle of the colours that round to the op's code. rgba32f: rounded to float.
  ColorInterval written() const;

 private:
  double unit_;  // the largest code; 1 for rgba32f, which is neither clamped nor rounded to codes
  bool codes_;
  bool blends_codes_;
  bool blends_in_float_;
  bool truncates_products_;
  Conventions::Rounding rounding_;
  ColorInterval written_, stored_;  // times unit_
};

}  // namespace plumbline::math
