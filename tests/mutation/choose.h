// The changes that a seed draws, and the tables of files and of equivalent changes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "mutation/changes.h"

namespace plumbline::mutation {

/// A row of files.tsv.
struct FileRule {
  std::string prefix;              ///< of the path from the repository's root, "#" and the function
  std::vector<std::string> names;  ///< stages of which one must be named first; "picture"; "any"; "data"; "-"
  std::string what;                ///< what stands there, or why it is left alone
};

/// Throws std::runtime_error with file and line where a row has not three fields.
std::vector<FileRule> read_file_rules(const std::filesystem::path& table);
/// The rule with the longest prefix; null if none fits.
const FileRule* rule_of(const std::vector<FileRule>& rules, const std::string& path, const std::string& function);

/// The sources that may be changed, by path, with their text. Throws std::runtime_error where no rule says anything of
/// a source below src.
std::map<std::string, std::string> sources_of(const std::filesystem::path& root, const std::vector<FileRule>& rules);

/// A random order of changes, the same for a seed on every machine. Each draw takes one of the source lines that have
/// changes and are left, one of the line's kinds of change, and one change of that kind, each with equal probability.
class Draw {
 public:
  Draw(const std::map<std::string, std::string>& sources, const std::vector<FileRule>& rules, std::uint64_t seed);
  /// Draws the next change. False: no line is left.
  bool next(Change& change);

 private:
  std::vector<std::vector<Change>> lines_;
  std::mt19937_64 random_;
};

/// A row of equivalent.tsv: a change by its content.
struct Equivalent {
  std::string file, before, after, reason;
};
/// Throws std::runtime_error with file and line where a row has not four fields.
std::vector<Equivalent> read_equivalents(const std::filesystem::path& table);

}  // namespace plumbline::mutation
