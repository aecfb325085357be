// The worst record of a wrong stage, with all its numbers.
#pragma once

#include <string>
#include <vector>

#include "check/diagnose/evidence.h"
#include "check/verdict/measure.h"
#include "check/verdict/verdict.h"

namespace plumbline::check {

/// Text lines: the record's place, input, output, expected output (of a judge of legal answers: the nearest legal
/// value) and the difference; also the triangle and its corners where the record belongs to a triangle.
std::vector<std::string> worst_record(const Evidence& evidence, const JudgeId& judge, const Measurement& measurement);

}  // namespace plumbline::check
