// The verdict as JUnit's XML, which CI systems list and remember.
#pragma once

#include <span>
#include <string>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// A test case per scene, of the class of its group, with its time; of one that does not hold what failed, the command
/// that repeats it, and its rows. What is wrong with the run but for its scenes is a failure as well, a line each.
std::string junit(std::span<const check::SceneVerdict> verdicts, std::span<const std::string> of_run = {});

}  // namespace plumbline::report
