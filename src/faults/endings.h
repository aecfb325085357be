// Renderers that end the process, hang, take all memory or throw: tests require that all other rows are judged. No
// list of faults holds these renderers.
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
