// Renderers that end the process, never end, take all memory or throw, for tests that other rows survive. No fault list
// has them.
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
/// `inner`, except that capture() of `ending.scene` ends by `ending.how`.
std::unique_ptr<Renderer> make_ending(std::unique_ptr<Renderer> inner, ReferenceEnding ending);

}  // namespace plumbline::faults
