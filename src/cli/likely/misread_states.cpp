#include "cli/likely/misread_states.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "cli/likely/misread_state.h"

namespace plumbline::cli {

namespace {

bool are_fragments_lit_alone(const Scene& scene) {
  return std::ranges::any_of(scene.draws, is_lit_per_fragment) && std::ranges::none_of(scene.draws, is_lit_per_vertex);
}

// In the order of the stages.
std::vector<MisreadState> all_states() {
  std::vector<MisreadState> out = states_of_geometry();
  std::ranges::move(states_of_textures(), std::back_inserter(out));
  std::ranges::move(states_of_merge(), std::back_inserter(out));
  return out;
}

}  // namespace

std::vector<KnownFault> misread_states() {
  std::vector<KnownFault> out;
  for (const MisreadState& state : all_states()) {
    out.push_back({.stage = state.stage,
                   .name = std::string(state.stage) + "." + state.name,
                   .says = state.says,
                   .of_scene = [change = state.change](Scene& s) { change(s); }});
  }
  return out;
}

std::vector<KnownFault> misread_states(const Scene& scene) {
  std::vector<KnownFault> out;
  const std::vector<MisreadState> states = all_states();
  std::vector<KnownFault> all = misread_states();
  for (std::size_t i = 0; i < states.size(); ++i) {
    Scene changed = scene;
    if (!states[i].change(changed)) continue;
    if (states[i].is_of_light_equation && are_fragments_lit_alone(scene)) all[i].stage = "shade";
    out.push_back(std::move(all[i]));
  }
  return out;
}

}  // namespace plumbline::cli
