// How many pixels of a frame will have more than one legal answer, predicted from the geometry and without counting
// them: a count far above it means that the oracle hides behind its own width.
#pragma once

#include <cstdint>
#include <span>

#include "reference/math/pixel_hit.h"
#include "reference/math/project.h"
#include "stages/plane.h"

namespace plumbline::math {

/// Pixels: the area of the bands, delta to either side, along all edges that can be seen. `id`: the winners in double.
double ambiguous_by_edges(const Scene& scene, const Projected& projected, const Plane<std::int32_t>& id);

/// One pixel's share, in [0,1], of the bands along the lines where its winner meets another surface.
double ambiguous_by_depth(const FrameFormat& frame, std::span<const PixelHit> hits, std::int32_t winner);

}  // namespace plumbline::math
