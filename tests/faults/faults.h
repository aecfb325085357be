// Bugs that people really make, each in one stage: a stage function of the pipeline replaced by one with the bug. The
// stages after it run as they are. They prove that the harness sees, and names, what breaks a renderer.
#pragma once

#include <span>
#include <string_view>

#include "pipeline/render.h"
#include "stages/stages.h"

namespace plumbline::faults {

struct Fault {
  std::string_view name;     ///< stage.bug
  std::string_view changes;  ///< what it does, in words
  Stage stage;               ///< the stage that must be named
  pipeline::Stages (*stages)();
};

/// All faults, by stage.
std::span<const Fault> all();

}  // namespace plumbline::faults
