// Legal variants: other ways to state a scene, or to draw it, that the rules allow. The harness must raise nothing.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::faults {

/// Variant by `scene` or `apply`.
struct Variant {
  std::string_view name;
  std::string_view says;                                  ///< the difference, and why it is allowed
  std::optional<Scene> (*scene)(const Scene&) = nullptr;  ///< the scene restated; none: not possible
  void (*apply)(pipeline::Stages&) = nullptr;             ///< puts its functions into the pipeline
  bool same_bits = false;                                 ///< every bit of the picture must stay
};

std::span<const Variant> legal_variants();

}  // namespace plumbline::faults
