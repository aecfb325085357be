// Prediction of the number of pixels with several legal answers, from the geometry alone. A count far above the
// prediction shows that the oracle's bounds are too wide.
#pragma once

#include <cstdint>
#include <span>

#include "capture/plane.h"
#include "reference/arithmetic/project.h"
#include "reference/oracle/pixel_hit.h"

namespace plumbline::math {

/// Predicted number of pixels that are ambiguous by edges: the area [pixels] of the bands within displacement()
/// (project.h) of all visible edges, or the number of pixel centres in these bands, whichever is larger. `id`: the
/// winners in double.
double ambiguous_by_edges(const Scene& scene, const Projected& projected, const Plane<std::int32_t>& id);

/// Share of one pixel in the bands along the lines where surfaces meet each other, the near or the far plane.
struct DepthShare {
  double area = 0;      ///< [pixels, in [0,1]]
  bool centre = false;  ///< the pixel's centre is in a band
};
/// `hits`: all hits of the pixel, in draw order. `winner`: the pixel's winner in double, or kBackground.
DepthShare ambiguous_by_depth(const Scene& scene, std::span<const PixelHit> hits, std::int32_t winner);

}  // namespace plumbline::math
