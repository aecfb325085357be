// OpenGL's matrix functions, as a reference for matrices that are built elsewhere.
#pragma once

#include <memory>
#include <span>
#include <variant>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline::osmesa {

class Context;
struct Gl;

/// glTranslated, glRotated, glScaled, glFrustum, glOrtho, with their arguments.
using MatrixCall = std::variant<Translate, Rotate, Scale, Frustum, Orthographic>;

class MatrixStack {
 public:
  /// Throws RendererFailed. Not for use by two threads at once.
  explicit MatrixStack(std::unique_ptr<Context> context);
  ~MatrixStack();

  /// The product of the calls' matrices, each multiplied from the right, read back. Mesa rounds the arguments to float
  /// and computes in float. Throws RendererFailed where GL refuses an argument.
  glm::dmat4 product(std::span<const MatrixCall> calls) const;

 private:
  std::unique_ptr<Context> context_;
  std::unique_ptr<Gl> gl_;
};

}  // namespace plumbline::osmesa
