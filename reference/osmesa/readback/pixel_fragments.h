// The fragments of single pixels: which primitives reach one, and what becomes of each, by drawing them one at a time.
#pragma once

#include "capture/renderer.h"
#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// Of each of request.pixels, in their order, the fragments in draw order, one per primitive: triangles (of no corners:
/// primitive and front are all that is known of them), covered, and, as asked for, depth in the frame's format; texels,
/// whose level of detail OpenGL does not tell (NaN); shaded, in float; drawn, by the scene's own tests in the frame's
/// own formats. A primitive that has several fragments there, as outlines do at their corners, is handed out once, with
/// the last's values. Throws RendererFailed.
void read_pixel_fragments(const Gl& gl, const SceneInGl& scene, const Request& request, Records<double>& records);

}  // namespace plumbline::osmesa
