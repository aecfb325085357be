// Ownership of a GL buffer object.
#pragma once

#include <span>
#include <utility>

#include "reference/osmesa/gl/gl.h"

namespace plumbline::osmesa {

class Buffer {
 public:
  template <class T>
  Buffer(const Gl& gl, std::span<const T> values) : Buffer(gl, values.size_bytes(), values.data()) {}
  /// `data`: `bytes` bytes, or null: contents undefined. The context must be current, also when the buffer is
  /// destroyed.
  Buffer(const Gl& gl, std::size_t bytes, const void* data) : gl_(&gl) {
    gl_->GenBuffers(1, &name_);
    gl_->BindBuffer(GL_ARRAY_BUFFER, name_);
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
    gl_->BindBuffer(GL_ARRAY_BUFFER, 0);
  }
  ~Buffer() {
    if (name_ != 0) gl_->DeleteBuffers(1, &name_);
  }
  Buffer(Buffer&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  Buffer& operator=(Buffer&&) = delete;

  GLuint name() const { return name_; }

 private:
  const Gl* gl_;
  GLuint name_ = 0;
};

}  // namespace plumbline::osmesa
