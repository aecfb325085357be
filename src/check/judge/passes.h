// Passes of antialiased scenes as the judges have them: the renderer's are src/scene/antialias.h.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace plumbline::check {

/// The scenes of one sample per pixel that an antialiased scene is drawn as, in order: one for each of OpenGL's four
/// samples; one `factor` times as wide and high, scissor boxes too; one for each tap of GzRender's filter. The scene
/// itself where it is not antialiased.
std::vector<Scene> pass_scenes(const Scene& scene);

}  // namespace plumbline::check
