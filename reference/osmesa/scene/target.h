// A frame buffer object to draw to and read from.
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
  /// `color`: rgba8, rgba16 or rgba32f. A pass of one sample (Pass::sample) draws all four samples, and Pass::sample
  /// alone is read. The samples of a multisampled frame are resolved before they are read. Throws RendererFailed,
  /// naming OpenGL's limit, where OpenGL cannot give size or format, and Unsupported where it lacks the samples
  /// (Multisamples).
  Target(const Gl& gl, const FrameFormat& frame, ColorFormat color);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  /// Makes this the frame buffer of further draws, with a viewport of its whole size.
  void bind() const;

  // The functions that read bind another frame buffer: call bind() before the next draw.
  /// Colour codes of an rgba8 target, one byte per channel, r in the low byte.
  Plane<std::uint32_t> read_codes() const;
  /// The codes of `size` pixels from pixel `origin` on.
  Plane<std::uint32_t> read_codes(glm::ivec2 origin, glm::ivec2 size) const;
  /// The codes of as many pixels as `to` has, from pixel `origin` on.
  void read_codes(glm::ivec2 origin, Plane<std::uint32_t>& to) const;
  /// Colours; codes as code / 255 or code / 65535.
  Plane<glm::vec4> read_color() const;
  Plane<glm::vec4> read_color(glm::ivec2 origin, glm::ivec2 size) const;
  /// Window z; n-bit codes of the target's format, which may not be the frame's, as code / (2^n - 1).
  Plane<double> read_depth() const;
  Plane<std::uint8_t> read_stencil() const;  ///< empty where the frame has none

 private:
  void release();
  void take_samples() const;  // fetches or resolves samples into frame_buffer_, for all reads but a sample's depth
  Plane<double> read_sample_depth() const;

  const Gl& gl_;
  FrameFormat frame_;
  ColorFormat color_;
  GLuint frame_buffer_ = 0;
  GLuint buffers_[2] = {0, 0};  // colour, depth
  std::unique_ptr<Multisamples> samples_;
};

}  // namespace plumbline::osmesa
