// All scenes of a run, judged in worker processes.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>

#include "cli/scene_judge.h"

namespace plumbline::cli {

/// Workers for so many requests: --jobs, or the number of processors.
std::size_t worker_count(const CheckOptions& options, std::size_t requests);

/// Judges the scenes in worker processes; take(judged) for each, in order. A renderer that ends its worker has failed
/// at that step: the next worker judges the scene once more without asking it again. `words`: texts that verdicts refer
/// to.
void judge_in_workers(std::span<const Scene> scenes, const CheckRules& rules, std::set<std::string>& words,
                      const std::function<void(JudgedScene)>& take);

}  // namespace plumbline::cli
