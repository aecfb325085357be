// A known fault that a frame may show.
#pragma once

#include <functional>
#include <string>

#include "cli/likely/frames_apart.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// A known fault, and what it changes: the scene, a stage, the finished frame.
struct KnownFault {
  std::string stage, name, says;  ///< stage: "file" where the frame is written
  std::function<void(Scene&)> of_scene = {};
  std::string of_stage = {};  ///< a name of `plumb list faults`; empty: the fault changes no stage
  std::function<void(ColorAndDepth&)> of_frame = {};
};

}  // namespace plumbline::cli
