// The continuous triangle, of which a picture holds samples (note 001, "Compare: the continuous triangle function").
#pragma once

#include "notes/raster/triangle_spans.h"

namespace plumbline::raster {

/// The area, in pixels, of the triangle inside the square of pixel (x, y), [0, 1]: what a display without jaggies would
/// show of it, where one sample shows 0 or 1. Cut by the square's four sides (Sutherland and Hodgman, 1974) in double.
/// Each cut leaves a point within 4 roundings of S, the farthest corner's distance in pixels; four cuts around a square
/// of four sides: an error of at most 64 * 2^-53 S. Corners within +-2^29.
double area_in_pixel(const Corners& corners, int x, int y);

/// The area of the whole triangle, in pixels: exact.
double area(const Corners& corners);

}  // namespace plumbline::raster
