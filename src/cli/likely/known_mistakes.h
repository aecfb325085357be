// Mistakes that a frame may show: the known faults, and mistakes of a viewport, of a depth test, of writing the file.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cli/likely/frames_apart.h"
#include "cli/options/renderers.h"

namespace plumbline::cli {

/// A mistake, and what it changes: the scene, a stage, the finished frame.
struct Mistake {
  std::string stage, name, says;  ///< stage: "file" where the frame is written
  std::function<void(Scene&)> of_scene = {};
  std::string fault = {};  ///< its name, as `plumb list faults` has it
  std::function<void(ColorAndDepth&)> of_frame = {};
};

/// Whether the mistake is of one of these stages: one of the viewport is of `window`, one of a file of `merge`.
bool is_of(const StageSet& stages, const Mistake& mistake);

/// All that are known, less those of stages that are right (GivenFrame::right) and those that the conventions declare.
std::vector<Mistake> known_mistakes(const Scene& scene, const GivenFrame& given);

/// The scene's frame as plumbline's renderer draws it with these mistakes, its colours encoded as the conventions say.
ColorAndDepth draw_with(std::span<const Mistake* const> mistakes, const Scene& scene, const Conventions& conventions,
                        CutAt cut_at = CutAt::frame_sides);

}  // namespace plumbline::cli
