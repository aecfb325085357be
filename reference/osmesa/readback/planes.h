// Planes of a capture, drawn by GL and read back.
#pragma once

#include "capture/capture.h"
#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// All planes (texel only if the scene has textures and no alpha tests). Throws Unsupported where a pixel has more than
/// 4096 fragments, as the sum of their weights is then not exact, and where OpenGL lacks the samples; RendererFailed.
Planes draw_planes(const Gl& gl, const SceneInGl& scene);
/// The frame's colour and depth only. Throws as draw_planes().
Planes draw_picture(const Gl& gl, const SceneInGl& scene);

}  // namespace plumbline::osmesa
