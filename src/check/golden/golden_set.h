// The goldens on disk: a manifest, and for each scene a picture, its depths and its stages' hashes.
//
// An update is atomic. The manifest names the files of the set, and file names contain their content's hash: new files
// are written beside the old ones, then the manifest is replaced by a rename, then files that it names no longer are
// removed. If an update is killed, the manifest is the old or the new one, and all files that it names are there. Other
// files are leftovers, which are never read and which the next update removes. (Fixed names, and an exchange of
// folders, would need renameat2's RENAME_EXCHANGE, which file systems of containers refuse.)
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "capture/plane.h"
#include "check/golden/golden_manifest.h"
#include "scene/scene.h"

namespace plumbline::check {

/// A set, locked while this lives: many may read it at a time, or one may update it.
class GoldenSet {
 public:
  enum class Access { read, update };
  /// Throws GoldenError: a lock that another holds; a manifest that is not there (`update`: in an empty folder it will
  /// be) or not right.
  GoldenSet(const std::filesystem::path& folder, Access access);
  ~GoldenSet();
  GoldenSet(const GoldenSet&) = delete;
  GoldenSet& operator=(const GoldenSet&) = delete;

  const GoldenManifest& manifest() const { return manifest_; }

  /// The scene's golden, which the manifest names. Throws GoldenError or ImageError if a file is not there, or not what
  /// the manifest says, to the bit, or not of the frame's formats.
  Fingerprint load(const std::string& scene, const FrameFormat& frame) const;

  /// Files that the manifest does not name, relative to the folder: by their names leftovers of a killed run, or not.
  struct Strays {
    std::vector<std::string> leftovers, others;
  };
  Strays strays() const;

  /// Replaces the set by that of `next`, atomically. `files`: bytes of the new files, by their names in `next`. Throws
  /// OutputError (atomic_path.h); the set is then unchanged.
  void write(GoldenManifest next, const std::map<std::string, std::string>& files);
  /// Removes leftovers, and nothing else.
  void remove_leftovers() const;

 private:
  std::filesystem::path folder_;
  int lock_ = -1;
  GoldenManifest manifest_;
};

/// Scene hash and files of a golden of `drawn`; adds the files' bytes to `files`, by name. Throws ImageError.
Golden make_golden(const Scene& scene, const Fingerprint& drawn, std::map<std::string, std::string>& files);

}  // namespace plumbline::check
