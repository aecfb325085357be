// plumb check --submissions: many programs over the same scenes, a row for each.
#pragma once

#include <optional>
#include <span>

#include "cli/scene_judge.h"
#include "report/runs/grade.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// Judges the rules' program for each folder in --submissions, by name. With a rubric, leaves NAME.json in --grades for
/// each; --markdown holds the table. Returns the exit code: 0 where all scenes of all of them hold. Throws
/// std::invalid_argument where there is no folder, and OutputError.
int check_submissions(const CheckRules& rules, std::span<const Scene> scenes,
                      const std::optional<report::Rubric>& rubric);

}  // namespace plumbline::cli
