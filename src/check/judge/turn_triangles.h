// Order of the corners of a foreign renderer's window triangles.
#pragma once

#include "capture/renderer.h"
#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Turns the candidate's window triangles of three corners, with their varyings, into the order of the reference's: a
/// renderer may begin a triangle at any corner. Each triangle takes the turn (0, 1 or 2 corners) under which most of its
/// numbers match, to 1e-3, those of one of the reference's triangles of the primitive: a wrong number is outvoted.
/// Ties: the smallest distance, then the turn that most triangles take, then 0.
void turn_triangles(Records<double>& candidate, const Records<double>& reference);

/// turn_triangles() into the order of those that the referee makes of the candidate's polygons. `shown`: the candidate's
/// info; nothing is turned where the records that stage window needs are not shown, or do not suit the referee.
void turn_as_made(const Scene& scene, const RendererInfo& shown, Renderer& referee, Capture& candidate);

}  // namespace plumbline::check
