// The planes, drawn and read back.
#pragma once

#include "capture/capture.h"
#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// Throws RendererFailed, also where more than 4096 fragments lie on one pixel: their weights' sum is not exact then.
Planes draw_planes(const Gl& gl, const SceneInGl& scene);
/// The frame's colour and depth alone.
Planes draw_picture(const Gl& gl, const SceneInGl& scene);

}  // namespace plumbline::osmesa
