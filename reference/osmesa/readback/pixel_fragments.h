// Fragments of single pixels, by drawing primitives one at a time: which reach a pixel, their values, and which are
// drawn.
#pragma once

#include "capture/renderer.h"
#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// Appends records of the fragments at request.pixels, pixel by pixel in their order, each in draw order, one per
/// primitive: triangles (with `corners` 0: only primitive and front are known), covered, and, as requested, depth in
/// the frame's format; texels, with a LOD of NaN, as OpenGL does not tell it; shaded, in float; drawn, by the scene's
/// tests in the frame's formats. A primitive with several fragments at a pixel, as outlines have at their corners, has
/// one record, with the values of the last. Throws RendererFailed.
void read_pixel_fragments(const Gl& gl, const SceneInGl& scene, const Request& request, Records<double>& records);

}  // namespace plumbline::osmesa
