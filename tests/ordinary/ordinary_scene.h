// Ordinary scenes by seed: what a person draws in a first week. A floor, a few solids, a lamp, fog, a wireframe, a
// textbook's texture, a mirror, a shadow, a window pane, a model that came with another program.
//
// Written from the scene format's schema (tests/scenes/scene.schema.json), and not from tests/property/random_scene.h:
// two authors miss different things, so the two generators share nothing.
#pragma once

#include <cstdint>
#include <string>

namespace plumbline::ordinary {

/// A scene file's text. The same seed gives the same text on every machine. Meshes and images that it names are in
/// the assets of the build and in tests/scenes/texture.
std::string ordinary_scene(std::uint64_t seed);

}  // namespace plumbline::ordinary
