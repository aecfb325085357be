// A frame buffer object of four samples a pixel.
#pragma once

#include "reference/osmesa/gl/gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

class Multisamples {
 public:
  /// Has the frame's size, these formats, and samples at the positions of reference/arithmetic/passes.h. Throws
  /// Unsupported where OpenGL has fewer samples (softpipe) or other positions, RendererFailed where it refuses the
  /// formats.
  Multisamples(const Gl& gl, const FrameFormat& frame, GLenum color, GLenum depth);
  ~Multisamples();
  Multisamples(const Multisamples&) = delete;
  Multisamples& operator=(const Multisamples&) = delete;

  GLuint frame_buffer() const { return frame_buffer_; }

  /// Draws one sample's colours, unchanged, or its depths, as red, into the frame buffer `to`, in a PassState.
  void fetch_colors(int sample, GLuint to) const;
  void fetch_depths(int sample, GLuint to) const;
  /// Resolves colour and depth into the frame buffer `to`, by glBlitFramebuffer.
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
