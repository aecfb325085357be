// Pictures of each stage's output, the candidate's beside the expected.
#pragma once

#include <string>
#include <vector>

#include "capture/capture.h"
#include "report/page/viewer_data.h"
#include "scene/scene.h"

namespace plumbline::report {

/// Layers of fragment counts; depth; the winners' texture coordinates, texel, level of detail and unmerged colour;
/// winning primitives; stencil values; the frame. In stage order, without those that neither side shows.
std::vector<Layer> stage_layers(const Scene& scene, const Capture& mine, const Capture& expected);

/// The window triangles of both sides as an SVG drawing over the frame: where they differ, expected ones in green and
/// the candidate's in red over them. At most 2 `most` triangles are drawn, both sides together, differing ones first.
/// Empty where `mine` has none.
std::string positions_drawing(const Scene& scene, const Capture& mine, const Capture& expected,
                              std::size_t most = 5000);

}  // namespace plumbline::report
