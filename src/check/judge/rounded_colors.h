// Colours that a foreign candidate rounds to codes before they are merged (Conventions::vertex_colors,
// fragment_colors).
#pragma once

#include "check/judge/scene_judgement.h"

namespace plumbline::check {

/// Exact's records for comparisons of stage attributes or shade: those given; for a foreign candidate whose colours are
/// codes, a copy, stored in `made`, in which each colour is the nearest to the candidate's that rounding may make of
/// exact's. A rounding moves a colour by up to half a code to either side (nearest), or by up to a code down or up, as
/// color_rounding declares. Attributes: one rounding of each fragment, and one of vertices, to the nearest, where the
/// triangle's corners are no codes yet. Shaded colours: one of the result; one of each of
/// colour and texel that is not a code in the candidate's records, of an environment's colour and of each further sum
/// (secondary colour, light of fragments, fog).
const Records<double>& with_rounded_colors(const SceneJudgement& c, Stage stage, const Records<double>& theirs,
                                           Records<double>& made);

}  // namespace plumbline::check
