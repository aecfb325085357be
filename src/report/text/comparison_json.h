// A number and a comparison as JSON, as files and pages have it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// JSON of a number. NaN and infinities, which are no JSON numbers, become text: "nan", "inf", "-inf".
nlohmann::ordered_json json_number(double value);

/// {"place", "candidate", "reference", "difference", "tolerance", "pixel" (where it has one)}.
nlohmann::ordered_json worst_json(const check::Worst& worst);

/// JSON of a comparison, with the keys that write_json() (json_report.h) lists under "comparisons".
nlohmann::ordered_json comparison_json(const check::Comparison& comparison);

}  // namespace plumbline::report
