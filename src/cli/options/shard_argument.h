// A part of a run, as it is named on a command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/runs/json_report.h"

namespace plumbline::cli {

/// "I/N": leaves every Nth file, from number I on; an empty text leaves all. Throws std::invalid_argument otherwise.
report::Shard take_shard(std::vector<std::filesystem::path>& files, const std::string& text);

}  // namespace plumbline::cli
