// Exact area coverage: the continuous triangle that a picture samples (note 001, "Compare: the continuous triangle
// function").
#pragma once

#include "notes/raster/triangle_spans.h"

namespace plumbline::raster {

/// Area of the triangle within the square of pixel (x, y) [pixels, in [0, 1]]: the pixel's value on a display without
/// jaggies, where one sample gives 0 or 1. The square's four sides cut the triangle (Sutherland and Hodgman, 1974) in
/// double. Each cut moves a point by at most 4 roundings of S, the farthest corner's distance [pixels]: an error of at
/// most 64 * 2^-53 S. Corners within +-2^29.
double area_in_pixel(const Corners& corners, int x, int y);

/// Area of the whole triangle [pixels], rounded once: exact below 2^36 pixels. Corners within +-2^29.
double area(const Corners& corners);

}  // namespace plumbline::raster
