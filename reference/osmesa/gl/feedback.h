// GL's feedback mode, in which vertices are returned and not drawn.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/osmesa/gl/gl.h"

namespace plumbline::osmesa {

class Feedback {
 public:
  /// `type`: the values per vertex, such as GL_3D_COLOR.
  Feedback(const Gl& gl, GLenum type) : gl_(gl), type_(type) {}

  /// Runs `draw` and returns the feedback, valid until the next run. `expected`: number of values for which memory is
  /// reserved; if there are more, `draw` runs again with more memory. Throws RendererFailed.
  std::span<const float> run(std::size_t expected, const std::function<void()>& draw);

 private:
  const Gl& gl_;
  GLenum type_;
  std::vector<float> values_;
};

}  // namespace plumbline::osmesa
