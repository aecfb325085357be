// The folder that a page is written into.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "base/atomic_path.h"
#include "capture/plane.h"

namespace plumbline::report {

/// A folder with index.html and the files that it shows; works offline. commit() makes the folder appear, complete.
/// commit() replaces no folder but an empty one or an earlier page, which holds a list of its own files.
class PageFolder {
 public:
  /// Throws OutputError (atomic_path.h), as all here do, if the folder cannot be written or is not a page's.
  explicit PageFolder(const std::filesystem::path& folder);
  /// Removes an earlier run's page, which else might pass for this run's.
  void remove_earlier();
  void write(const std::string& name, std::string_view bytes);
  /// Writes the plane as a PNG.
  void write_picture(const std::string& name, const Plane<glm::vec4>& plane);
  /// Writes index.html with `body` (HTML), web/page.css and `style` (CSS), and makes the folder appear.
  void commit(const std::string& title, std::string_view style, const std::string& body);

 private:
  std::filesystem::path name_;
  AtomicPath folder_;
  std::string files_;  // one a line
};

}  // namespace plumbline::report
