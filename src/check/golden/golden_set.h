// The goldens on disk: a manifest, and for each scene a picture, its depths and its stages' hashes.
//
// The manifest alone says what the set is, and its renaming is the moment in which an update happens: the files that it
// names bear their own hash in their names, so new ones lie beside old ones until then, and those that it names no
// longer are removed afterwards. Whenever an update is killed, the manifest there is the old or the new one, and all
// that it names is there, bit for bit. What lies there beside it is a leftover, which nobody reads and the next update
// removes. (Names that stay, and a folder exchanged for another, would need renameat2's RENAME_EXCHANGE, which file
// systems of containers refuse.)
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "capture/plane.h"
#include "check/golden/golden_manifest.h"
#include "scene/scene.h"

namespace plumbline::check {

/// The names of the frame's formats in the manifest.
std::string color_format_name(const FrameFormat& frame);
std::string depth_format_name(const FrameFormat& frame);

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

  /// Relative to the folder: what a run that was killed left, and what nobody here has written.
  struct Strays {
    std::vector<std::string> leftovers, others;
  };
  Strays strays() const;

  /// Makes the set that of `next`, in one moment; `files` are those that are new, by their names there. Throws
  /// OutputError (atomic_path.h), and then the set is as it was.
  void write(GoldenManifest next, const std::map<std::string, std::string>& files);
  /// Removes leftovers, and nothing else.
  void remove_leftovers() const;

 private:
  std::filesystem::path folder_;
  int lock_ = -1;
  GoldenManifest manifest_;
};

/// The golden of what was drawn, and the bytes of its files by their names; without who vouched. Throws ImageError.
Golden make_golden(const Scene& scene, const Fingerprint& drawn, std::map<std::string, std::string>& files);

}  // namespace plumbline::check
