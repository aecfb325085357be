// The verdict as JUnit's XML, which CI systems list and remember.
#pragma once

#include <span>
#include <string>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// A test case per scene, its group as class, with its time; if the scene does not hold, with the failure, the command
/// that repeats it, and its rows. Each line of `of_run`, failures outside scenes, is a failed test case as well.
std::string junit(std::span<const check::SceneVerdict> verdicts, std::span<const std::string> of_run = {});

}  // namespace plumbline::report
