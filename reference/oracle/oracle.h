// The oracle: computes a frame's legal answers, and its planes in double, from a scene and the triangles found near
// each pixel.
#pragma once

#include <cstddef>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "reference/arithmetic/project.h"
#include "reference/oracle/candidates.h"

namespace plumbline::math {

/// The oracle's answer for a frame.
struct Oracle {
  Legal legal;
  /// Frame in double: no vertex snapped, no coordinate rounded. A triangle covers a pixel whose centre is inside (on an
  /// edge: tie rule left_bottom); where the declared grid and tie rule settle coverage (known_coverage.cpp), these
  /// decide. Depth and colour are rounded to the frame's formats.
  Planes planes;
  /// Fragments of these planes at the pixels that the request names, row by row, each pixel's in draw order: triangles
  /// (with `corners` 0: only primitive and front are known), covered, depth, shaded, drawn, as far as requested.
  Records<double> records;
};

/// Tests each candidate in double and finds the pixels' legal answers. `candidates` must have, in any order, every
/// triangle with which a legal renderer may cover a pixel. Of the request, reads `pixels`, `records` and
/// `memory_budget`. Throws OverBudget where the legal answers exceed the budget.
Oracle consult(const Scene& scene, const Projected& projected, const Candidates& candidates, const Request& request);

/// Number of candidates that fit the budget [bytes] beside planes and legal answers. Throws OverBudget where these
/// alone do not fit.
std::size_t candidate_budget(const Scene& scene, std::size_t memory_budget);

/// Legal answers of a scene by the request's conventions, with triangles found by boxes and by edges, without rays. If
/// the request names pixels: the answers at these pixels; at any other pixel the background is the only answer. Throws
/// OverBudget.
Legal legal_by_boxes(const Scene& of_dialect, const Request& request);

}  // namespace plumbline::math
