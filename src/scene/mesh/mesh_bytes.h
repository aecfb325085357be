// Meshes as bytes in memory's own form, from the program that reads mesh files (program/mesh_reader.cpp) to load_mesh().
#pragma once

#include <string>
#include <vector>

#include "scene/mesh/mesh_part.h"

namespace plumbline {

std::string to_bytes(const std::vector<MeshPart>& parts);
/// Parts of which to_bytes() made the bytes; of other bytes, anything.
std::vector<MeshPart> parts_of(std::string bytes);

}  // namespace plumbline
