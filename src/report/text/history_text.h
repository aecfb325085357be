// A pixel's history for people and for programs.
#pragma once

#include <string>

#include "check/diagnose/history.h"

namespace plumbline::report {

/// Renderers side by side, a block for each primitive that any of them has at the pixel, in draw order, then the frame.
/// What a renderer does not tell is "unsupported", with a number under which the reason stands below.
std::string history_text(const Scene& scene, const check::History& history);

/// {"scene", "pixel", "samples": [{pass, pixel, renderers: [{renderer, absent, fragments: [{primitive, draw, triangle,
/// front, depth, color, ..., drawn, fate, why}], lacks, frame: {color, depth, stencil}, notes, legal}]}], "resolved"}.
/// Unknown values are null. Numbers that JSON cannot hold are the strings "inf", "-inf" and "nan".
std::string history_json(const Scene& scene, const check::History& history);

}  // namespace plumbline::report
