// A verdict: per scene, reference and stage, one comparison with its outcome.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/stages.h"
#include "check/verdict/ledger.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

enum class Outcome {
  equal,           ///< no difference (-0 is 0, but for pictures and goldens)
  within,          ///< within the tolerance
  ambiguous_only,  ///< within, and some items have more than one legal answer
  different,       ///< beyond the tolerance, or outside the legal answers
  dispute,         ///< the reference, not the candidate, is outside the legal answers: listed, not our failure
  unsupported,     ///< not judged: one side does not show the stage, or it cannot be compared; `note` says why
  missing,         ///< the reference is not here
  failed,          ///< a renderer crashed, hung, or broke the protocol
  expected         ///< different, missing or failed, and known (expectations.h)
};
inline constexpr std::size_t kOutcomes = 9;
std::string_view name_of(Outcome outcome);
/// equal, within, ambiguous_only.
bool holds(Outcome outcome);
/// Note of a row without records of fragments: the scene has more than `most_fragments` (judge_single.h).
inline constexpr std::string_view kOverBudget = "more fragments than are looked at one by one";

/// different, failed, missing.
bool is_failure(Outcome outcome);

/// How a row judges.
enum class Kind {
  side_by_side,  ///< by a reference's records and planes of the same scene
  legal,         ///< by a reference's legal answers (legal.h) of the same scene
  from_scene,    ///< by the referee's records and legal answers of the same scene
  per_stage,     ///< against the referee's stage, run on the candidate's own records
  at_worst,      ///< per_stage, of the fragments about the worst pixels alone (diagnose.h)
  repaired,      ///< per_stage, the referee's records in place of wrong stages' (diagnose.h)
  golden,        ///< against the scene's golden (golden.h), hashes and a frame of an earlier run: no vote
  picture        ///< each painter's frame, drawn without records, against the frame drawn with records: no vote
};
inline constexpr std::array<std::string_view, 8> kKindNames = {"side_by_side", "legal",    "from_scene", "per_stage",
                                                               "at_worst",     "repaired", "golden",     "picture"};
