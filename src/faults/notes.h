// Mistakes, gaps and warnings of the course notes as faults, named notes.NUMBER.MISTAKE. 000 is GzRender, 001 GAMES101
// (no fault), 002 TinyRenderer, 004 the class notes of CSCI 580. A mistake that is right by the conventions of its own
// dialect changes nothing there.
//
// Mistakes without a fault, because no picture shows them: the midpoint's b/2, which is no integer (004, section 2.2);
// loops up to x = xs, which leave the frame (000).
#pragma once

#include <span>

#include "faults/fault.h"

namespace plumbline::faults {

/// By note. `changes` begins with the note's section.
std::span<const Fault> of_notes();

}  // namespace plumbline::faults
