// The worst record of a wrong stage, with all its numbers.
#pragma once

#include <string>
#include <vector>

#include "check/causes.h"
#include "check/measure.h"

namespace plumbline::check {

/// Lines: where it is, what came in, what came out, what was expected, and how far they are apart; the triangle and its
/// corners where there are such.
std::vector<std::string> worst_record(const Evidence& evidence, const Measurement& measurement);

/// Of coverage: the worst triangle's pixels, `#` both, `?` missing, `!` extra, rows from the top of the window, at most
/// 64 x 32 about what differs, under a line that says where its lower left pixel is. Empty where none differ.
std::string coverage_picture(const Evidence& evidence);

}  // namespace plumbline::check
