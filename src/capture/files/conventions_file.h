// conventions.json: what a renderer declares of itself, or plumb learn has found.
//
//   {"format": "plumbline conventions", "version": 1, "sample": [0.5, 0.5], "offset_unit": [2, 2],
//    "subpixel_bits": 4, "tie_rule": "left_top", "texture_bits": "float", ..., "open": ["blending"],
//    "unexplained": ["one scene drawn twice differs"]}
//
// Keys and words are those of capture/conventions.h. A key that is left out has OpenGL's value; "open" names
// conventions that the renderer did not show, which have OpenGL's values, too.
#pragma once

#include <filesystem>
#include <string>

#include "capture/conventions.h"

namespace plumbline {

/// Reads conventions.json. Throws JsonError (json_tree.h) for a missing file, another format, an unknown key or word, a
/// sample outside of [0,1], or bits beyond 0 to 16.
Conventions read_conventions(const std::filesystem::path& file);
/// Text of conventions.json: every convention, a line each. Control characters of findings become spaces, and bytes
/// that are no UTF-8 U+FFFD.
std::string conventions_text(const Conventions& conventions);

}  // namespace plumbline
