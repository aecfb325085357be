// A frame buffer object to draw into and read from.
#pragma once

#include <cstdint>

#include <memory>

#include "capture/plane.h"
#include "reference/osmesa/gl/gl.h"
#include "reference/osmesa/scene/multisamples.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

class Target {
 public:
  /// Has the frame's size and depth format, but z24 for z8 (which OpenGL lacks) and for z16 with stencil values.
  /// `color`: rgba8, rgba16 or rgba32f. Throws RendererFailed, naming OpenGL's limit, where OpenGL cannot give that.
  /// A pass of one sample (Pass::sample) draws all four samples, and that one is read. The samples of a multisampled
  /// frame are resolved before they are read.
  Target(const Gl& gl, const FrameFormat& frame, ColorFormat color);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  /// Draws go here from now on, through a viewport of its whole size.
  void bind() const;

  /// One byte per channel: r in the low byte. For rgba8.
  Plane<std::uint32_t> read_codes() const;
  /// The same of `size` pixels from pixel `origin` on.
  Plane<std::uint32_t> read_codes(glm::ivec2 origin, glm::ivec2 size) const;
  /// Codes from pixel `origin` on into `to`, as many columns and rows as it has.
  void read_codes(glm::ivec2 origin, Plane<std::uint32_t>& to) const;
  /// Codes as code / 255, code / 65535.
  Plane<glm::vec4> read_color() const;
  Plane<glm::vec4> read_color(glm::ivec2 origin, glm::ivec2 size) const;
  /// Window z: n-bit codes as code / (2^n - 1).
  Plane<double> read_depth() const;
  Plane<std::uint8_t> read_stencil() const;  ///< empty where the frame has none

 private:
  void release();
  void take_samples() const;  // before anything but a sample's depth is read
  Plane<double> read_sample_depth() const;

  const Gl& gl_;
  FrameFormat frame_;
  ColorFormat color_;
  GLuint frame_buffer_ = 0;
  GLuint buffers_[2] = {0, 0};  // colour, depth
  std::unique_ptr<Multisamples> samples_;
};

}  // namespace plumbline::osmesa
