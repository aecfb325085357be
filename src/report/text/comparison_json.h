// A number and a comparison as JSON, as files and pages have it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// What JSON has no number for is text: "nan", "inf", "-inf".
nlohmann::ordered_json json_number(double value);

/// {"place", "candidate", "reference", "difference", "tolerance", "pixel" (where it has one)}.
nlohmann::ordered_json worst_json(const check::Worst& worst);

/// As write_json() (json_report.h) says of each of "comparisons".
nlohmann::ordered_json comparison_json(const check::Comparison& comparison);

}  // namespace plumbline::report
