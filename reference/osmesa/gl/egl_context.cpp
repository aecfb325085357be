// Contexts of EGL on Mesa's surfaceless platform, for a Mesa without OSMesa (25.1 and later). They have no frame
// buffer.
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "capture/renderer.h"
#include "reference/osmesa/gl/context.h"
#include "reference/osmesa/gl/gl.h"

#define EGL_NO_PLATFORM_SPECIFIC_TYPES  // no X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace plumbline {
namespace osmesa {
namespace {

[[noreturn]] void fail(const char* what) {
  throw RendererFailed(fmt::format("EGL: {} (error {:#06x})", what, eglGetError()));
}

void require_extension(EGLDisplay display, std::string_view name) {
  const char* all = eglQueryString(display, EGL_EXTENSIONS);
  if (all == nullptr || fmt::format(" {} ", all).find(fmt::format(" {} ", name)) == std::string::npos) {
    throw RendererFailed(fmt::format("EGL: this library has no {}", name));
  }
}

// The process' one surfaceless display. It is never terminated: that would end all contexts and unload the driver,
// which keeps some memory (Mesa 22.3) that leak checkers could then not attribute.
EGLDisplay surfaceless_display() {
  static const EGLDisplay display = [] {
    const EGLDisplay found = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (found == EGL_NO_DISPLAY) fail("no surfaceless display");
    if (!eglInitialize(found, nullptr, nullptr)) fail("the surfaceless display cannot be initialized");
    require_extension(found, "EGL_KHR_no_config_context");
    require_extension(found, "EGL_KHR_surfaceless_context");
    return found;
  }();
  return display;
}

class EglContext final : public Context {
 public:
  EglContext(MesaDriver driver, ShaderCode code) {
    claim_process("EGL", driver, code);
    display_ = surfaceless_display();
    if (!eglBindAPI(EGL_OPENGL_API)) fail("no OpenGL");
    const EGLint any_version[] = {EGL_NONE};  // gives a compatibility context
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, any_version);
    if (context_ == EGL_NO_CONTEXT) fail("no context");
  }
  ~EglContext() override {
    if (eglGetCurrentContext() == context_) {
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display_, context_);
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void make_current() override {
    if (!eglBindAPI(EGL_OPENGL_API) ||  // per-thread state
        !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      fail("the context cannot be made current");
    }
  }

  Function function(const char* name) const override { return eglGetProcAddress(name); }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> make_egl_context(MesaDriver driver, ShaderCode code) {
  return std::make_unique<EglContext>(driver, code);
}

}  // namespace osmesa
}  // namespace plumbline
