// The references `osmesa` and `egl`: the scene drawn by Mesa's OpenGL, fixed function, in this process and without a
// window. Their contexts alone tell them apart: the one comes from OSMesa, the other from EGL.
#pragma once

#include <memory>

#include "capture/renderer.h"
#include "reference/osmesa/gl/mesa_driver.h"

namespace plumbline {

/// Make the context. The renderer, named after the library or, with it, `softpipe`, shows
///   matrices   as GL's matrix stacks and viewport hold them, the normal matrix as the inverse transpose of that
///   vertex     by transform feedback of a GLSL 1.20 program
///   light      each vertex drawn as a point, into RGBA32F
///   clip       by feedback mode without culling. p_clip comes from the window position, in double: a float's relative
///              error in p_win, times w. Polygons begin at any of their vertices. `cut` says that the position is not
///              that of one of the mesh triangle's vertices. Where back faces have no colours of their own, the
///              vertices go in with those of light
///   window     by the same feedback; facing and culling by stages.h's rule, the sign of the snapped area, because
///              feedback mode culls by the unsnapped one. GL's own culling shows in the planes. inv_w is 1 / (1 / (1 /
///              w)): the feedback hands out w. Feedback mode applies no flat shading: the colours of flat draws are
///              each vertex' own, and not to be compared
///   coverage   planes.count and planes.id_sum: the scene without a depth test, added up
///   depth, merge        planes.depth, planes.color: the scene in the frame's own formats
///   texture    planes.texel: REPLACE into RGBA32F, over fragments of (0, 0, 0, 1)
///   attributes, shade   planes.shaded: the scene in RGBA32F, over the frame's depth format
///   visibility          planes.id: a colour per primitive
///   coverage, depth, texture, shade, visibility   of single pixels, where a request names them and does not ask for
///              the window stage: records of their fragments, one primitive drawn at a time (pixel_fragments.h)
/// and runs nothing. Throws RendererFailed. Made one at a time; each for use by one thread, several beside each other.
/// Each is there if it is built in; make_opengl() makes osmesa, in a build without it egl.
std::unique_ptr<Renderer> make_opengl(MesaDriver driver = MesaDriver::llvmpipe);
std::unique_ptr<Renderer> make_osmesa(MesaDriver driver = MesaDriver::llvmpipe);
std::unique_ptr<Renderer> make_egl(MesaDriver driver = MesaDriver::llvmpipe);

}  // namespace plumbline
