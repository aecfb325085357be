// The outcomes of all changes, counted by what was changed.
#pragma once

#include <string>
#include <vector>

#include "mutation/choose.h"
#include "mutation/judge.h"

namespace plumbline::mutation {

/// A change that compiles, and what came of it.
struct Judged {
  std::string seed;
  std::size_t number = 0;  ///< of the seed's changes, from 1
  Change change;
  ChangedLines lines;
  const FileRule* rule = nullptr;
  Verdict verdict;
};

/// One line: number, place, the line as it was and as it is.
std::string description(const Judged& judged);
/// One line: the outcome, the scene, and who named what.
std::string outcome_line(const Judged& judged);

/// Counts of changes, from which holds() takes its shares.
struct Score {
  std::size_t changes = 0, equivalent = 0, found = 0;
  std::size_t by_tables = 0;  ///< of those found, in data that every renderer is given, by the data's tests alone
  std::size_t in_stages = 0, named = 0;     ///< of those not equivalent in files of stages; named by check and diagnose
  std::size_t in_painter = 0, picture = 0;  ///< of those found in files of the painter; `picture` and nothing else
};
Score score_of(const std::vector<Judged>& judged);
/// True: at least 200 changes, at most 12 % of them equivalent, at least 97 % of the others found, at least 93 % of
/// those in stages named rightly; of the painter's that are found, all by the row `picture` alone.
bool holds(const Score& score);

/// The table by stage, the changes that were not found, those that were named otherwise, and the shares.
std::string report_of(const std::vector<Judged>& judged);
/// The log: a line of column names, then a line for each change, fields apart by tabs.
std::string log_of(const std::vector<Judged>& judged);

}  // namespace plumbline::mutation
