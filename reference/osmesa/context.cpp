#include "reference/osmesa/context.h"

#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "reference/osmesa/gl.h"
#include "stages/renderer.h"

// After gl.h, which asks <GL/gl.h> for all prototypes.
#include <GL/osmesa.h>

namespace plumbline::osmesa {
namespace {

constexpr int kDefaultFrame = 4;  // pixels in width and height

const char* driver_name(OsmesaDriver driver) { return driver == OsmesaDriver::llvmpipe ? "llvmpipe" : "softpipe"; }

// Mesa reads its environment once per process, when the first context is made.
void set_environment(OsmesaDriver driver) {
  static const OsmesaDriver chosen = [driver] {
    setenv("GALLIUM_DRIVER", driver_name(driver), 1);
    setenv("GALLIVM_PERF", "no_aos_sampling", 1);                           // else bilinear weights have 8 bits
    if (driver == OsmesaDriver::softpipe) setenv("DRAW_USE_LLVM", "0", 1);  // else feedback with lighting is wrong
    unsetenv("LP_NATIVE_VECTOR_WIDTH");
    unsetenv("GALLIUM_OVERRIDE_CPU_CAPS");
    return driver;
  }();
  if (chosen != driver) {
    throw RendererFailed(fmt::format("OSMesa: this process already uses {}; {} needs a process of its own",
                                     driver_name(chosen), driver_name(driver)));
  }
}

Gl load() {
  Gl gl;
#define PLUMBLINE_GL_LOAD(name)                                                    \
  gl.name = reinterpret_cast<decltype(gl.name)>(OSMesaGetProcAddress("gl" #name)); \
  if (gl.name == nullptr) throw RendererFailed("OSMesa: this library has no gl" #name);
  PLUMBLINE_GL_FUNCTIONS(PLUMBLINE_GL_LOAD)
#undef PLUMBLINE_GL_LOAD
  return gl;
}

std::string text(const Gl& gl, GLenum name) {
  const GLubyte* value = gl.GetString(name);
  return value == nullptr ? "" : reinterpret_cast<const char*>(value);
}

}  // namespace

void Context::Destroy::operator()(osmesa_context* context) const { OSMesaDestroyContext(context); }

Context::Context(OsmesaDriver driver) : default_frame_(4 * kDefaultFrame * kDefaultFrame) {
  set_environment(driver);
  context_.reset(OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr));
  if (!context_) throw RendererFailed(fmt::format("OSMesa: no context from {}", driver_name(driver)));
  make_current();
  gl_ = std::make_unique<Gl>(load());
  if (!text(*gl_, GL_RENDERER).starts_with(driver_name(driver))) {
    throw RendererFailed(
        fmt::format("OSMesa: asked for {}, got the driver \"{}\"", driver_name(driver), text(*gl_, GL_RENDERER)));
  }
}

Context::~Context() = default;

void Context::make_current() {
  if (!OSMesaMakeCurrent(context_.get(), default_frame_.data(), GL_UNSIGNED_BYTE, kDefaultFrame, kDefaultFrame)) {
    throw RendererFailed("OSMesa: the context cannot be made current");
  }
}

std::string Context::version() const { return text(*gl_, GL_RENDERER) + ", OpenGL " + text(*gl_, GL_VERSION); }

}  // namespace plumbline::osmesa
