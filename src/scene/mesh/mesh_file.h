// Meshes from files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "scene/json/asset_folders.h"
#include "scene/mesh/mesh_part.h"

namespace plumbline {

/// The parts of an OBJ, 3DS, PLY, glTF or GLB file, in the file's order and world space: its nodes' transforms are
/// applied. Neighbouring meshes of one material are merged, so that a file of one material is one part. Polygons are
/// cut into triangles, equal vertices joined, triangles that have a vertex twice left out. The winding is the file's
/// (a mirroring transform reverses the winding, so that the outside stays outside). Normals that the file lacks are
/// made from the adjacent triangles. 3DS files are taken to be z-up and turned to y-up: (x, y, z) becomes (x, z, -y).
///
/// Materials are those of OBJ (Ka, Kd, Ks, Ke, Ns, d) and 3DS as they are, Ns above 128, OpenGL's limit, as 128; of
/// glTF the base colour (as ambient and diffuse) and the emission. Images, skins and animations are not read. Texture
/// coordinates are the first set, t upwards; a part has none if one of its merged meshes has none. PLY files may have
/// triangle strips (element tristrips) in place of faces.
///
/// Omissions that give a note: materials of an OBJ file that names no material file, or a missing one; an OBJ file's
/// third texture coordinates other than 0 (the depth in a volume texture; plumbline's have two dimensions).
///
/// assimp, which reads the files, crashes, hangs and guesses on some bad ones: assimp runs in a program of its own,
/// plumbline_mesh_reader, for at most a minute, after a check of the content (mesh_check.h); files of which assimp
/// complains are refused. assimp may open only files (materials, buffers) that `folders` allow.
///
/// Throws MeshError: not readable, longer than 256 MiB, not one of the formats, truncated; no triangles, or more than
/// `most_triangles`; faces of fewer than 3 or more than 1024 corners, polygons that are not flat or cross themselves
/// (polygon.h); an index out of range; a position not finite or beyond kLargestCoordinate (scene_values.h); a normal
/// zero or not finite; a colour or opacity beyond [0,1]; texture coordinates not finite or beyond +-16384; a referenced
/// file that is not allowed, or missing (a missing material file gives a note instead); a material that the material
/// files do not define.
std::vector<MeshPart> load_mesh(const std::filesystem::path& file, const AssetFolders& folders,
                                std::size_t most_triangles);

}  // namespace plumbline
