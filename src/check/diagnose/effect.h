// How much of the final picture a wrong stage explains.
#pragma once

#include <cstddef>

#include "check/diagnose/evidence.h"

namespace plumbline::check {

/// Number of pixels of which colour or depth differs between two frames that the referee makes of the stages after the
/// evidence's: of the candidate's records of the stage, and of the expected ones. Colours differ by more than 1/255,
/// depths by more than a step: rounding noise explains no pixel. 0 where a stage's records do not fit the next.
std::size_t pixels_explained(const Evidence& evidence);

}  // namespace plumbline::check
