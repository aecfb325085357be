// Verdicts of an earlier campaign: after reasons for equivalent changes are written, only the rest is judged again.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tuple>

#include "mutation/score.h"

namespace plumbline::mutation {

/// Seed and number, file, the line before and after.
using ChangeKey = std::tuple<std::string, std::string, std::string, std::string, std::string>;
ChangeKey key_of(const Judged& judged);

/// A hash of src and reference below `root`. (Scenes may have been added: they find more, not less.)
std::string sources_hash(const std::filesystem::path& root);

/// The log's first line, which names the sources that it is of.
std::string log_head(const std::string& sources);

/// Verdicts of a log (log_head, then score.h, log_of) on changes that were found and rightly named, or are equivalent,
/// with the reason as their note. Throws std::runtime_error with file and line where a line has other fields or an
/// unknown outcome, and where the log is of other sources.
std::map<ChangeKey, Verdict> read_found(const std::filesystem::path& log, const std::string& sources);

}  // namespace plumbline::mutation
