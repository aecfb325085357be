// What is no bug: other ways to say the same scene, and to draw it, that the rules allow. The harness must raise
// nothing.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::faults {

/// One of the two is there.
struct Variant {
  std::string_view name;
  std::string_view says;                                  ///< what is otherwise, and why that is allowed
  std::optional<Scene> (*scene)(const Scene&) = nullptr;  ///< the scene said otherwise; none: there is no such way
  void (*apply)(pipeline::Stages&) = nullptr;             ///< puts its functions into the pipeline
  bool same_bits = false;                                 ///< not a bit of the picture may change
};

std::span<const Variant> legal_variants();

}  // namespace plumbline::faults
