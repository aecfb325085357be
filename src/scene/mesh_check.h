// What has to be checked in mesh files before assimp reads them, as it goes on by guessing: it leaves out vertices that
// it cannot read, makes up what a truncated file lacks, and takes hours over counts that are not true.
#pragma once

#include <string_view>

namespace plumbline {

/// An OBJ file's text: statements that we draw or that do not matter; v with 3 numbers (4: w; 6: a colour, in all lines
/// or in none), each beginning with a sign or a digit; f with three corners or more.
/// Throws std::runtime_error: expected ..., found ... in line n.
void check_obj(std::string_view text);

/// A PLY file's bytes, ASCII or binary: the header, and that the elements that it announces are there, one after the
/// other to the file's end (in ASCII each on a line of its own); faces of three corners or more.
/// Throws std::runtime_error: expected ..., found ....
void check_ply(std::string_view bytes);

}  // namespace plumbline
