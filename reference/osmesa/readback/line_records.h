// Which pixels each line covers: OpenGL leaves some of that open, so the lines are looked at one by one.
#pragma once

#include "capture/stages.h"
#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// records.covered of the lines among records.triangles, the edges of triangles that are not filled included, and of
/// them alone; of a point or a filled triangle, the planes say all. Call with records.triangles read.
void read_covered_lines(const Gl& gl, const SceneInGl& scene, Records<double>& records);

}  // namespace plumbline::osmesa
