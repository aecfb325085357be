// An update of goldens as a page for people: old | new | difference, and who vouches.
#pragma once

#include <filesystem>
#include <string>

#include "check/golden/golden.h"
#include "report/page/page.h"

namespace plumbline::report {

/// A folder (page.h) with index.html and <group>/<scene>/*.png.
class GoldenPage {
 public:
  /// Throws OutputError (atomic_path.h), as all members do.
  explicit GoldenPage(const std::filesystem::path& folder) : page_(folder) {}
  /// `says`: what becomes of the new picture: "accepted", "would be written" or "refused".
  void add(const Scene& scene, const std::string& says, const check::GoldenDifference& difference,
           const check::Vouch& vouch);
  void write(const std::string& summary);

 private:
  PageFolder page_;
  std::string body_;
};

}  // namespace plumbline::report
