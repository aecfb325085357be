// Building blocks of faults, and bugs that several lists name.
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "faults/fault.h"
#include "faults/pixel_barycentrics.h"
#include "kernels/coverage.h"
#include "pipeline/geometry.h"
#include "pipeline/stages.h"

namespace plumbline::faults {

using pipeline::Barycentric;
using pipeline::Color;
using pipeline::Pixels;
using pipeline::Stages;
using Triangle = pipeline::WindowTriangle;
using Setup = pipeline::TriangleSetup;
using pipeline::PixelBounds;
using PixelList = std::vector<glm::ivec2>;

/// Puts `function` in the place of one stage function: a member of Stages, or of its ResolveStage.
template <auto member, auto function>
void put(Stages& stages) {
  if constexpr (requires { stages.*member; }) {
    stages.*member = function;
  } else {
    stages.resolve.*member = function;
  }
}

/// A fault of the stage whose name its own begins with: "coverage.inclusive_edges".
constexpr Fault stage_fault(std::string_view name, std::string_view changes, void (*apply)(Stages&),
                            std::string_view report = {}) {
  for (const Stage stage : kAllStages) {
    if (name.substr(0, name.find('.')) == name_of(stage)) return {name, changes, stage, apply, report};
  }
  throw std::logic_error("the fault's name begins with no stage");
}

/// Coverage by another tie rule. owns(step_x, step_y): whether the triangle has the pixels on an edge whose function
/// has these steps. The vector (step_x, step_y) points into the triangle.
template <bool (*owns)(std::int64_t, std::int64_t)>
PixelList tied(const Triangle& triangle, const PixelBounds& box) {
  if (triangle.corners != 3) return pipeline::covered_pixels(triangle, box);
  pipeline::Edges e = pipeline::edges_of(triangle);
  for (int i = 0; i < 3; ++i) {
    const bool owned = e.step_x[i] > 0 || (e.step_x[i] == 0 && e.step_y[i] > 0);
    if (!owned) ++e.at_origin[i];
    if (!owns(e.step_x[i], e.step_y[i])) --e.at_origin[i];
  }
  return pipeline::covered_pixels(e, pipeline::pixel_bounds(triangle), box);
}

inline bool all_edges_in(std::int64_t, std::int64_t) { return true; }

inline Color<float> affine_attributes(const Setup& s, const pipeline::AttributeSetup& of, const Pixels<float>& p) {
  const pipeline::PerspectiveSetup none = pipeline::perspective_setup({1, 1, 1}, s.planes, s.perspective.in_blocks);
  return pipeline::mean<float>(of, pipeline::weights<float>(none, pipeline::from_anchor<float>(s.planes, p)));
}

/// Difference of window z at a pass' sample from window z where the pass takes colours.
inline double z_of_sample(const Setup& s) {
  const double there = pipeline::depth_plane(s.depth, s.planes).code.at_0;
  return (s.depth_plane.code.at_0 - there) / (s.depth.scale == 0 ? 1 : s.depth.scale);
}
/// Window z at a pass' sample, clamped as stage 6 does (DepthState).
inline double window_z(const Setup& s, const Pixels<float>& p) {
  const Barycentric b = pipeline::barycentric(s.planes, p);
  return std::clamp(s.depth.z0 + b.l1 * s.depth.dz1 + b.l2 * s.depth.dz2 + z_of_sample(s), s.depth.low, s.depth.high);
}
/// The pipeline's own depth, in the depth format.
inline float right_depth(const Setup& s, const Pixels<float>& p) {
  return pipeline::depth<float>(s.depth_plane, pipeline::from_anchor<float>(s.planes, p));
}
inline pipeline::Weights<float> weights_of(const Setup& s, const Pixels<float>& p) {
  return pipeline::weights<float>(s.perspective, pipeline::from_anchor<float>(s.planes, p));
}
/// Window z, clamped to the draw's range, in the triangle's depth format: a code, or a float.
inline float stored_depth(const pipeline::DepthSetup& s, double z) {
  const double unit = s.scale == 0 ? 1 : s.scale;
  return pipeline::depth<float>({{z * unit, 0, 0}, s.scale, s.low * unit, s.high * unit}, {0, 0});
}

}  // namespace plumbline::faults
