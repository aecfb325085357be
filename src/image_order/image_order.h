// Hidden surfaces in image order (note 004, section 2.4: "ray tracing / ray casting: traverse pixel, process each in
// world-space; transform rays from image-space to world-space"), beside the pipeline's object order and its z-buffer.
#pragma once

#include <memory>

#include "capture/renderer.h"

namespace plumbline::image_order {

/// Renderer "image_order". One ray per pixel, in double; the depth tests of the triangles that it crosses, in draw
/// order, choose the winner. Hands out planes.id, planes.depth and, as cleared, planes.stencil. Uses no view or
/// projection matrix, clipping, snapping or z-buffer: a crossing counts where its distance along the view is in [near,
/// far], under depth clamp, too. Depths are rounded to the frame's format before they are compared. capture() throws
/// OverBudget, and Unsupported for lines, points, alpha tests, stencil tests, polygon offset and antialiased frames.
std::unique_ptr<Renderer> make_image_order();

}  // namespace plumbline::image_order
