// A verdict: per scene, reference and stage, one comparison with its outcome.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture/stages.h"
#include "check/verdict/ledger.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

enum class Outcome {
  equal,           ///< not a bit apart
  within,          ///< within the tolerance
  ambiguous_only,  ///< apart only where more than one answer is legal, and among the legal ones
  different,       ///< beyond the tolerance, or outside the legal answers
  dispute,         ///< the reference, not the candidate, is outside the legal answers: listed, not our failure
  unsupported,     ///< the reference does not show the stage
  missing,         ///< the reference is not here
  failed,          ///< a renderer crashed, hung, or broke the protocol
  expected         ///< one of the three above, and known (expectations.h)
};
inline constexpr std::size_t kOutcomes = 9;
std::string_view name_of(Outcome outcome);
/// different, failed, missing.
bool is_failure(Outcome outcome);

struct Comparison {
  std::string scene;
  std::string reference;  ///< renderer, and for one that runs stages: "from scene" or "from its records"
  Stage stage = Stage::matrices;
  Outcome outcome = Outcome::equal;
  Measurement measurement;
  std::string ledger_row;  ///< of the tolerance, or empty: zero
  std::string note;        ///< why unsupported, missing, failed; what is ambiguous
};

/// The reference of rows that compare a scene with its golden (golden.h): what was drawn before, which judges nothing.
inline constexpr std::string_view kGolden = "golden";
/// The reference of rows that compare the frame as it ships with the frame that was watched, bit for bit: each of the
/// candidate's painters, the first that differs.
inline constexpr std::string_view kPicture = "picture";
/// Whether the row's reference judges a stage: goldens and pictures repeat the candidate, and have no vote.
inline bool votes(const Comparison& row) { return row.reference != kGolden && row.reference != kPicture; }

/// The outcome that a measurement comes to.
Comparison judged(std::string scene, std::string reference, Stage stage, Measurement measurement,
                  std::string_view ledger_row = "", std::string note = "");
/// Makes what differs in the row the reference's fault, and says why.
void to_dispute(Comparison& comparison, std::string why);
/// What a row shows: of a dispute its largest difference, else the worst of all; null where nothing differs.
const Worst* shown(const Comparison& comparison);
/// Where that is, what is disputed and why, and the note.
std::string remark(const Comparison& comparison);
Comparison not_judged(std::string scene, std::string reference, Stage stage, Outcome outcome, std::string note);

/// All comparisons of one scene, in stage order for each reference.
struct SceneVerdict {
  std::string scene;
  std::string path;
  std::vector<Comparison> comparisons;
  double seconds = 0;
  std::string failure{};  ///< lines: why it does not hold; empty: it does
  std::string repeat{};   ///< the command that repeats the failure
};

/// Suffix of the references' names in rows that a reference makes of the candidate's own records.
inline constexpr std::string_view kFromRecords = "from its records";
/// Whether a row of that suffix finds nothing wrong with the stage.
bool holds_alone(const SceneVerdict& verdict, Stage stage);

/// The comparison to be named: the first by stage that is different; of several at one stage, the first listed. Null if
/// none. Where its stage holds alone, the first stage that is different by the candidate's own records comes before it:
/// planes of depth, colours and texels are the last winners', so that a wrong test of depths or stencil values, or a
/// wrong frame, is seen in them, too.
const Comparison* first_different(const SceneVerdict& verdict);

/// The stages, but texture, that nobody judged: none compared them, or all that are there declined (`unsupported`).
std::vector<Stage> unjudged_stages(const SceneVerdict& verdict);
/// Those of them that a reference which is missing may have judged: none that is there declined them.
std::vector<Stage> stages_lost_to_missing(const SceneVerdict& verdict);

/// The largest ratio of difference to tolerance that a run saw for each row of the ledger; below 0: row not used.
struct LedgerUse {
  const Tolerance* row;
  double largest_ratio;
  std::string where;  ///< scene, reference, place
};
std::vector<LedgerUse> ledger_use(std::span<const SceneVerdict> verdicts);

}  // namespace plumbline::check
