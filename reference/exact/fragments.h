// Stages 6 and 7: a fragment's depth and attributes, real numbers.
#pragma once

#include <vector>

#include "reference/exact/barycentric.h"
#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::exact {

/// Window z at pixel (x, y)'s centre, or that of the frame's sample, by the plane through the corners, clamped to
/// [0,1]. Not in any depth format.
double depth_at(const WindowTriangle<double>& triangle, const Barycentric& weights, const FrameFormat& frame, int x,
                int y);

/// The perspective-correct colour at pixel (x, y)'s centre: sum(b_i c_i / w_i) / sum(b_i / w_i). Not clamped.
glm::dvec4 color_at(const WindowTriangle<double>& triangle, const Barycentric& weights, int x, int y);

/// Stage 6: depth_at() of each of records.covered. Throws std::invalid_argument as runs_by_triangle() does.
std::vector<double> fragment_depths(const Scene& scene, const Records<double>& records);

/// Stage 7: color_at() of each of records.covered. Throws std::invalid_argument as runs_by_triangle() does.
std::vector<Attributes<double>> fragment_attributes(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
