// The verdict as lines for a terminal or a log.
#pragma once

#include <span>
#include <string>

#include "check/compare/compare_stored.h"
#include "check/verdict/verdict.h"

namespace plumbline::report {

std::string table_head();
/// A line per comparison; one line for all stages that a reference does not judge for the same reason.
std::string table_rows(const check::SceneVerdict& verdict);
/// A line for a scene that holds: numbers of its comparisons by outcome; or that nothing of it was judged.
std::string scene_line(const check::SceneVerdict& verdict);
/// For a scene that failed: the first different stage, its worst item, other stages that are wrong by themselves,
/// stages whose lack of a judge is a failure, and the command that repeats it; else empty.
std::string failure_lines(const check::SceneVerdict& verdict, std::span<const Stage> unjudged,
                          const std::string& repeat_command);
/// A line per group (the part of a scene's name before its first '/'), sorted: numbers of scenes and of comparisons,
/// the latter by outcome.
std::string group_lines(std::span<const check::SceneVerdict> verdicts);
/// The last line: a word, and numbers of comparisons by outcome. "FAILED" unless all hold; "nothing was judged"; "ok"
/// where every stage was judged and no row is unsupported, missing, disputed or expected; else "ok where judged".
std::string summary(std::span<const check::SceneVerdict> verdicts, bool all_hold, double seconds);

/// A comparison of two images or captures: a line each, under a head.
std::string stored_table(std::span<const check::StoredComparison> comparisons, double tolerance);

}  // namespace plumbline::report
