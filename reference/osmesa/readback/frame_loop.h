// One scene drawn by OSMesa's llvmpipe again and again, for timing: what is made once is made before.
#pragma once

#include <memory>

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline {

class OsmesaFrames {
 public:
  /// A scene without antialiasing, or of OpenGL's own samples. Keeps a reference to it. Throws RendererFailed. One at a
  /// time.
  explicit OsmesaFrames(const Scene& scene);
  ~OsmesaFrames();

  /// Clear, draws, and wait until all is in the frame buffer.
  void draw();
  /// What was drawn last: colour and depth.
  Planes read() const;

 private:
  struct Frames;
  std::unique_ptr<Frames> frames_;
};

}  // namespace plumbline
