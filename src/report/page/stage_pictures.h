// What each stage handed on as pictures, ours beside what was expected.
#pragma once

#include <string>
#include <vector>

#include "capture/capture.h"
#include "report/page/viewer_data.h"
#include "scene/scene.h"

namespace plumbline::report {

/// Fragments counted; depth; of the winners texture coordinates, texel, level of detail and the colour before it is
/// merged; the winning primitives; stencil values; the frame. In the order of the stages, those that either side shows.
std::vector<Layer> stage_layers(const Scene& scene, const Capture& mine, const Capture& expected);

/// The window triangles of both sides as an SVG drawing over the frame: expected in green, `mine` in red over them where
/// it lies elsewhere. At most 2 `most` triangles are drawn, both sides together, those that differ before the others.
/// Empty where `mine` has none.
std::string positions_drawing(const Scene& scene, const Capture& mine, const Capture& expected,
                              std::size_t most = 5000);

}  // namespace plumbline::report
