// Ramps two pixels wide and four high that begin just off the grid: corners as they are, and corners on the grid, give
// the same pixel two values.
#pragma once

#include <cmath>

#include "capture/conventions.h"

namespace plumbline::learn {

/// Distance in x of a ramp's beginning from its snapped position [pixels]: just under half a step of the grid (rounding
/// to the nearest) or a whole step (down or up).
inline double off_grid(const Conventions& c) {
  using enum Conventions::Rounding;
  const double share = c.subpixel_rounding == down ? 0.98 : c.subpixel_rounding == up ? -0.98 : 0.49;
  return std::ldexp(share, -c.subpixel_bits);
}

/// The pixel of a ramp that is looked at. Its sample lies inside, and off the diagonal of the ramp's two triangles,
/// wherever pixels are sampled.
struct RampPixel {
  int column;         ///< from the ramp's first whole column on: 0 or 1
  int row;            ///< from the ramp's lower side on
  double from_start;  ///< of the sample, from the ramp's snapped beginning [pixels]
};
inline RampPixel pixel_of_ramp(const Conventions& c) {
  const int column = c.sample.x < 0.25 ? 1 : 0;
  const double from_start = column + c.sample.x, diagonal = 2 * from_start;
  const auto off = [&](int row) { return std::abs(row + c.sample.y - diagonal); };
  return {column, off(1) > off(2) ? 1 : 2, from_start};
}

}  // namespace plumbline::learn
