// The folder that a page is written into.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "base/atomic_path.h"
#include "capture/plane.h"

namespace plumbline::report {

/// A folder with index.html and the files that it shows. Works offline. The folder appears in the end, whole. It
/// replaces nothing but a page like it: a list in the folder names its files.
class PageFolder {
 public:
  /// Throws OutputError (atomic_path.h), as all here do, if the folder cannot be written or is not a page's.
  explicit PageFolder(const std::filesystem::path& folder);
  /// Removes the page that an earlier run left, which would look like this run's where this one leaves none.
  void remove_earlier();
  void write(const std::string& name, std::string_view bytes);
  /// As a PNG.
  void write_picture(const std::string& name, const Plane<glm::vec4>& plane);
  /// index.html, `body` being HTML under the style of all pages (web/page.css) and the one given; and the folder is
  /// there.
  void commit(const std::string& title, std::string_view style, const std::string& body);

 private:
  std::filesystem::path name_;
  AtomicPath folder_;
  std::string files_;  // one a line
};

}  // namespace plumbline::report
