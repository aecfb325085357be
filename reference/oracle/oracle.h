// The oracle: from a scene and the triangles found near each pixel to the frame's legal answers and double's own
// planes.
#pragma once

#include <cstddef>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "reference/arithmetic/project.h"
#include "reference/oracle/candidates.h"

namespace plumbline::math {

/// What the oracle says of a frame. In the planes a triangle covers a pixel where the pixel's centre is inside it in
/// double (on an edge, by TieRule::small_sides_in), no vertex snapped and no coordinate rounded, but where the declared
/// grid and tie rule settle coverage (known_coverage.cpp); depth and colour are rounded to the frame's formats.
struct Oracle {
  Legal legal;
  Planes planes;
  /// Where the request names pixels: all that these planes have there, pixel by pixel, each in draw order: triangles
  /// (of no corners: primitive and front are all that is known of them), covered, depth, shaded, drawn, as asked for.
  Records<double> records;
};

/// Confirms each candidate in double and finds the pixels' legal answers. Candidates: every triangle that a legal
/// renderer may cover a pixel with, in any order. Of the request, only `pixels` and `records` are read.
Oracle consult(const Scene& scene, const Projected& projected, const Candidates& candidates, const Request& request);

/// Throws OverBudget where planes and legal answers would not fit; else how many candidates the rest holds.
std::size_t candidate_budget(const Scene& scene, std::size_t memory_budget);

/// The legal answers of a scene, drawn by the request's conventions, with no rays cast: triangles found by boxes and by
/// edges. Where the request names pixels, of these; elsewhere the background is the only answer. Throws OverBudget.
Legal legal_by_boxes(const Scene& of_dialect, const Request& request);

}  // namespace plumbline::math
