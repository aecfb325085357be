// The verdict for a CI page, in Markdown as GitHub and GitLab show it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// Text for a cell of a table: one line, in which what Markdown or HTML would interpret is escaped.
std::string cell(std::string_view text);

/// The summary; numbers of comparisons by outcome; a row for each scene that does not hold (at most
/// 200), with its first different stage and the command that repeats it; what was disputed or expected.
std::string markdown(std::span<const check::SceneVerdict> verdicts, const std::string& summary);

}  // namespace plumbline::report
