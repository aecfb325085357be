// One scene's diagnosis: which stages of the candidate are wrong, by what numbers, and what may have caused it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capture/renderer.h"
#include "check/judge/judge.h"
#include "check/verdict/verdict.h"
#include "scene/scene.h"

namespace plumbline::check {

/// What is wrong with one stage.
struct Finding {
  Stage stage = Stage::matrices;
  JudgeId judge{""};                 ///< who judged it
  Measurement measurement;           ///< and by how much it is off
  std::vector<std::string> numbers;  ///< the worst record: input, output, expected output and its source
  std::vector<std::string> causes;   ///< likely causes in words, with what shows them (known_causes.h)
  std::vector<std::string> kinds;    ///< the same causes, without what shows them
  std::size_t explains = 0;          ///< pixels of the final picture (evidence.h); 0: none, or fragments were too many
  std::string picture;  ///< coverage: the worst triangle, `#` both, `?` missing, `!` extra; rows from the top; or empty
};

struct Diagnosis {
  SceneVerdict verdict;  ///< judge()'s, and the rows of repaired records
  /// The headline; by the first rule that applies:
  /// 1. the first of `wrong` that explains pixels of the picture;
  /// 2. the stage of first_different(), unless it holds in the row `per_stage` and `wrong` names a later stage;
  /// 3. the first of `wrong`.
  /// Stages that do not count, of a foreign candidate: coverage that differs by legal fragments alone, and, where
  /// another stage differs by more, a stage that differs by steps (verdict.h).
  std::optional<Stage> first;
  std::vector<Stage> wrong;  ///< every stage that is wrong by itself, in order
  /// One for each of `wrong`, those first that explain most pixels; of the first different stage where there is none.
  std::vector<Finding> findings;
};

// Rows that diagnose() adds to judge()'s.
// Kind::repaired: stages after the first one that is wrong by itself, where the candidate runs stages. The candidate
// runs each stage on its own records, in which exact's, rounded to the formats, replace those of wrong stages; exact
// judges the result. Finds errors that an earlier error masks.
// Kind::at_worst: stages 6 to 9 of the fragments at the 5 x 5 pixels about each row's worst pixel, captured once more,
// where a scene has more fragments than are recorded.

/// Default limit of recorded fragments in a diagnosis, shared by an antialiased scene's passes; some seconds of work.
inline constexpr std::uint64_t kMostFragments = std::uint64_t{1} << 20;

/// Judges the scene and diagnoses the verdict. A stage is wrong by itself where exact's row from the candidate's own
/// records of earlier stages (matrices: from the scene), or from repaired ones, is `different` or `failed`. Of an
/// antialiased scene: the passes together, and `resolve`.
Diagnosis diagnose(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                   std::uint64_t most_fragments = kMostFragments);
/// diagnose() for many runs: findings hold the judge and the measurement, without numbers, causes, kinds, pictures and
/// explained pixels, so that rule 1 of Diagnosis::first never applies.
Diagnosis diagnose_in_brief(const Scene& scene, Renderer& candidate, std::span<const Reference> references);

/// The right output of all stages up to merge: each as `referee` makes it of its own earlier records, rounded to the
/// formats. Throws Unsupported where the referee does not run a stage, and OverBudget.
Capture expected_capture(const Scene& scene, Renderer& referee);

}  // namespace plumbline::check
