// conventions.json: what a renderer declares of itself, or plumb learn has found.
//
//   {"format": "plumbline conventions", "version": 1, "sample": [0.5, 0.5], "offset_unit": [2, 2],
//    "subpixel_bits": 4, "tie_rule": "left_top", "texture_bits": "float", ..., "open": ["blending"],
//    "unexplained": ["one scene drawn twice differs"]}
//
// Keys and words are those of capture/conventions.h. A key that is left out is OpenGL's; "open" names those that the
// renderer did not show, which are OpenGL's, too.
#pragma once

#include <filesystem>
#include <string>

#include "capture/conventions.h"

namespace plumbline {

/// Throws JsonError (json_tree.h): not there, not of this format, a key or word that is not known, a sample outside of
/// [0,1], bits beyond 0 to 16.
Conventions read_conventions(const std::filesystem::path& file);
/// Text of conventions.json: every convention, a line each. Control characters of findings become spaces, and bytes
/// that are no UTF-8 U+FFFD.
std::string conventions_text(const Conventions& conventions);

}  // namespace plumbline
