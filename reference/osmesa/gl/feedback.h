// GL's feedback mode: vertices come back instead of being drawn.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/osmesa/gl/gl.h"

namespace plumbline::osmesa {

class Feedback {
 public:
  /// `type`: what is handed out per vertex, such as GL_3D_COLOR.
  Feedback(const Gl& gl, GLenum type) : gl_(gl), type_(type) {}

  /// Runs `draw` and returns what comes back, valid until the next run. `expected` values are made room for; where
  /// more come, `draw` runs again with more room.
  std::span<const float> run(std::size_t expected, const std::function<void()>& draw);

 private:
  const Gl& gl_;
  GLenum type_;
  std::vector<float> values_;
};

}  // namespace plumbline::osmesa
