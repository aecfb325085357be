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
  std::vector<check::SceneVerdict> verdicts;  ///< all that the file holds; the places of what is worst refer to `words`
  std::set<std::string> words;
};

/// Throws JsonError (json_tree.h): not what write_json() leaves.
CheckRun read_run(const std::filesystem::path& file);

bool all_hold(std::span<const check::SceneVerdict> verdicts);
double seconds(std::span<const check::SceneVerdict> verdicts);

}  // namespace plumbline::report
