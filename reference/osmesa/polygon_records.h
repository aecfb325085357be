// What GL tells of stages 3 and 4, by feedback mode.
#pragma once

#include <vector>

#include "reference/osmesa/scene_in_gl.h"
#include "stages/renderer.h"

namespace plumbline::osmesa {

/// Puts records.polygons and records.triangles, where the request names their stages. Call within a SavedState, a
/// Target bound.
void read_polygons(const Gl& gl, const SceneInGl& scene, const Request& request, Records<double>& records);

}  // namespace plumbline::osmesa
