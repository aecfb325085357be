// Stages 6 and 7: a fragment's depth and attributes, real numbers.
#pragma once

#include <vector>

#include "capture/stages.h"
#include "reference/exact/barycentric.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// What a draw says of a triangle's depths.
struct DepthRule {
  glm::dvec2 place{0};       ///< of the frame's sample, from the pixel's centre
  double low = 0, high = 1;  ///< depths beyond are clamped
  long double offset = 0;    ///< is added before
};
DepthRule depth_rule(const Scene& scene, const Draw& draw, const WindowTriangle<double>& triangle,
                     const Barycentric& weights);

/// Window z at pixel (x, y)'s centre, or that of the frame's sample, by the plane through the corners, moved and
/// clamped. Not in any depth format.
double depth_at(const WindowTriangle<double>& triangle, const Barycentric& weights, const DepthRule& rule, int x,
                int y);

/// The perspective-correct colour at pixel (x, y)'s centre: sum(b_i c_i / w_i) / sum(b_i / w_i). Not clamped.
glm::dvec4 color_at(const WindowTriangle<double>& triangle, const Barycentric& weights, int x, int y);

/// Stage 6: depth_at() of each of records.covered. Throws std::invalid_argument as runs_by_triangle() does.
std::vector<double> fragment_depths(const Scene& scene, const Records<double>& records);

/// Stage 7: color_at() of each of records.covered. Throws std::invalid_argument as runs_by_triangle() does.
std::vector<Attributes<double>> fragment_attributes(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
