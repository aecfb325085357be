// Order of the corners of a foreign renderer's window triangles.
#pragma once

#include "capture/renderer.h"
#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Turns the candidate's window triangles of three corners, with their varyings, into the order of the reference's: a
/// renderer may begin a triangle at any corner. A triangle takes the turn under which most of its numbers are those of
/// one of the primitive's triangles of the reference, to 1e-3; of several such turns the nearest, of equally near ones
/// the one of most triangles, and 0 where no number tells. A wrong number does not decide: the others do.
void turn_triangles(Records<double>& candidate, const Records<double>& reference);

/// turn_triangles() into the order of those that the referee makes of the candidate's polygons. `shown`: the candidate's
/// info; nothing is turned where the records that stage window needs are not shown, or do not suit the referee.
void turn_as_made(const Scene& scene, const RendererInfo& shown, Renderer& referee, Capture& candidate);

}  // namespace plumbline::check
