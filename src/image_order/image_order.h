// Hidden surfaces in image order (note 004, section 2.4: "ray tracing / ray casting: traverse pixel, process each in
// world-space; transform rays from image-space to world-space"), beside the pipeline's object order and its z-buffer.
#pragma once

#include <memory>

#include "capture/renderer.h"

namespace plumbline::image_order {

/// A renderer named "image_order": per pixel one ray, in double, and of the triangles that it crosses the one that is
/// left by their depth functions, in draw order: the nearest, for less and less_equal. Hands out planes.id and
/// planes.depth. No matrix of view or projection, no clipping, no snapping and no z-buffer: between near and far is
/// what lies there along the ray. Depths are in the frame's format before they are compared. Throws OverBudget;
/// Unsupported where a scene has lines or points, which no ray meets.
std::unique_ptr<Renderer> make_image_order();

}  // namespace plumbline::image_order
