// Random scenes of the property tests, by number.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace plumbline::mutation {

/// Deterministic in seed and number.
Scene random_scene_of(std::uint64_t seed, int number);

}  // namespace plumbline::mutation
