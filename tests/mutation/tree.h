// A copy of the sources, built once as they are, and again with each change.
#pragma once

#include <filesystem>
#include <string>

#include "mutation/changes.h"

namespace plumbline::mutation {

/// Folders below `out`: tree (the sources), build, kept (build, of the sources as they are).
class Tree {
 public:
  /// Copies the files that git lists below `root`, or would add, except golden/, where they differ from the copy, and
  /// builds them; an earlier build in `out` is continued. Throws std::runtime_error where git or the build fails.
  Tree(const std::filesystem::path& root, const std::filesystem::path& out, unsigned workers);

  std::filesystem::path source() const { return out_ / "tree"; }
  std::filesystem::path build() const { return out_ / "build"; }

  /// The programs of the changed sources, in the folder `to`; the tree is then as it was. False: it does not compile.
  /// Only what the change touches is compiled.
  bool build_changed(const Change& change, const std::filesystem::path& to);
  /// The programs of the sources as they are.
  void copy_programs(const std::filesystem::path& to) const;

 private:
  bool compile(const std::string& log) const;
  void restore() const;

  std::filesystem::path out_;
  unsigned workers_;
};

}  // namespace plumbline::mutation
