// Pairs of states that scenes have reached together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "campaign/states/states.h"

namespace plumbline::campaign {

class Reached {
 public:
  Reached();
  /// Adds a scene's states. Result: a state, or a pair of states, is new.
  bool add(const StateBits& of_scene);
  std::size_t states() const;
  /// Unordered pairs of different states.
  std::size_t pairs() const;
  /// Numbers of the states that no scene has reached.
  std::vector<std::size_t> never() const;

 private:
  std::vector<std::vector<bool>> together_;  ///< [a][b], b <= a: a scene had states a and b
};

}  // namespace plumbline::campaign
