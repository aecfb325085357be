// Known differences: rows of a file, each with its reason, its issue and the last day on which it is an excuse.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/verdict/verdict.h"

namespace plumbline::check {

struct Expectation {
  std::string scene;         ///< its name: group/scene
  std::string reference;     ///< of the row
  std::optional<Kind> kind;  ///< of the row; none: any but from_scene, per_stage, at_worst and repaired
  Stage stage = Stage::matrices;
  Outcome outcome = Outcome::different;  ///< or missing, failed
  std::string reason, issue;
  std::chrono::sys_days expires;  ///< the last day
};

/// {"expectations": [{"scene", "reference": a renderer, "golden" or "picture", "kind": one of kKindNames, "stage",
/// "outcome", "reason", "issue", "expires": "YYYY-MM-DD"}]}. "kind" is needed for the rows of exact; "outcome" is
/// "different" where it is left out. Throws JsonError (json_tree.h), also where two rows are of one comparison, or a
/// reference is none of `renderers`.
std::vector<Expectation> read_expectations(const std::filesystem::path& file, std::span<const std::string> renderers);

/// YYYY-MM-DD. Throws std::invalid_argument: no such day.
std::chrono::sys_days day_of(const std::string& text);
std::string to_string(std::chrono::sys_days day);

/// Fate of an expectation whose scene and reference were asked.
enum class Settlement {
  occurred,  ///< its row is now `expected`, and says why
  expired,   ///< it occurred after its last day: the row stays a failure
  passed,    ///< the row has another outcome than expected: a failure, too
  unmatched  ///< there is no such row, although scene and reference were asked: a failure
};
struct Settled {
  const Expectation* expectation;
  Settlement fate;
  std::string line;  ///< for a failure
};

/// Settles the expectations of the verdict's scene whose reference was asked; `asked`: names of renderers.
std::vector<Settled> settle_expectations(std::span<const Expectation> expectations, std::span<const std::string> asked,
                                         std::chrono::sys_days today, SceneVerdict& verdict);

/// A line for each expectation whose scene is not among the verdicts, those of a whole suite.
std::vector<std::string> of_no_scene(std::span<const Expectation> expectations, std::span<const SceneVerdict> verdicts);

}  // namespace plumbline::check
