// A part of a mesh file: its triangles of one material.
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

struct MeshPart {
  Mesh mesh;
  std::optional<Material> material;  ///< nullopt: the file gives none
  std::string note{};                ///< on the first part only: what of the file was left out; empty: nothing
};

}  // namespace plumbline
