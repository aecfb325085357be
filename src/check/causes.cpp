#include "check/causes.h"

namespace plumbline::check {

std::vector<Cause> likely_causes(const Evidence&) { return {}; }

}  // namespace plumbline::check
