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
/// `sample`: the picture is shifted by as much the other way (Pass::shift). `provoking_vertex` first: the corners of
/// each triangle are rotated, so that this vertex is the last. `depth_planes` clamped: GL_DEPTH_CLAMP. `depth_format`:
/// the frame's. The oracles handle a view volume of [0,w] in z (reference/arithmetic/project.cpp).
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

/// The depth buffer's format.
DepthFormat depth_format_of(const FrameFormat& frame, const Conventions& conventions);

/// Turns the rows of planes and fragments over where they are counted from the top, and maps depths to [0,1], the near
/// plane's being 0. Window positions are moved as far as `sample` is from the pixel's centre. Colours stay: their codes
/// are judged as they are rounded.
void to_dialect(const Conventions& conventions, Capture& capture);

}  // namespace plumbline
