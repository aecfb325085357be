// Varyings (capture/varying.h) in stages 2, 3, 4 and 7, each computed in a colour's place. All functions throw
// std::invalid_argument where the records do not fit the scene or each other. `in` and `out` may be one object.
#pragma once

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Stage 2: sets VaryingColumns::vertices, from in.vertices and lights_of() (geometry.h).
void light_varyings(const Scene& scene, const Records<double>& in, Records<double>& out);

/// Stage 3: appends to VaryingColumns::clipped, one entry per vertex of clip_primitives().
void clip_varyings(const Scene& scene, const Records<double>& in, Records<double>& out);

/// Stage 4: appends to VaryingColumns::triangles, one entry per out.triangles, which must be set. Back faces, in these
/// and in out.triangles, get the back's colours (OpenGL 2.1 spec 2.14.1).
void window_varyings(const Scene& scene, const Records<double>& in, Records<double>& out);

/// Stage 7: appends to VaryingColumns::fragments, one entry per in.covered; 0 where the draw does not carry the
/// varying.
void fragment_varyings(const Scene& scene, const Records<double>& in, Records<double>& out);

}  // namespace plumbline::exact
