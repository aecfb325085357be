// Merger of the shards of one run.
#pragma once

#include <string>
#include <vector>

#include "report/runs/run_file.h"

namespace plumbline::report {

struct Merged {
  CheckRun run;                      ///< scenes in the order of their files
  std::vector<std::string> missing;  ///< lines: shards that are not there, and what is lacking with them
};

/// Merges the runs, at least one. Throws std::runtime_error naming the files: versions or tolerances that differ, from
/// each other or from this program's; shards of another run; a scene twice, with results that differ (times may).
Merged merge(std::vector<CheckRun> runs);

}  // namespace plumbline::report
