// The verdict as a page for people: ours | reference | difference per scene, and the table.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "check/judge.h"
#include "check/verdict.h"
#include "stages/atomic_path.h"

namespace plumbline::report {

/// A folder with index.html and <group>/<scene>/*.png (letters other than ASCII's as "_", a name that is taken gets a
/// number). Works offline. Scenes are added one by one, so that their captures need not be kept; the folder appears in
/// the end, whole. It replaces nothing but a page like it: a list in the folder names its files.
class HtmlReport {
 public:
  /// Throws OutputError (atomic_path.h), as all here do, if the folder cannot be written or is not ours.
  explicit HtmlReport(const std::filesystem::path& folder);
  void add(const check::SceneVerdict& verdict, std::span<const check::Reference> references, const check::Drawn& drawn,
           const Scene& scene);
  void write(const std::string& summary);

 private:
  std::string free_folder(const std::string& scene);
  void write_file(const std::string& name, std::string_view bytes);

  std::filesystem::path name_;
  AtomicPath folder_;
  std::set<std::string> folders_;  // one per scene
  std::string files_;              // one a line
  std::string body_;
};

}  // namespace plumbline::report
