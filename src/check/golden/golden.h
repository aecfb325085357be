// A scene against its golden, and the rule by which references vouch for a new one.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "check/golden/golden_set.h"
#include "check/verdict/verdict.h"

namespace plumbline::check {

/// Differences between a scene as drawn and its golden.
struct GoldenDifference {
  /// Why the golden does not count: the renderer failed, there is no golden, a file of it is broken, or the scene has
  /// changed since (stages, color and depth are compared even so); empty: it counts.
  std::string why;
  Fingerprint golden, drawn;  ///< empty where they are not known
  std::vector<Stage> stages;  ///< whose hashes differ, in order
  Measurement color, depth;   ///< pixels that differ in a bit, the differences in steps of the format
  bool any() const { return !why.empty() || !stages.empty() || color.differing > 0 || depth.differing > 0; }
};
/// Draws the scene with `candidate` and compares it with its golden.
GoldenDifference compare_golden(const Scene& scene, Renderer& candidate, const GoldenSet& goldens);

/// For a person: the first stage that differs, the pixels, the worst one. Lines.
std::string describe(const GoldenDifference& difference);

/// Rows of Kind::golden, one for each stage that hands on anything; a picture that differs counts its pixels in the
/// last. `failed` where there is nothing to compare.
std::vector<Comparison> golden_rows(const Scene& scene, Renderer& candidate, const GoldenSet& goldens);

/// Whether the references vouch for what was judged.
struct Vouch {
  std::vector<std::string> refusals;  ///< none: they do
  std::vector<std::string> by;        ///< those that agree where they judge, and fail it nowhere
  std::vector<std::string> disputed;  ///< where a reference is at fault, and why
  std::map<std::string, std::map<std::string, std::string>> references;  ///< as in the manifest
};
/// The rule of vouching. `asked`: three references or more, none of them the candidate. They vouch if no comparison is
/// a failure, no stage is unjudged (unjudged_stages()), and at each judged stage a row of some reference holds.
Vouch vouch(const SceneVerdict& verdict, const std::string& candidate, std::span<const std::string> asked);

}  // namespace plumbline::check
