// Who stands alone is suspect: a reference that two others and exact arithmetic contradict.
#pragma once

#include <vector>

#include "check/verdict/verdict.h"

namespace plumbline::check {

/// One scene's rows: `different` becomes `dispute`, with the evidence as its reason, where a reference is outvoted: of
/// one stage its row alone differs; exact, from the candidate's own records of the stage before, holds, and so does
/// another reference that judges the stage. No row of an earlier stage differs either: exact only propagates such an
/// error, so its agreement is no evidence. (Embree and exact
/// share the formula of what is legal: of that they are one vote, and the arithmetic on records the other. From texture
/// on they share that, too, and are one vote in all.)
void settle_votes(std::vector<Comparison>& rows);

/// Rows of a candidate whose arithmetic is its own (Profile::foreign): a `different` row side by side, whose tolerance
/// is that of one float recipe on both sides, becomes `unsupported` where exact judges the same stage and the stage
/// holds. What the stage was handed is judged in the rows of the stages before.
void leave_recipes_to_exact(std::vector<Comparison>& rows);

}  // namespace plumbline::check
