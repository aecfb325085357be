// Meshes as bytes in memory's own form, from the program that reads mesh files (program/mesh_reader.cpp) to
// load_mesh().
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh_part.h"

namespace plumbline {

std::string to_bytes(std::vector<MeshPart> parts);
/// Parts of which to_bytes() made the bytes; of other bytes, anything. Throws std::runtime_error where they end too
/// early.
std::vector<MeshPart> parts_of(std::string_view bytes);

}  // namespace plumbline
