// What each stage handed on as pictures, ours beside what was expected.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "stages/capture.h"
#include "stages/plane.h"

namespace plumbline::report {

/// One stage's picture, of the frame's size, the first row at the bottom.
struct StagePicture {
  Stage stage;
  std::string name;              ///< such as "depth": unique among a scene's pictures, and a file name
  std::string says;              ///< what its colours mean
  Plane<glm::vec4> mine;         ///< empty: not handed out
  Plane<glm::vec4> expected;     ///< likewise
  Plane<glm::vec4> differences;  ///< mine in grey, and red where the two differ, brighter the further they do; or empty
  std::size_t differing = 0;     ///< pixels
  double largest = 0;            ///< difference, in the values that are shown
};

/// Fragments counted; depth in false colours with contour lines; primitives; of the winners texture coordinates, texel
/// and level of detail; colours before and after merging; stencil values. In the order of the stages, those that either
/// side shows.
std::vector<StagePicture> stage_pictures(const Scene& scene, const Capture& mine, const Capture& expected);

/// The window triangles of both sides as an SVG drawing over the frame: expected in green, ours in red over it where it
/// is elsewhere. At most `most` triangles of a side are drawn, those that differ before others. Empty where neither has
/// any.
std::string positions_drawing(const Scene& scene, const Capture& mine, const Capture& expected,
                              std::size_t most = 5000);

}  // namespace plumbline::report
