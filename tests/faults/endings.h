// Renderers that end the process, never end, or throw: for tests of what becomes of the other rows. None is a bug that
// is listed.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "capture/renderer.h"
#include "faults/fault.h"

namespace plumbline::faults {

/// Faults of our pipeline.
std::span<const Fault> endings();

/// A reference that ends at one scene.
struct ReferenceEnding {
  std::string how, reference, scene;
};
/// The ending that is written `endings.HOW:REFERENCE:SCENE`, HOW one of throw, memory, crash, exit and hang; none:
/// `fault` is not written so.
std::optional<ReferenceEnding> reference_ending(std::string_view fault);
/// `inner`, whose capture() of the scene ends so.
std::unique_ptr<Renderer> make_ending(std::unique_ptr<Renderer> inner, ReferenceEnding ending);

}  // namespace plumbline::faults
