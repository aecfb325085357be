// An OpenGL context without a window, as the rest of this folder sees it. osmesa_context.cpp or egl_context.cpp makes
// it.
#pragma once

#include <memory>
#include <string_view>

#include "reference/osmesa/gl/mesa_driver.h"

namespace plumbline::osmesa {

struct Gl;

/// A compatibility context. It may have no frame buffer of its own: all is drawn into frame buffer objects (target.h).
class Context {
 public:
  virtual ~Context() = default;
  /// Makes it the calling thread's current context. Throws RendererFailed.
  virtual void make_current() = 0;
  /// The context's own function of this name ("glClear"), or null.
  using Function = void (*)();
  virtual Function function(const char* name) const = 0;
};

/// Code that Mesa makes of shaders. The first two draw the same bits; `approximate`, which is Mesa's default and quick
/// to run, filters textures by weights of 8 bits and levels of detail of four pixels at a time.
enum class ShaderCode { quick_to_make, quick_to_run, approximate };

/// OSMesa's, if it is built in. Throws RendererFailed.
std::unique_ptr<Context> make_osmesa_context(MesaDriver driver, ShaderCode code = ShaderCode::quick_to_make);

/// EGL's, if it is built in. Throws RendererFailed.
std::unique_ptr<Context> make_egl_context(MesaDriver driver, ShaderCode code = ShaderCode::quick_to_make);

/// OSMesa's; in a build without it EGL's.
std::unique_ptr<Context> make_opengl_context(MesaDriver driver, ShaderCode code = ShaderCode::quick_to_make);

/// All of OpenGL's entry points that are used here. Throws RendererFailed, naming the one that lacks.
Gl load(const Context& context);

const char* name_of(MesaDriver driver);

/// To be called before the first context is made: Mesa reads its environment once per process, and two of Mesa's
/// libraries in one share the current context without knowing of each other. Throws RendererFailed if the process has
/// another library or driver already.
void claim_process(std::string_view library, MesaDriver driver, ShaderCode code = ShaderCode::quick_to_make);

}  // namespace plumbline::osmesa
