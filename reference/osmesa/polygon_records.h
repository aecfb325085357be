// What GL tells of stages 3 and 4, by feedback mode.
#pragma once

#include <span>

#include "reference/osmesa/scene_in_gl.h"
#include "stages/renderer.h"

namespace plumbline::osmesa {

/// Puts records.polygons and records.triangles, where the request names their stages. `lit`: the colours of all draws'
/// vertices. Call with a Target bound.
void read_polygons(const Gl& gl, const SceneInGl& scene, std::span<const Lit<double>> lit, const Request& request,
                   Records<double>& records);

}  // namespace plumbline::osmesa