constexpr std::string_view name_of(Kind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

/// Who judges in a row, and how.
struct JudgeId {
  std::string reference;  ///< the renderer's name; "golden", "picture" of these kinds
  Kind kind = Kind::side_by_side;
  JudgeId(std::string name, Kind how = Kind::side_by_side) : reference(std::move(name)), kind(how) {}
  JudgeId(const char* name) : reference(name) {}
  bool operator==(const JudgeId&) const = default;
};
/// The judge's name for people, such as "exact, per stage".
std::string title_of(const JudgeId& judge);

struct Comparison {
  std::string scene;
  JudgeId judge{""};
  Stage stage = Stage::matrices;
  Outcome outcome = Outcome::equal;
  Measurement measurement;
  std::string ledger_row;  ///< name of the tolerance (ledger.h), or empty: zero
  std::string note;        ///< why unsupported, missing, failed; what is ambiguous
};

/// Whether the row compared anything: false if unsupported, missing or failed, also where that was expected.
bool was_compared(const Comparison& row);
/// Whether the row judges a stage: goldens and pictures repeat the candidate, and have no vote.
inline bool votes(const Comparison& row) { return row.judge.kind < Kind::golden; }
/// Whether the judge holds the stage to an oracle's legal answers, not to one renderer's numbers.
inline bool judges_legality(const JudgeId& judge, Stage stage) {
  return judge.kind == Kind::legal || (judge.kind == Kind::from_scene && !kGeometryStages.has(stage));
}
/// Whether the row judges its stage by the records before it alone: an earlier stage's error is not seen in it.
inline bool judges_alone(const Comparison& row) {
  const Kind kind = row.judge.kind;
  return kind == Kind::per_stage || kind == Kind::at_worst || kind == Kind::repaired ||
         (kind == Kind::from_scene && row.stage == Stage::matrices);
}

/// The row of a measurement: `different`, `dispute`, `ambiguous_only`, `within` or `equal`, the first that applies. Its
/// `mismatch` replaces `note`.
Comparison judged(std::string scene, JudgeId judge, Stage stage, Measurement measurement,
                  const Tolerance* tolerance = nullptr, std::string note = "");
/// Turns the row into a dispute: its differing items become disputed, for the reason `why`.
void to_dispute(Comparison& comparison, std::string why);
/// Worst item of a row; of a dispute the disputed item with the largest difference. Null where nothing differs.
const Worst* shown(const Comparison& comparison);
/// Text of a row: the place of shown(); of a dispute both values, the count and the reason; the note.
std::string remark(const Comparison& comparison);
/// Row without a measurement. `outcome`: unsupported, missing or failed. `note`: the reason, for people.
Comparison not_judged(std::string scene, JudgeId judge, Stage stage, Outcome outcome, std::string note);

/// All comparisons of one scene, in stage order for each reference.
struct SceneVerdict {
  std::string scene;
  std::string path;
  std::vector<Comparison> comparisons;
  double seconds = 0;
  bool empty_holds = false;     ///< the cleared frame is legal, and so is another: drawing nothing is no mistake
  bool knows_no_color = false;  ///< no surface's colour is known to half of its range (open_pixels.h)
  std::string failure{};        ///< lines: why it does not hold; empty: it does
  std::string repeat{};         ///< the command that repeats the failure
  /// Known faults, as "STAGE (fault NAME)", that reproduce the candidate's frame; the frame does not distinguish them.
  std::vector<std::string> causes{};
};

/// Group of a scene of a suite: its name up to the first '/'.
std::string group_of(std::string_view scene);

/// Whether a row of Kind::per_stage holds for the stage.
bool holds_alone(const SceneVerdict& verdict, Stage stage);

/// The `different` row of the lowest stage; of several at one stage, that of Kind::per_stage, which is wrong by itself,
/// else the first listed; null if none. Where that stage holds alone and some row of Kind::per_stage is `different`,
/// the lowest of those rows instead: planes of depth, texels and colours hold the winners' values, so a wrong depth
/// test, stencil test or frame of a later stage changes them, too.
const Comparison* first_different(const SceneVerdict& verdict);

/// Whether attributes, texture or shade differ, and by no more than stepping along edges and rows in float makes.
bool differs_by_steps(const SceneVerdict& verdict, Stage stage);
/// The `different` row of the lowest stage that does not differ by steps alone; null if none.
const Comparison* first_beyond_steps(const SceneVerdict& verdict);

/// Whether a row says that the stage is legal, and none that it is not. Where no such row judges attributes, texture or
/// shade, and they differ by no more than stepping in float makes, they are legal if merge is.
bool is_legal(const SceneVerdict& verdict, Stage stage);
/// Stages that a reference judged.
std::vector<Stage> judged_stages(const SceneVerdict& verdict);
/// Whether depth and merge alone were compared, as a frame shows them: an earlier stage may be what is wrong.
bool is_by_frame_alone(const SceneVerdict& verdict);
/// Whether the rows would accept almost any frame: every item compared has several legal answers; or so has every
/// colour of the frame, or of its surfaces; or the cleared frame holds, too.
bool is_open(const SceneVerdict& verdict);
/// Whether a reference judged a stage of the scene, and the scene is not open.
bool is_judged(const SceneVerdict& verdict);
/// Whether a scene was judged (is_judged()).
bool any_judged(std::span<const SceneVerdict> verdicts);
/// For people: how many of the 13 stages were judged, and why the others were not.
std::string judged_text(const SceneVerdict& verdict);
/// Stages that no reference judged, in order; texture and resolve only where some row names them.
std::vector<Stage> unjudged_stages(const SceneVerdict& verdict);
/// Unjudged stages that a missing reference may have judged: no row of theirs is unsupported or failed. Empty if none
/// is missing.
std::vector<Stage> stages_lost_to_missing(const SceneVerdict& verdict);

/// The largest ratio of difference to tolerance that a run saw for each row of the ledger; below 0: row not used.
struct LedgerUse {
  const Tolerance* row;
  double largest_ratio;
  std::string where;  ///< scene, judge, place
};
std::vector<LedgerUse> ledger_use(std::span<const SceneVerdict> verdicts);

}  // namespace plumbline::check
