// A frame buffer object of four samples a pixel.
#pragma once

#include "reference/osmesa/gl/gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

class Multisamples {
 public:
  /// Of these formats, with four samples at the places of scene/antialias.h. Throws Unsupported where OpenGL has none
  /// (softpipe), or has others.
  Multisamples(const Gl& gl, const FrameFormat& frame, GLenum color, GLenum depth);
  ~Multisamples();
  Multisamples(const Multisamples&) = delete;
  Multisamples& operator=(const Multisamples&) = delete;

  GLuint frame_buffer() const { return frame_buffer_; }

  /// One sample's colours, as they are, or its depths as red, become the colours of the frame buffer that is given. In
  /// GL's default state.
  void fetch_colors(int sample, GLuint to) const;
  void fetch_depths(int sample, GLuint to) const;
  /// Resolves into it, as glBlitFramebuffer does.
  void resolve(GLuint to) const;

 private:
  void fetch(GLuint texture, int sample, GLuint to) const;
  void release();

  const Gl& gl_;
  int width_, height_;
  GLuint frame_buffer_ = 0, program_ = 0;
  GLuint textures_[2] = {0, 0};  // colour, depth
};

}  // namespace plumbline::osmesa
