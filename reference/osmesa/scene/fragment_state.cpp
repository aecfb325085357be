#include "reference/osmesa/scene/fragment_state.h"

#include <initializer_list>

namespace plumbline::osmesa {
namespace {

GLenum gl_stencil_op(StencilOp op) {
  switch (op) {
    case StencilOp::keep: return GL_KEEP;
    case StencilOp::zero: return GL_ZERO;
    case StencilOp::replace: return GL_REPLACE;
    case StencilOp::increment: return GL_INCR;
    case StencilOp::increment_wrap: return GL_INCR_WRAP;
    case StencilOp::decrement: return GL_DECR;
    case StencilOp::decrement_wrap: return GL_DECR_WRAP;
    case StencilOp::invert: return GL_INVERT;
  }
  return GL_KEEP;
}

void set_face(const Gl& gl, GLenum side, const StencilFace& face) {
  gl.StencilFuncSeparate(side, gl_compare(face.func), face.reference, face.mask);
  gl.StencilOpSeparate(side, gl_stencil_op(face.fail), gl_stencil_op(face.depth_fail), gl_stencil_op(face.pass));
  gl.StencilMaskSeparate(side, face.write_mask);
}

}  // namespace

GLenum gl_compare(CompareFunc func) {
  switch (func) {
    case CompareFunc::never: return GL_NEVER;
    case CompareFunc::less: return GL_LESS;
    case CompareFunc::equal: return GL_EQUAL;
    case CompareFunc::less_equal: return GL_LEQUAL;
    case CompareFunc::greater: return GL_GREATER;
    case CompareFunc::not_equal: return GL_NOTEQUAL;
    case CompareFunc::greater_equal: return GL_GEQUAL;
    case CompareFunc::always: return GL_ALWAYS;
  }
  return GL_LESS;
}

void set_fragment_tests(const Gl& gl, const Draw& draw) {
  gl.Disable(GL_ALPHA_TEST);
  if (draw.alpha_test) {
    gl.Enable(GL_ALPHA_TEST);
    gl.AlphaFunc(gl_compare(draw.alpha_test->func), draw.alpha_test->reference);
  }
  gl.Disable(GL_STENCIL_TEST);
  if (draw.stencil) {
    gl.Enable(GL_STENCIL_TEST);
    set_face(gl, GL_FRONT, draw.stencil->front);
    set_face(gl, GL_BACK, draw.stencil->back);
  }
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  if (draw.polygon_offset != PolygonOffset{}) {
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(draw.polygon_offset.factor, draw.polygon_offset.units);
  }
}

void disable_tests(const Gl& gl) {
  for (const GLenum test : std::initializer_list<GLenum>{GL_ALPHA_TEST, GL_STENCIL_TEST, GL_DEPTH_TEST})
    gl.Disable(test);
}

void set_logic_op(const Gl& gl, const std::optional<LogicOp>& op) {
  if (!op) return gl.Disable(GL_COLOR_LOGIC_OP);
  gl.Enable(GL_COLOR_LOGIC_OP);
  gl.LogicOp(GL_CLEAR + static_cast<GLenum>(*op));  // both in the order of table 4.2
}

NumberedFragments::NumberedFragments(const Gl& gl) : gl_(gl) {
  const GLubyte white[4] = {255, 255, 255, 255};
  gl.GenTextures(1, &texture_);
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, white);
  const std::pair<GLenum, GLint> environment[] = {{GL_TEXTURE_ENV_MODE, GL_COMBINE}, {GL_COMBINE_RGB, GL_REPLACE},
                                                  {GL_SOURCE0_RGB, GL_CONSTANT},     {GL_OPERAND0_RGB, GL_SRC_COLOR},
                                                  {GL_COMBINE_ALPHA, GL_REPLACE},    {GL_SOURCE0_ALPHA, GL_PREVIOUS},
                                                  {GL_OPERAND0_ALPHA, GL_SRC_ALPHA}};
  for (const auto& [name, value] : environment) gl.TexEnvi(GL_TEXTURE_ENV, name, value);
  gl.ActiveTexture(GL_TEXTURE0);
  check(gl, "making a texture environment of primitives' numbers");
}

NumberedFragments::~NumberedFragments() { gl_.DeleteTextures(1, &texture_); }

void NumberedFragments::set(std::uint32_t number) const {
  const auto part = [&](int shift) { return static_cast<float>(number >> shift & 0xffu) / 255.0f; };
  const float color[4] = {part(0), part(8), part(16), 0};
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.TexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, color);
  gl_.ActiveTexture(GL_TEXTURE0);
}

void NumberedFragments::enable() const {
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.Enable(GL_TEXTURE_2D);
  gl_.ActiveTexture(GL_TEXTURE0);
}

}  // namespace plumbline::osmesa
