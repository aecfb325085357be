// golden/manifest.json: what each golden is of, what its files are, and who vouched for it.
//
//   {"format": "plumbline goldens", "version": 1,
//    "versions": {"1f3c9a02": {"ours": "0.1.0", "osmesa": "llvmpipe (LLVM 15.0.6, 256 bits), ...", ...}},
//    "scenes": {
//     "coverage/tie_rule": {
//      "scene": hash of the scene and all it draws from, "producer": "ours 0.1.0", "versions": "1f3c9a02",
//      "files": {"color": {"file": "coverage/tie_rule/color.0123456789abcdef.png", "format": "rgba8", "bytes": 1234,
//                          "hash": ...}, "depth": ..., "stages": ...},
//      "references": {"osmesa": {"equal": "matrices vertex ...", "within": "..."}, "exact, from scene": ...},
//      "vouched": ["osmesa", "embree", "exact"], "disputed": ["osmesa, lines: 3 of 96: why"], "seal": hash}}}
//
// Each scene is one line, so that two people's updates of two scenes merge. The seal is the hash of the line without
// the seal: it reveals changes by hand.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "check/golden/golden_hash.h"

namespace plumbline::check {

/// The message names file, place, and what was expected.
struct GoldenError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct GoldenFile {
  std::string file;    ///< from the goldens' folder: scene, kind, the hash's first 16 digits, ending (golden_file_name)
  std::string format;  ///< of color and depth the frame's, such as "rgba8", "z24"; of stages "json"
  std::uint64_t bytes = 0;
  Hash hash;
};

struct Golden {
  Hash scene;                               ///< scene_hash()
  std::string producer;                     ///< renderer that drew it, and its version
  std::string versions;                     ///< of everything at the time: key of GoldenManifest::versions
  std::map<std::string, GoldenFile> files;  ///< "color", "depth", "stages"
  /// [title of a row][outcome]: names of the stages, in order, separated by spaces.
  std::map<std::string, std::map<std::string, std::string>> references;
  std::vector<std::string> vouched;   ///< references that agree (golden.h, Vouch::by)
  std::vector<std::string> disputed;  ///< rows in which a reference is at fault, and why
};

struct GoldenManifest {
  std::map<std::string, std::map<std::string, std::string>> versions;
  std::map<std::string, Golden> scenes;  ///< by name
};

/// "coverage/tie_rule/color.0123456789abcdef.png"
std::string golden_file_name(const std::string& scene, const std::string& kind, const Hash& hash,
                             const std::string& format);
/// The key of a set of versions.
std::string key_of(const std::map<std::string, std::string>& versions);

/// Throws GoldenError: not there, not of this format, not UTF-8; a seal that is broken, a file that is not named after
/// its scene and hash.
GoldenManifest read_golden_manifest(const std::filesystem::path& file);
/// Versions that no scene names are left out. Throws GoldenError where text is no UTF-8, or a name leads out of the
/// goldens' folder.
std::string manifest_text(const GoldenManifest& manifest);

/// {"matrices": hash, ...}; a stage that hands on nothing is left out.
std::string stages_text(const StageHashes& stages);
/// Throws GoldenError.
StageHashes read_stages(const std::filesystem::path& file);

}  // namespace plumbline::check
