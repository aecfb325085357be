#include "campaign/states/reached.h"

#include <algorithm>

namespace plumbline::campaign {

Reached::Reached() {
  for (std::size_t i = 0; i < state_names().size(); ++i) together_.emplace_back(i + 1, false);
}

bool Reached::add(const StateBits& of_scene) {
  std::vector<std::size_t> states;
  for (std::size_t i = 0; i < together_.size(); ++i) {
    if (has_state(of_scene, i)) states.push_back(i);
  }
  bool is_new = false;
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      auto known = together_[states[i]][states[j]];
      is_new = is_new || !known;
      known = true;
    }
  }
  return is_new;
}

std::size_t Reached::states() const { return together_.size() - never().size(); }

std::size_t Reached::pairs() const {
  std::size_t out = 0;
  for (const auto& row : together_) out += static_cast<std::size_t>(std::count(row.begin(), row.end() - 1, true));
  return out;
}

std::vector<std::size_t> Reached::never() const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < together_.size(); ++i) {
    if (!together_[i][i]) out.push_back(i);
  }
  return out;
}

}  // namespace plumbline::campaign
