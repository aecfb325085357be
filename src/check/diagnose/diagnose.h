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
  std::string reference;             ///< who judged it (Comparison::reference)
  Measurement measurement;           ///< and by how much it is off
  std::vector<std::string> numbers;  ///< the worst record: what came in, what came out, what was expected and from whom
  std::vector<std::string> causes;   ///< likely causes in words, with the evidence (causes.h)
  std::string picture;  ///< coverage: the worst triangle, `#` both, `?` missing, `!` extra; rows from the top; or empty
};

struct Diagnosis {
  SceneVerdict verdict;  ///< judge()'s, and the rows of repaired records
  std::optional<Stage>
      first;  ///< the first different stage; not one that does right by itself, before the first that does not
  std::vector<Stage> wrong;       ///< every stage that is wrong by itself, in order
  std::vector<Finding> findings;  ///< one for each of `wrong`; of the first different stage where there is none
};

/// The rows that diagnose() adds: of the stages after the first one that is wrong by itself. The candidate's own
/// records of the stages before are taken, but exact's, rounded to float, in place of those of each stage that is
/// wrong; the candidate's stage is run on them, and compared with exact's. It shows what a fault before it hides. Only
/// where the candidate runs stages.
inline constexpr std::string_view kRepaired = "from repaired records";

/// And of a scene of more fragments than are looked at one by one: stages 6 to 9 of the fragments about the pixels that
/// are worst in the planes, captured once more.
inline constexpr std::string_view kAtWorst = "from its records at the worst pixels";

/// The fragments that a diagnosis looks at one by one, an antialiased scene's passes together: some seconds' work.
inline constexpr std::uint64_t kMostFragments = std::uint64_t{1} << 20;

/// As judge(), and what it comes to. A stage is wrong by itself where exact, from the candidate's own records of the
/// stages before it (matrices: from the scene), or from repaired ones, is `different` or `failed`. Of an antialiased
/// scene: the passes together, and `resolve`.
Diagnosis diagnose(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                   std::uint64_t most_fragments = kMostFragments);
/// The same stages; findings say who and by how much, without numbers, causes and pictures. For many runs.
Diagnosis diagnose_in_brief(const Scene& scene, Renderer& candidate, std::span<const Reference> references);

/// What all stages up to merge should hand on: each as `referee` makes it of its own records before it, rounded to
/// the formats. Throws Unsupported where it does not run a stage, and OverBudget.
Capture expected_capture(const Scene& scene, Renderer& referee);

}  // namespace plumbline::check
