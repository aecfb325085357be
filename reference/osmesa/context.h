// Where an OpenGL context without a window comes from: today OSMesa, and nothing outside context.cpp knows. Mesa 25.1
// and later have no OSMesa; an EGL surfaceless context can stand in here.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reference/osmesa/osmesa.h"

struct osmesa_context;

namespace plumbline::osmesa {

struct Gl;

/// A compatibility context. Its default frame buffer is a few pixels and never drawn into.
class Context {
 public:
  /// Sets the process' environment as the driver needs it, makes the context and makes it current. Throws
  /// RendererFailed if there is none, if it is of another driver, or if the process has had one of another driver.
  explicit Context(OsmesaDriver driver);
  ~Context();

  /// Makes it the calling thread's current context.
  void make_current();

  const Gl& gl() const { return *gl_; }
  /// GL_RENDERER and GL_VERSION.
  std::string version() const;

 private:
  struct Destroy {
    void operator()(osmesa_context* context) const;
  };
  std::unique_ptr<osmesa_context, Destroy> context_;
  std::vector<unsigned char> default_frame_;
  std::unique_ptr<Gl> gl_;
};

}  // namespace plumbline::osmesa
