// One scene drawn by OSMesa's llvmpipe again and again, for timing: what is made once is made before.
#pragma once

#include <cstdint>
#include <memory>

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline {

class OsmesaFrames {
 public:
  /// How llvmpipe filters textures: as exactly as it can, or as it does by default (GALLIVM_PERF). One for a process.
  enum class Filters { exact, approximate };
  /// A scene without antialiasing, or of OpenGL's own samples. Keeps a reference to it. Throws RendererFailed. One at a
  /// time.
  explicit OsmesaFrames(const Scene& scene, Filters filters = Filters::exact);
  ~OsmesaFrames();

  /// Clear, draws, and wait until all is in the frame buffer.
  void draw();
  /// What was drawn last: colour and depth.
  Planes read() const;
  /// Its colour codes into a plane of the frame's size. For rgba8.
  void read_codes(Plane<std::uint32_t>& to) const;

 private:
  struct Frames;
  std::unique_ptr<Frames> frames_;
};

}  // namespace plumbline
