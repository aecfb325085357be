// Meshes from files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "scene/json/asset_folders.h"
#include "scene/mesh/mesh_part.h"

namespace plumbline {

/// An OBJ, 3DS, PLY, glTF or GLB file in the file's world space: parts are moved to where its nodes place them, in its
/// order; neighbours of one material are put together, so that a file of one material is one part. Polygons are cut
/// into triangles, equal vertices joined, triangles that have a vertex twice left out. The winding stays as it is in
/// the file (a mirroring placement turns it, so that what was outside stays outside). Normals that the file does not
/// give are made from the adjacent triangles. 3DS files are taken to be z-up and turned to y-up: (x, y, z) becomes (x,
/// z, -y).
///
/// Materials are those of OBJ (Ka, Kd, Ks, Ke, Ns, d) and 3DS as they are, Ns above 128, OpenGL's limit, as 128; of
/// glTF the base colour (as ambient and diffuse) and the emission. Images, skins and animations are not read. Texture
/// coordinates are the first set, t upwards; where one of the meshes that are put together has none, none. PLY files
/// may have triangle strips (element tristrips) in place of faces.
///
/// Left out with a note: materials of an OBJ file whose material file is missing, or that names none; an OBJ file's
/// third texture coordinates other than 0 (the depth in a volume texture; textures here have two dimensions).
///
/// The library that reads the files crashes, hangs and guesses on some bad ones: it runs in a program of its own,
/// plumbline_mesh_reader, for at most a minute; what it would guess is checked before, and what it complains about is
/// refused. It opens files (materials, buffers) that `folders` allow, and no others.
///
/// Throws MeshError: not readable, longer than 256 MiB, not one of the formats, truncated; no triangles, or more than
/// `most_triangles`; faces of fewer than three corners, polygons that are not flat or cross themselves (polygon.h);
/// an index out of range; a position not finite or beyond kLargestCoordinate (scene_values.h); a normal zero or not
/// finite; a colour beyond [0,1]; texture coordinates not finite or beyond +-16384; another file that it names and that
/// is not allowed, or is missing and no material file; a material that the material files do not define.
std::vector<MeshPart> load_mesh(const std::filesystem::path& file, const AssetFolders& folders,
                                std::size_t most_triangles);

}  // namespace plumbline
