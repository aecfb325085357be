// States of a scene: keys and values of the scene format, and outcomes of the stages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline::campaign {

/// A set of states: bit i % 8 of byte i / 8 is state i.
using StateBits = std::string;
inline bool has_state(std::string_view bits, std::size_t state) {
  return state / 8 < bits.size() && ((static_cast<unsigned char>(bits[state / 8]) >> (state % 8)) & 1u) != 0;
}

/// Names of all states, by number: "depth_func less", "clip: a vertex behind the eye".
const std::vector<std::string>& state_names();

/// States of a scene. `drawn`: the scene's capture; outcomes of stages without records are left out.
StateBits states_of(const Scene& scene, const Capture& drawn);

}  // namespace plumbline::campaign
