// One run of plumb check against an earlier one.
#pragma once

#include <string>
#include <vector>

#include "report/runs/run_file.h"

namespace plumbline::report {

/// Changes that are too small to be reported.
struct DiffLimits {
  double factor = 1.25;      ///< a largest difference, or a count, has moved if it is that much larger or smaller
  double slower = 1.5;       ///< a scene's time likewise,
  double at_least_s = 0.25;  ///< and by so many seconds
};

/// One difference between two runs.
struct Change {
  std::string what;      ///< scene, or scene, reference, stage; a tolerance's row
  std::string was, now;  ///< outcome, number or time
};

struct RunDiff {
  std::vector<Change> versions;     ///< renderers' versions; the fault and the references asked for
  std::vector<Change> broken;       ///< fails, and did not fail or was not there
  std::vector<Change> lost;         ///< was judged and is not run, or not judged, any more
  std::vector<Change> excused;      ///< differs as expected, and was not expected to
  std::vector<Change> fixed;        ///< failed, or differed as expected, and holds
  std::vector<Change> added, gone;  ///< new rows that are no failure; rows that were not judged and are gone
  std::vector<Change> moved;        ///< other changes of outcome, such as from failed to different
  std::vector<Change> tolerances;   ///< the ledger's factors
  std::vector<Change> differences;  ///< the largest, and how many, of rows with one outcome
  std::vector<Change> times;        ///< of scenes
};

RunDiff diff(const CheckRun& before, const CheckRun& now, const DiffLimits& limits = {});
/// Nothing broken and nothing lost.
bool holds(const RunDiff& diff);

/// A list for each kind of change that there is, the worst kinds first; a line for none.
std::string diff_text(const RunDiff& diff);
std::string diff_markdown(const RunDiff& diff);
/// {"holds", "<kind>": [{what, was, now}]}
std::string diff_json(const RunDiff& diff);

}  // namespace plumbline::report
