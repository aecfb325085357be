// The verdict as a page for people: ours | reference | difference per scene, and the table.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>

#include "check/judge.h"
#include "check/verdict.h"
#include "report/page.h"

namespace plumbline::report {

/// A folder (page.h) with index.html and <group>/<scene>/*.png, a name that is taken getting a number. Scenes are added
/// one by one, so that their captures need not be kept.
class HtmlReport {
 public:
  /// Throws OutputError (atomic_path.h), as all here do, if the folder cannot be written or is not ours.
  explicit HtmlReport(const std::filesystem::path& folder) : page_(folder) {}
  void add(const check::SceneVerdict& verdict, std::span<const check::Reference> references, const check::Drawn& drawn,
           const Scene& scene);
  void write(const std::string& summary);

 private:
  std::string free_folder(const std::string& scene);

  PageFolder page_;
  std::set<std::string> folders_;  // one per scene
  std::string body_;
};

}  // namespace plumbline::report
