#include "reference/osmesa/gl/matrix_stack.h"

#include <glm/gtc/type_ptr.hpp>

#include "reference/osmesa/gl/context.h"
#include "reference/osmesa/gl/gl.h"

namespace plumbline::osmesa {
namespace {

struct Call {
  const Gl& gl;
  void operator()(const Translate& t) const { gl.Translated(t.by.x, t.by.y, t.by.z); }
  void operator()(const Rotate& r) const { gl.Rotated(r.degrees, r.axis.x, r.axis.y, r.axis.z); }
  void operator()(const Scale& s) const { gl.Scaled(s.by.x, s.by.y, s.by.z); }
  void operator()(const Frustum& f) const { gl.Frustum(f.left, f.right, f.bottom, f.top, f.near, f.far); }
  void operator()(const Orthographic& o) const { gl.Ortho(o.left, o.right, o.bottom, o.top, o.near, o.far); }
};

}  // namespace

MatrixStack::MatrixStack(std::unique_ptr<Context> context) : context_(std::move(context)) {
  context_->make_current();
  gl_ = std::make_unique<Gl>(load(*context_));
}

MatrixStack::~MatrixStack() = default;

glm::dmat4 MatrixStack::product(std::span<const MatrixCall> calls) const {
  context_->make_current();
  gl_->MatrixMode(GL_MODELVIEW);
  gl_->LoadIdentity();
  for (const MatrixCall& call : calls) std::visit(Call{*gl_}, call);
  glm::mat4 matrix;
  gl_->GetFloatv(GL_MODELVIEW_MATRIX, glm::value_ptr(matrix));
  check(*gl_, "matrix functions");
  return glm::dmat4(matrix);
}

}  // namespace plumbline::osmesa
