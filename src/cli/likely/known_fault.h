// A known fault that a frame may show.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/likely/frames_apart.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// A known fault, and what it changes: the scene, stages, the finished frame.
struct KnownFault {
  std::string stage, name, says;  ///< stage: "file" where the frame is written
  std::function<void(Scene&)> of_scene = {};
  std::vector<std::string> of_stages = {};  ///< names of `plumb list faults`, a stage each
  std::function<void(ColorAndDepth&)> of_frame = {};
  bool is_contradicted = false;  ///< the conventions declare otherwise: named only if it alone explains all pixels
  std::string lifts = {};  ///< the fault that the conventions declare as a rounding, and the renderer does not have
};

}  // namespace plumbline::cli
