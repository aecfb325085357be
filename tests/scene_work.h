// Estimated work of a scene.
#pragma once

#include <cstddef>

#include "scene/antialias.h"
#include "scene/scene.h"

namespace plumbline::test {

/// Estimated cost of drawing and judging a scene [pixels]: of each pass, the frame per draw and 50 per triangle.
inline std::size_t work_of(const Scene& scene) {
  std::size_t out = 0;
  for (const Scene& pass : passes_of(scene)) {
    const std::size_t pixels = static_cast<std::size_t>(pass.frame.width) * static_cast<std::size_t>(pass.frame.height);
    for (const Draw& draw : pass.draws) out += pixels + 50 * pass.meshes[draw.mesh].triangles.size();
  }
  return out;
}

}  // namespace plumbline::test
