// The verdict as a page for people: ours | reference | difference per scene, and the table.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "check/judge.h"
#include "check/verdict.h"

namespace plumbline::report {

/// Writes folder/index.html and folder/<group>/<scene>/*.png. Works offline. Scenes are added one by one, so that their
/// captures need not be kept.
class HtmlReport {
 public:
  explicit HtmlReport(std::filesystem::path folder);
  void add(const check::SceneVerdict& verdict, std::span<const check::Reference> references, const check::Drawn& drawn,
           const std::string& description);
  /// Throws std::runtime_error naming the file that cannot be written.
  void write(const std::string& summary) const;

 private:
  std::filesystem::path folder_;
  std::string body_;
};

}  // namespace plumbline::report
