// What another renderer can do, over a suite: per feature how many scenes it draws rightly, wrongly, and not at all.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// How one scene ended.
enum class Conformance {
  holds,    ///< a stage at least was judged, none is wrong
  legal,    ///< a stage differs from a reference's, and an oracle finds it legal: drawn by other rules
  known,    ///< what is wrong is expected (--expect)
  differs,  ///< a stage is wrong, and no oracle calls it legal
  failed,   ///< the program crashed, hung, or left what cannot be read
  /// The program said that it cannot draw the scene, or none of its output could be judged, or every item judged has
  /// several legal answers.
  unable
};
Conformance conformance_of(const check::SceneVerdict& verdict);
/// Why a scene is unable, in the program's words where it has said why.
std::string unable_reason(const check::SceneVerdict& verdict);
/// Row of the first stage that is `different` and that no oracle calls legal. If there is one, and first_different()
/// is a row of Kind::per_stage other than coverage's, that row instead. Null: no stage is wrong.
const check::Comparison* first_wrong(const check::SceneVerdict& verdict);

/// Whether a row finds the stage equal or within its tolerance, and none finds it wrong.
bool is_right(const check::SceneVerdict& verdict, Stage stage);

/// Scenes of one feature: a folder of the suite.
struct FeatureTally {
  std::string feature;
  std::size_t holds = 0, legal = 0, known = 0, differs = 0, failed = 0, unable = 0;
  std::vector<std::pair<std::string, std::size_t>> first_wrong;  ///< stages, the most frequent first
};
std::vector<FeatureTally> conformance(std::span<const check::SceneVerdict> verdicts);

/// Tally of all scenes, as of one feature.
FeatureTally whole_suite(std::span<const check::SceneVerdict> verdicts);

/// Table of features, then lines: reasons why scenes are unable, stages not judged, and known faults whose pictures the
/// program draws, the most frequent first.
std::string conformance_text(std::span<const check::SceneVerdict> verdicts);
/// Text of conformance_text() as a section of a CI page, in Markdown.
std::string conformance_markdown(std::span<const check::SceneVerdict> verdicts);

}  // namespace plumbline::report
