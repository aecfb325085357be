// Findings of a campaign, left for people: a folder for each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "campaign/results.h"
#include "cli/scene_judge.h"

namespace plumbline::cli {

/// Writes a folder `folder`/STAGE-CAUSE-REFERENCE for each group of findings: found.json, the group's lowest scene;
/// scene.json, that scene made smaller; scene.txt, its rows and the command that repeats them; scene/, its page. A
/// folder stays as it is where scene.json and scene.txt are there and found.json is the group's lowest scene. Returns
/// lines for people about the folders that were written. Throws OutputError.
std::string leave_findings(const std::filesystem::path& folder, const std::vector<campaign::Group>& groups,
                           const CheckRules& rules);

}  // namespace plumbline::cli
