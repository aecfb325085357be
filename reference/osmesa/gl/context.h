// Interface of an OpenGL context without a window, which osmesa_context.cpp or egl_context.cpp makes.
#pragma once

#include <memory>
#include <string_view>

#include "reference/osmesa/gl/mesa_driver.h"

namespace plumbline::osmesa {

struct Gl;

/// A compatibility context. It may have no frame buffer of its own: drawing is to frame buffer objects (target.h).
class Context {
 public:
  virtual ~Context() = default;
  /// Makes this context current in the calling thread. Throws RendererFailed.
  virtual void make_current() = 0;
  /// The context's own function of this name ("glClear"), or null.
  using Function = void (*)();
  virtual Function function(const char* name) const = 0;
};

/// Kind of code that Mesa compiles shaders to. The first two draw the same bits; `approximate`, Mesa's default, is fast
/// to run, but filters textures with weights of 8 bits and one LOD for four pixels.
enum class ShaderCode { quick_to_make, quick_to_run, approximate };

/// A context of OSMesa; defined in builds with OSMesa. Throws RendererFailed.
std::unique_ptr<Context> make_osmesa_context(MesaDriver driver, ShaderCode code = ShaderCode::quick_to_make);

/// A context of EGL; defined in builds with EGL. Throws RendererFailed.
std::unique_ptr<Context> make_egl_context(MesaDriver driver, ShaderCode code = ShaderCode::quick_to_make);

/// make_osmesa_context(), or make_egl_context() in a build without OSMesa.
std::unique_ptr<Context> make_opengl_context(MesaDriver driver, ShaderCode code = ShaderCode::quick_to_make);

/// Loads the entry points of gl.h from the context. Throws RendererFailed, naming one that is missing.
Gl load(const Context& context);

const char* name_of(MesaDriver driver);

/// Sets Mesa's environment variables for this process, before the first context is made. Mesa reads them once, and two
/// of Mesa's libraries in one process would share the current context without knowing of each other: throws
/// RendererFailed if the process has claimed another library, driver or shader code.
void claim_process(std::string_view library, MesaDriver driver, ShaderCode code = ShaderCode::quick_to_make);

}  // namespace plumbline::osmesa
