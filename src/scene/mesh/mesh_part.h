// A mesh as its file gives it.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "scene/scene.h"

namespace plumbline {

/// The message names the file, what was expected and what was found.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A mesh, and the material that its file gives it, if it does.
struct MeshPart {
  Mesh mesh;
  std::optional<Material> material;
  std::string note{};  ///< on the first part: what of the file is left out, if anything
};

}  // namespace plumbline
