// Declared conventions, applied: the scene that OpenGL's rules would have to be given so that they draw what the
// renderer draws, and the renderer's capture as OpenGL would have left it.
#pragma once

#include <optional>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "scene/scene.h"

namespace plumbline {

/// A scene drawn by other conventions than its own. Holds a copy where they alter it; else it refers to `scene`.
///
/// A sample off the pixel's centre is a picture that is moved the other way (Pass::shift). A first vertex that provokes
/// is each triangle's last, once its corners are turned. Depths that are not cut are clamped (GL_DEPTH_CLAMP). A view
/// volume of [0,w] in z is the oracles' matter (reference/arithmetic/project.cpp).
class SceneByConventions {
 public:
  SceneByConventions(const Scene& scene, const Conventions& conventions);
  SceneByConventions(const SceneByConventions&) = delete;
  SceneByConventions& operator=(const SceneByConventions&) = delete;
  const Scene& operator*() const { return altered_ ? *altered_ : scene_; }
  const Scene* operator->() const { return &**this; }

 private:
  const Scene& scene_;
  std::optional<Scene> altered_;
};

/// Turns the rows of planes and fragments over where they are counted from the top, and maps depths to [0,1], the near
/// plane's being 0. Colours stay: their codes are judged as they are rounded.
void to_dialect(const Conventions& conventions, Capture& capture);

}  // namespace plumbline
