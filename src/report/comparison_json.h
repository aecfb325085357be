// A comparison as JSON, as files and pages have it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "check/verdict.h"

namespace plumbline::report {

/// As write_json() (json_report.h) says of each of "comparisons".
nlohmann::ordered_json comparison_json(const check::Comparison& comparison);

}  // namespace plumbline::report
