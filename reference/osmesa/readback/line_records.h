// Coverage of single lines: OpenGL leaves some of it open, so that lines are compared one by one.
#pragma once

#include "capture/stages.h"
#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// Appends to records.covered the pixels of the lines among records.triangles, edges of unfilled triangles included;
/// those of points and filled triangles are judged by the planes. Call after read_polygons(), which sets
/// records.triangles.
void read_covered_lines(const Gl& gl, const SceneInGl& scene, Records<double>& records);

}  // namespace plumbline::osmesa
