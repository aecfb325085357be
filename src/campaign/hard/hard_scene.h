// Hard scenes by seed: geometry and state at which pipelines break, in all states of the scene format.
//
// Written from the scene format's schema and from what hurts (builder.h). Shares nothing with src/campaign/ordinary but
// random numbers and JSON text: what one author forgets, the other may not.
#pragma once

#include "campaign/text/choices.h"

#include <string>

namespace plumbline::hard {

/// A scene file's text, of the numbers that `choices` hands out. It names no mesh file and no image file.
std::string hard_scene(campaign::Choices choices, const std::string& description);

/// A scene of the same geometry in the state of a rasterizer's first weeks: opaque filled triangles by OpenGL's rules,
/// in the colours of their corners or in one, unlit, without textures, by the depth test `less`, some culled.
std::string plain_scene(campaign::Choices choices, const std::string& description);

}  // namespace plumbline::hard
