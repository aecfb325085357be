// Our pipeline as a program that knows nothing of a scene but its export.
#pragma once

#include <filesystem>

#include "pipeline/frame.h"

namespace plumbline::test {

/// Draws the export of a scene of one sample a pixel, by stages 0 to 11.
pipeline::Frame drawn_from_export(const std::filesystem::path& folder);

}  // namespace plumbline::test
