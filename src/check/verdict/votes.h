// Votes on a reference: one that exact arithmetic and another reference contradict is at fault.
#pragma once

#include <vector>

#include "check/verdict/verdict.h"

namespace plumbline::check {

/// Settles one scene's rows: a `different` row becomes `dispute`, with the voters in its reason, where its reference is
/// outvoted. At the row's stage exact, on the candidate's own records (Kind::per_stage), and another reference hold,
/// and no other reference fails. At an earlier stage no row fails at all: exact only propagates an earlier error, so
/// its agreement is no evidence. Rows of Kind::per_stage, and rows that exceed only a budget of ambiguity, stay as they
/// are. Embree (by the formula of what is legal) and exact (by arithmetic on records) are two votes before texture;
/// from there on Embree uses exact's arithmetic, too, and both are one vote. `plain` (capture/varying.h, is_plain()):
/// shade repeats attributes, so Embree and exact stay two votes up to shade. A merge that differs only where the
/// reference's winners are outvoted follows from these, and is a dispute as well.
void settle_votes(std::vector<Comparison>& rows, bool plain = false);

/// Rows of a candidate whose arithmetic is its own (Profile::foreign): a `different` row side by side, whose tolerance
/// is that of one float recipe on both sides, becomes `unsupported` where exact judges the same stage and the stage
/// holds, or, of vertex to window, where exact lacks records to judge it. Rows of earlier stages judge the stage's
/// input.
void leave_recipes_to_exact(std::vector<Comparison>& rows);

}  // namespace plumbline::check
