// Renderers that end the process, never end, take all memory or throw: for tests that other rows survive. They are in
// no list of faults.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "capture/renderer.h"
#include "faults/fault.h"

namespace plumbline::faults {

/// Endings of our pipeline: endings.throw, .memory, .crash and .hang.
std::span<const Fault> endings();

/// A reference that ends at one scene.
struct ReferenceEnding {
  std::string how, reference, scene;
};
/// Parses `endings.HOW:REFERENCE:SCENE`, HOW one of throw, memory, crash, exit and hang; none: `fault` has another
/// form.
std::optional<ReferenceEnding> reference_ending(std::string_view fault);
/// `inner`, but capture() of the scene of that name ends as `ending.how` says.
std::unique_ptr<Renderer> make_ending(std::unique_ptr<Renderer> inner, ReferenceEnding ending);

}  // namespace plumbline::faults
