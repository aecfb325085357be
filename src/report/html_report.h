// The verdict as a page for people: an overview of all scenes, and of each its stages and ours | reference |
// difference.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>

#include "check/judge.h"
#include "check/verdict.h"
#include "report/page.h"

namespace plumbline::report {

/// A folder (page.h) with index.html and, of each scene, a small picture <group>/<scene>.png and what it is shown from,
/// <group>/<scene>.js (viewer_data.h), a name that is taken getting a number. Below 50 kB a scene. Scenes are
/// added one by one, so that their captures need not be kept.
class HtmlReport {
 public:
  /// Throws OutputError (atomic_path.h), as all here do, if the folder cannot be written or is not ours.
  explicit HtmlReport(const std::filesystem::path& folder) : page_(folder) {}
  /// `failure`: why the run fails for this scene (table.h, failure_lines()), or empty; `repeat`: the command.
  void add(const check::SceneVerdict& verdict, std::span<const check::Reference> references, const check::Drawn& drawn,
           const Scene& scene, const std::string& failure = "", const std::string& repeat = "");
  void write(const std::string& summary);

 private:
  std::string free_name(const std::string& scene);

  PageFolder page_;
  std::set<std::string> names_;  // one per scene
  std::string scenes_;           // the overview's, as JSON
};

}  // namespace plumbline::report
