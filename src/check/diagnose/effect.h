// How much of the final picture a wrong stage explains.
#pragma once

#include <cstddef>

#include "check/diagnose/evidence.h"

namespace plumbline::check {

/// Number of pixels whose colour or depth differs between two frames that the referee completes: one from the
/// candidate's records up to the evidence's stage, one with the expected records of that stage. Differences of at most
/// 1/255 in colour and one step in depth do not count. 0 without a referee, or where it fails.
std::size_t pixels_explained(const Evidence& evidence);

}  // namespace plumbline::check
