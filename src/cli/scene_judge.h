// Judges one scene for plumb check, settles its expectations, and writes its page.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capture/renderer.h"
#include "check/golden/golden_set.h"
#include "check/kept/judge_or_recall.h"
#include "check/verdict/expectations.h"
#include "check/verdict/verdict.h"
#include "cli/commands.h"
#include "cli/options/references.h"
#include "report/page/html_report.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// Rules of a run, the same for all its scenes; worker processes have copies.
struct CheckRules {
  CheckOptions options;
  std::chrono::sys_days today;
  std::vector<check::Expectation> expectations{};
  std::optional<check::GoldenSet> goldens{};
  std::optional<report::HtmlReport> page{};   ///< the page of --report, or none
  std::optional<check::KeptVerdicts> kept{};  ///< verdicts of earlier runs (--cache), or none
  bool names_causes = true;                   ///< a program's wrong scenes are drawn with each known fault
};

/// Result of judging a scene, without its planes.
struct JudgedScene {
  check::SceneVerdict verdict;
  std::vector<check::Settled> settled;
  std::string failure;  ///< lines: why the scene does not hold, and where its page is; empty: it holds
  std::optional<report::HtmlReport::Drawing> drawing;
  std::map<std::string, std::string> versions;  ///< by renderer
};
/// One `failed` row: the comparison itself, no renderer, ended a worker on this scene.
JudgedScene not_compared(const Scene& scene, const CheckRules& rules, const std::string& how);

/// A worker's candidate and references.
class SceneJudge {
 public:
  SceneJudge(const CheckRules& rules, Progress& progress);
  SceneJudge(const SceneJudge&) = delete;
  SceneJudge& operator=(const SceneJudge&) = delete;
  /// `ended`: the steps that ended workers before. `drawn`: receives what both sides drew, if not null. Writes the page
  /// of a scene that does not hold, if --failures is given. Throws OutputError.
  JudgedScene judge(const Scene& scene, EndedSteps ended, check::BothCaptures* drawn = nullptr);

 private:
  const CheckRules* rules_;
  Progress* progress_;
  EndedSteps ended_;
  std::optional<check::KeptVerdicts> kept_;
  std::unique_ptr<Renderer> candidate_;
  References references_;
};

}  // namespace plumbline::cli
