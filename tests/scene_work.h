// Scenes in the order of what they take.
#pragma once

#include <cstddef>

#include "scene/antialias.h"
#include "scene/scene.h"

namespace plumbline::test {

/// About what it takes to draw a scene and to judge it [pixels]: the frame for each draw, and 50 for each triangle.
inline std::size_t work_of(const Scene& scene) {
  std::size_t out = 0;
  for (const Scene& pass : passes_of(scene)) {
    const std::size_t pixels = static_cast<std::size_t>(pass.frame.width) * static_cast<std::size_t>(pass.frame.height);
    for (const Draw& draw : pass.draws) out += pixels + 50 * pass.meshes[draw.mesh].triangles.size();
  }
  return out;
}

}  // namespace plumbline::test
