// How many pixels of a frame will have more than one legal answer, predicted from the geometry and without counting
// them: a count far above it means that the oracle hides behind its own width.
#pragma once

#include <cstdint>
#include <span>

#include "capture/plane.h"
#include "reference/arithmetic/project.h"
#include "reference/oracle/pixel_hit.h"

namespace plumbline::math {

/// Pixels: the area of the bands, delta to either side, along all edges that can be seen. `id`: the winners in double.
double ambiguous_by_edges(const Scene& scene, const Projected& projected, const Plane<std::int32_t>& id);

/// What one pixel has of the bands along the lines where its winner meets another surface, or the near or far plane.
struct DepthShare {
  double area = 0;      ///< pixels, [0,1]
  bool centre = false;  ///< whether its centre is in one
};
DepthShare ambiguous_by_depth(const Scene& scene, std::span<const PixelHit> hits, std::int32_t winner);

}  // namespace plumbline::math
