// A diagnosis as text for a terminal.
#pragma once

#include <optional>
#include <string>

#include "check/diagnose/diagnose.h"

namespace plumbline::report {

/// Rows are stages, columns who judged them; an arrow at `first`.
std::string stage_table(const check::SceneVerdict& verdict, std::optional<Stage> first);

/// The table; the first different stage, and those wrong by themselves; what is known of each; what failed or is
/// missing.
std::string diagnosis_text(const check::Diagnosis& diagnosis);

}  // namespace plumbline::report
