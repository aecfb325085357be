// The verdict as lines for a terminal or a log.
#pragma once

#include <span>
#include <string>

#include "check/verdict.h"

namespace plumbline::report {

std::string table_head();
/// A line per comparison.
std::string table_rows(const check::SceneVerdict& verdict);
/// For a scene that failed: the first different stage, its worst item, and the command that repeats it; else empty.
std::string failure_lines(const check::SceneVerdict& verdict, const std::string& repeat_command);
/// The last lines: how many comparisons came to what. Never a bare "ok" where anything is unsupported or missing.
std::string summary(std::span<const check::SceneVerdict> verdicts, double seconds);

}  // namespace plumbline::report
