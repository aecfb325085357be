// Changes of a source file, each of one place: an operator, a constant, an index, swapped arguments, a dropped
// statement.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::mutation {

/// A change of one place in one file.
struct Change {
  std::string file;         ///< path from the repository's root
  std::string function;     ///< in which it is made; empty: in none
  std::size_t line = 0;     ///< from 1
  std::size_t at = 0;       ///< byte offset of the text that is replaced
  std::size_t length = 0;   ///< bytes replaced
  std::string replacement;  ///< other text than what stands there
  std::string kind;         ///< mutator, e.g. "comparison", "dropped statement"
};

/// The changes of a C++ source that was formatted by clang-format (spaces around binary operators, none beside template
/// brackets), in the order of the text. Only within functions and in constexpr definitions; never in comments, texts,
/// preprocessor lines, static_assert, throw statements or compile-time conditions.
std::vector<Change> changes_of(const std::string& file, std::string_view source);

/// The source with the change made.
std::string changed(std::string_view source, const Change& change);

/// The lines that the change touches, joined by a space, without space around: as they are and as changed.
struct ChangedLines {
  std::string before, after;
};
ChangedLines lines_of(std::string_view source, const Change& change);

}  // namespace plumbline::mutation
