#include "reference/osmesa/gl/gl.h"

#include <fmt/format.h>

#include "capture/renderer.h"

namespace plumbline::osmesa {
namespace {

std::string name_of_error(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_STACK_OVERFLOW: return "GL_STACK_OVERFLOW";
    case GL_STACK_UNDERFLOW: return "GL_STACK_UNDERFLOW";
    case GL_OUT_OF_MEMORY: return "GL_OUT_OF_MEMORY";
    default: return fmt::format("GL error {:#06x}", error);
  }
}

}  // namespace

void check(const Gl& gl, std::string_view where) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return;
  // GL keeps one flag per kind of error; none must be left for the next capture.
  for (int flags = 0; flags < 8 && gl.GetError() != GL_NO_ERROR;) ++flags;
  throw RendererFailed(fmt::format("OpenGL: {} in {}", name_of_error(error), where));
}

GLint limit(const Gl& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

}  // namespace plumbline::osmesa
