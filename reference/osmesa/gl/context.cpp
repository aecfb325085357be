#include "reference/osmesa/gl/context.h"

#include <cstdlib>
#include <string>

#include <fmt/format.h>

#include "capture/renderer.h"
#include "reference/osmesa/gl/gl.h"

namespace plumbline {

std::string why_unfused(MesaDriver driver) {
  constexpr const char* kSaid = "its window positions are rounded otherwise: {} no fused multiply-add";
  if (driver == MesaDriver::softpipe) return fmt::format(kSaid, "it has");
#ifdef __x86_64__
  if (__builtin_cpu_supports("fma") == 0) return fmt::format(kSaid, "this processor has");
#endif
  return "";
}

namespace osmesa {

Gl load(const Context& context) {
  Gl gl;
#define PLUMBLINE_GL_LOAD(name)                                                \
  gl.name = reinterpret_cast<decltype(gl.name)>(context.function("gl" #name)); \
  if (gl.name == nullptr) throw RendererFailed("OpenGL: this library has no gl" #name);
  PLUMBLINE_GL_FUNCTIONS(PLUMBLINE_GL_LOAD)
#undef PLUMBLINE_GL_LOAD
  return gl;
}

const char* name_of(MesaDriver driver) { return driver == MesaDriver::llvmpipe ? "llvmpipe" : "softpipe"; }

void claim_process(std::string_view library, MesaDriver driver, ShaderCode code) {
  constexpr std::string_view kCodes[] = {"", ", optimised", ", approximate"};
  const std::string wanted =
      fmt::format("{} with {}{}", library, name_of(driver), kCodes[static_cast<std::size_t>(code)]);
  static const std::string claimed = [&] {
    setenv("GALLIUM_DRIVER", name_of(driver), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // EGL would look for a graphics card
    // nopt: shaders that are not optimised draw the same bits, and compile three times as fast.
    constexpr const char* kPerf[] = {"no_aos_sampling,no_filter_hacks,nopt", "no_aos_sampling,no_filter_hacks", ""};
    setenv("GALLIVM_PERF", kPerf[static_cast<std::size_t>(code)], 1);
    // Scenes are judged in processes side by side. Threads of llvmpipe draw the same bits, and wait for each other at
    // each read-back: 424 scenes take a third longer, one of 26,000 edges in feedback five times as long.
    setenv("LP_NUM_THREADS", "0", 0);
    if (driver == MesaDriver::softpipe) setenv("DRAW_USE_LLVM", "0", 1);  // else feedback with lighting is wrong
    unsetenv("LP_NATIVE_VECTOR_WIDTH");
    unsetenv("GALLIUM_OVERRIDE_CPU_CAPS");
    return wanted;
  }();
  if (claimed != wanted) {
    throw RendererFailed(
        fmt::format("OpenGL: this process already uses {}; {} needs a process of its own", claimed, wanted));
  }
}

}  // namespace osmesa
}  // namespace plumbline
