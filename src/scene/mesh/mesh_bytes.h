// Encoding of mesh parts as bytes (base/byte_archive.h), by which the program that reads mesh files
// (program/mesh_reader.cpp) hands them to load_mesh().
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh_part.h"

namespace plumbline {

/// Bytes of the parts, which must be of triangles: Mesh::topology is not encoded.
std::string to_bytes(std::vector<MeshPart> parts);
/// The parts that to_bytes() encoded; of other bytes the result is unspecified. Throws std::runtime_error where the
/// bytes end too early.
std::vector<MeshPart> parts_of(std::string_view bytes);

}  // namespace plumbline
