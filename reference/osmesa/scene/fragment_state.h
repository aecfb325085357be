// GL state of a draw's fragments: alpha test, stencil test, polygon offset, logic op.
#pragma once

#include "reference/osmesa/gl/gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

GLenum gl_compare(CompareFunc func);

/// Alpha and stencil test, and polygon offset. Call within a PassState.
void set_fragment_tests(const Gl& gl, const Draw& draw);
/// No alpha, stencil or depth test: every fragment counts.
void disable_tests(const Gl& gl);
void set_logic_op(const Gl& gl, const std::optional<LogicOp>& op);

/// Turns every fragment's rgb to the bytes of a number, from red up, and leaves its alpha as textures have made it.
/// Call within a PassState; lasts as long as that. A texture environment, on the unit after the scene's: it acts
/// before the alpha test, and a constant is interpolated by nobody.
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
