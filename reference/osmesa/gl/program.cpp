#include "reference/osmesa/gl/program.h"

#include <array>

#include "capture/renderer.h"

namespace plumbline::osmesa {
namespace {

void attach(const Gl& gl, GLuint program, GLenum type, const std::string& source) {
  if (source.empty()) return;
  const GLuint shader = gl.CreateShader(type);
  const GLchar* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  gl.AttachShader(program, shader);
  gl.DeleteShader(shader);
}

}  // namespace

Program::Program(const Gl& gl, const std::string& vertex, const std::string& fragment,
                 std::span<const GLchar* const> captured)
    : gl_(&gl), name_(gl.CreateProgram()) {
  attach(gl, name_, GL_VERTEX_SHADER, vertex);
  attach(gl, name_, GL_FRAGMENT_SHADER, fragment);
  if (!captured.empty()) {
    gl.TransformFeedbackVaryings(name_, static_cast<GLsizei>(captured.size()), captured.data(), GL_INTERLEAVED_ATTRIBS);
  }
  gl.LinkProgram(name_);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(name_, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    std::array<char, 1024> log{};
    gl.GetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl.DeleteProgram(name_);
    throw RendererFailed(std::string("OpenGL: a program does not link: ") + log.data());
  }
  check(gl, "making a program");
}

}  // namespace plumbline::osmesa
