// The worst record of a wrong stage, with all its numbers.
#pragma once

#include <string>
#include <vector>

#include "check/diagnose/evidence.h"
#include "check/verdict/measure.h"
#include "check/verdict/verdict.h"

namespace plumbline::check {

/// Lines: where it is, what came in, what came out, what was expected (of a judge of what is legal, the nearest legal
/// value), and how far they are apart; the triangle and its corners where there are such.
std::vector<std::string> worst_record(const Evidence& evidence, const JudgeId& judge, const Measurement& measurement);

}  // namespace plumbline::check
