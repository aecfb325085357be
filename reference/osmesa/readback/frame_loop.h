// Repeated drawing of one scene by Mesa's llvmpipe (OSMesa, in a build without it EGL), for timing.
#pragma once

#include <cstdint>
#include <memory>

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline {

/// A scene in GL; buffers, textures and programs are made by the constructor.
class OsmesaFrames {
 public:
  /// Texture filters of llvmpipe: as exact as it can, or its default (GALLIVM_PERF). A process can use one of the two.
  enum class Filters { exact, approximate };
  /// `scene`: not antialiased, or multisampled; not rgba12. Keeps a reference to the scene. Throws RendererFailed and
  /// Unsupported. Not to be called concurrently.
  explicit OsmesaFrames(const Scene& scene, Filters filters = Filters::exact);
  ~OsmesaFrames();

  /// Clears and draws the frame, and waits until it is complete.
  void draw();
  /// Colour and depth of the last frame.
  Planes read() const;
  /// Colour codes of the last frame (rgba8 only) into a plane of the frame's size.
  void read_codes(Plane<std::uint32_t>& to) const;

 private:
  struct Frames;
  std::unique_ptr<Frames> frames_;
};

}  // namespace plumbline
