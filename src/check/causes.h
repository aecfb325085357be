// Likely causes of a wrong stage, in words: patterns that the differences of all its records fit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "stages/capture.h"

namespace plumbline::check {

/// One stage of the candidate beside what it should be, both made of the same records.
struct Evidence {
  const Scene& scene;
  Stage stage;
  const Capture& candidate;  ///< with the records that came in
  const Capture& expected;   ///< exact's, of that stage alone: real numbers
};

struct Cause {
  std::string_view name;  ///< such as "window.y_flipped"
  std::string words;      ///< the bug, and what shows it
};

/// Those that the differences fit, the likeliest first; empty where no pattern does.
std::vector<Cause> likely_causes(const Evidence& evidence);

}  // namespace plumbline::check
