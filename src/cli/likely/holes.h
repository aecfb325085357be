// Pixels of another renderer's frame that lack a surface, or have one too many.
#pragma once

#include <string>

#include "cli/likely/frames_apart.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// Lines for people: how many of the wrong pixels are as the frame was cleared where something is to be drawn, and how
/// many are drawn where nothing is; how many, of the depth range 0 to 1, have a depth beyond a plane. Wrong: not legal
/// or, where that is not known, unlike ours. Empty where pixels without their surface, or with one too many, are less
/// than half of the wrong ones, and for an antialiased scene.
std::string holes_text(const Scene& scene, const GivenFrame& given);

}  // namespace plumbline::cli
