// Order of the corners of a foreign renderer's window triangles.
#pragma once

#include "capture/renderer.h"
#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Rotates the corners of the candidate's window triangles, with their varyings, into the reference's order: a renderer
/// may begin a triangle at any corner. Each triangle takes the rotation (by 0, 1 or 2 corners) under which most of its
/// numbers match, to 1e-3, those of one of the reference's triangles of the primitive: a wrong number is outvoted.
/// Ties: the smallest distance, then the rotation that most triangles take, then 0.
void rotate_corners(Records<double>& candidate, const Records<double>& reference);

/// rotate_corners() into the order of the triangles that the referee makes of the candidate's polygons. `shown`: the
/// candidate's info. Rotates nothing where the candidate does not show the records that stage window reads, or the
/// referee refuses them.
void rotate_as_made(const Scene& scene, const RendererInfo& shown, Renderer& referee, Capture& candidate);

}  // namespace plumbline::check
