// A run of plumb check as its JSON file holds it, read back.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "check/verdict/verdict.h"
#include "report/runs/json_report.h"

namespace plumbline::report {

struct CheckRun {
  std::string file;
  RunHead head;
  std::map<std::string, double> tolerances;   ///< the ledger's factors, by row
  std::vector<check::SceneVerdict> verdicts;  ///< Place::field of each row points into `words`
  std::set<std::string> words;
};

/// Reads the JSON file of a run. Throws JsonError (json_tree.h) for a file that write_json() does not leave.
CheckRun read_run(const std::filesystem::path& file);

/// Whether no scene has a failure.
bool all_hold(std::span<const check::SceneVerdict> verdicts);
/// Sum of the scenes' times [s].
double seconds(std::span<const check::SceneVerdict> verdicts);

}  // namespace plumbline::report
