// A pixel on the command line.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline::cli {

/// "X,Y", a pixel of the frame, (0, 0) in its first row's left corner. Throws std::invalid_argument, naming option,
/// text, and the frame's size.
glm::ivec2 parse_pixel(const std::string& option, const std::string& text, const FrameFormat& frame);

}  // namespace plumbline::cli
