// Ownership of a GLSL program.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "reference/osmesa/gl/gl.h"

namespace plumbline::osmesa {

class Program {
 public:
  /// Compiles and links. An empty `vertex` or `fragment` leaves that stage to the fixed function. `captured`: the
  /// varyings that transform feedback writes, interleaved. Throws RendererFailed, with GL's log, where the program does
  /// not link.
  Program(const Gl& gl, const std::string& vertex, const std::string& fragment,
          std::span<const GLchar* const> captured = {});
  ~Program() {
    if (name_ != 0) gl_->DeleteProgram(name_);
  }
  Program(Program&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  Program& operator=(Program&&) = delete;

  GLuint name() const { return name_; }

 private:
  const Gl* gl_;
  GLuint name_;
};

}  // namespace plumbline::osmesa
