// Stages 6 and 7: a fragment's depth and attributes, not rounded to any format.
#pragma once

#include <vector>

#include "capture/conventions.h"
#include "capture/stages.h"
#include "reference/exact/barycentric.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Per-triangle input of depth_at(). Of the conventions, depth_rule() reads offset_unit and float_offset_unit.
struct DepthRule {
  glm::dvec2 place{0};       ///< sample offset from the pixel's centre [pixels]
  double low = 0, high = 1;  ///< range to which depths are clamped
  long double offset = 0;    ///< polygon offset, added before the clamp
};
DepthRule depth_rule(const Scene& scene, const Draw& draw, const WindowTriangle<double>& triangle,
                     const Barycentric& weights, const Conventions& conventions = {});

/// Window z of the plane through the corners at pixel (x, y)'s centre + rule.place, plus the polygon offset, clamped;
/// not rounded to the depth format.
double depth_at(const WindowTriangle<double>& triangle, const Barycentric& weights, const DepthRule& rule, int x,
                int y);

/// The perspective-correct colour at pixel (x, y)'s centre: sum(b_i c_i / w_i) / sum(b_i / w_i). Not clamped.
glm::dvec4 color_at(const WindowTriangle<double>& triangle, const Barycentric& weights, int x, int y);

/// Stage 6: depth_at() of each of records.covered. Throws std::invalid_argument as runs_by_triangle() does.
std::vector<double> fragment_depths(const Scene& scene, const Records<double>& records, const Conventions& conventions);

/// Stage 7: color_at() of each of records.covered. Throws std::invalid_argument as runs_by_triangle() does.
std::vector<Attributes<double>> fragment_attributes(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
