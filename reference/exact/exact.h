// The exact reference: the specification's equations in double precision and integers, stage by stage.
#pragma once

#include <memory>

#include "capture/renderer.h"

namespace plumbline::exact {

/// A renderer named "exact". It draws a scene from unrounded double matrices, and runs each stage alone on the records
/// of any other renderer. Of its results only planes.depth is rounded to the frame's format: records.depth and
/// planes.color hold real numbers (clamped to [0,1] where the format is), so that a comparison sees how far a code is
/// from the truth. capture() throws OverBudget. run_stage() throws std::invalid_argument, naming the record, where the
/// given records do not fit the scene or each other.
std::unique_ptr<Renderer> make_exact();

}  // namespace plumbline::exact
