// GL state of a draw's fragments: alpha test, stencil test, polygon offset, logic op.
#pragma once

#include "reference/osmesa/gl/gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

GLenum gl_compare(CompareFunc func);

/// Sets a draw's alpha test, stencil test and polygon offset. Call within a PassState.
void set_fragment_tests(const Gl& gl, const Draw& draw);
/// Disables alpha, stencil and depth test, so that every fragment counts.
void disable_tests(const Gl& gl);
void set_logic_op(const Gl& gl, const std::optional<LogicOp>& op);

/// Texture environment, on the unit after the scene's, that replaces every fragment's rgb by the bytes of a number, red
/// the lowest, and keeps the alpha that the scene's texture has made. The environment acts before the alpha test, and
/// its constant colour is not interpolated. Use within one PassState.
class NumberedFragments {
 public:
  explicit NumberedFragments(const Gl& gl);
  ~NumberedFragments();
  NumberedFragments(const NumberedFragments&) = delete;
  NumberedFragments& operator=(const NumberedFragments&) = delete;
  void enable() const;
  void set(std::uint32_t number) const;  ///< below 2^24

 private:
  const Gl& gl_;
  GLuint texture_ = 0;
};

}  // namespace plumbline::osmesa
