// The references `osmesa`, `egl` and `softpipe`: the scene drawn by Mesa's OpenGL, fixed function, in this process and
// without a window. `osmesa` and `egl` differ only in the library that makes the context; `softpipe` is Mesa's other
// driver. A process can use one library with one driver (claim_process() of gl/context.h).
#pragma once

#include <memory>

#include "capture/renderer.h"
#include "reference/osmesa/gl/mesa_driver.h"

namespace plumbline {

/// Make a context and its renderer. The renderer, named after the library or, for that driver, `softpipe`, shows
///   matrices   as GL's matrix stacks and viewport hold them, the normal matrix as the inverse transpose of that
///   vertex     by transform feedback of a GLSL 1.20 program
///   light      each vertex drawn as a point, into RGBA32F
///   clip       by feedback mode without culling. p_clip is computed in double from p_win, a float: its error is that
///              of p_win, relative, times w. Polygons begin at any of their vertices. `cut`: the position is not that
///              of a vertex of the mesh triangle. Where back faces have no colours of their own, vertices are fed with
///              the colours of light
///   window     by the same feedback; facing and culling by stages.h's rule, the sign of the snapped area, because
///              feedback mode culls by the unsnapped one. GL's own culling shows in the planes. inv_w is 1 / (1 / (1 /
///              w)): feedback gives w. Feedback mode applies no flat shading: the colours of flat draws are those of
///              each vertex, and not to be compared
///   coverage   planes.count and planes.id_sum: the scene without alpha, stencil and depth test, its fragments summed;
///              together with the window stage, records.covered of lines (line_records.h)
///   depth, merge        planes.depth, planes.color: the scene in the frame's own formats
///   texture    planes.texel: REPLACE into RGBA32F, over fragments of (0, 0, 0, 1)
///   attributes, shade   planes.shaded: the scene in RGBA32F, over the frame's depth format
///   visibility          planes.id: a colour per primitive
///   coverage, depth, texture, shade, visibility   of single pixels, where a request names them and does not ask for
///              the window stage: records of their fragments, one primitive drawn at a time (pixel_fragments.h)
/// and runs no stage alone. Throws RendererFailed, as capture() does; capture() throws Unsupported for scenes and
/// records that Mesa draws otherwise than specified, or cannot give. Renderers may not be made concurrently; several
/// may exist, each used by one thread at a time. make_osmesa() and make_egl() are defined only in builds with the
/// library; make_opengl() is make_osmesa(), or make_egl() in a build without OSMesa.
std::unique_ptr<Renderer> make_opengl(MesaDriver driver = MesaDriver::llvmpipe);
std::unique_ptr<Renderer> make_osmesa(MesaDriver driver = MesaDriver::llvmpipe);
std::unique_ptr<Renderer> make_egl(MesaDriver driver = MesaDriver::llvmpipe);

}  // namespace plumbline
