// Ordinary scenes by seed: what a person draws in a first week. A floor, a few solids, a lamp, fog, a wireframe, a
// textbook's texture, a mirror, a shadow, a window pane, a model that came with another program.
//
// Written from the scene format's schema (tests/scenes/scene.schema.json). Shares nothing with src/campaign/hard but
// random numbers and JSON text: each may draw states that the other lacks.
#pragma once

#include "campaign/text/choices.h"

#include <string>

namespace plumbline::ordinary {

/// Text of a scene file, made of the numbers that `choices` hands out. Meshes and images that the scene names are in
/// the assets of the build and in tests/scenes/texture.
std::string ordinary_scene(campaign::Choices choices, const std::string& description);

}  // namespace plumbline::ordinary
