// Varyings (capture/varying.h), stage by stage: each goes the colour's way. All throw std::invalid_argument where the
// records do not fit the scene or each other.
#pragma once

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Stage 2, from records.vertices and lights_of() (geometry.h): out.varyings' vertices.
void light_varyings(const Scene& scene, const Records<double>& in, Records<double>& out);

/// Stage 3: their clipped values, beside clip_primitives' vertices.
void clip_varyings(const Scene& scene, const Records<double>& in, Records<double>& out);

/// Stage 4: their triangles, beside out.triangles, which are made already; back faces among these get the back's
/// colours (OpenGL 2.1 spec 2.14.1).
void window_varyings(const Scene& scene, const Records<double>& in, Records<double>& out);

/// Stage 7: their fragments, beside records.covered.
void fragment_varyings(const Scene& scene, const Records<double>& in, Records<double>& out);

}  // namespace plumbline::exact
