// Checks of mesh files before assimp reads them. On bad files assimp guesses: assimp leaves out unreadable vertices,
// makes up the rest of a truncated file, takes hours over false counts, and allocates lengths beyond the file's end.
#pragma once

#include <string>
#include <string_view>

namespace plumbline {

/// Checks an OBJ file's text: no statements but v, vt, f and those that change no shape (vn, g, o, s, mg, mtllib,
/// usemtl); v with 3 numbers, 4 (w) or 6 (a colour), as many in all lines; vt with 2 or 3; no number that begins with a
/// point; f with three corners or more, indices in range. Numbers of vn are not checked.
/// Result: a note where a third texture coordinate other than 0 is left out; else empty.
/// Throws std::runtime_error: expected ..., found ... in line n.
std::string check_obj(std::string_view text);

/// Checks a binary glTF file's header and the heads of its chunks (glTF 2.0, section 4.4): version 2, and no length
/// that reaches beyond the file. Throws std::runtime_error: expected ..., found ....
void check_glb(std::string_view bytes);

/// Checks a PLY file's bytes, ASCII or binary: the header; the elements that it announces, one after the other to the
/// file's end (in ASCII each on a line of its own); faces of three corners or more.
/// Throws std::runtime_error: expected ..., found ....
void check_ply(std::string_view bytes);

/// A copy of a PLY file that check_ply() accepts, with its triangle strips (element tristrips, one list vertex_indices)
/// turned into faces, in order; a file without strips is copied as it is. Corners i, i + 1, i + 2 of a strip are a
/// triangle, every second one with its first two corners exchanged, as in OpenGL (4.5, section 10.1.7); -1 ends a strip
/// within the list. Throws std::runtime_error: other properties, faces beside strips, indices out of range.
std::string with_faces_for_strips(std::string_view bytes);

}  // namespace plumbline
