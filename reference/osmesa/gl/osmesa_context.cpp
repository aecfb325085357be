// Contexts of OSMesa. The library depends on LLVM's, which takes longer to start than most programs run: both are
// loaded with the first context.
#include "reference/osmesa/gl/context.h"

#include <dlfcn.h>

#include <array>

#include <fmt/format.h>

#include "capture/renderer.h"
#include "reference/osmesa/gl/gl.h"

// After gl.h, which asks <GL/gl.h> for all prototypes.
#include <GL/osmesa.h>

namespace plumbline {
namespace osmesa {
namespace {

struct Library {
  decltype(&OSMesaCreateContextExt) create;
  decltype(&OSMesaDestroyContext) destroy;
  decltype(&OSMesaMakeCurrent) make_current;
  decltype(&OSMesaGetProcAddress) function;
};

// Never unloaded: LLVM leaves handlers behind.
const Library& library() {
  static const Library loaded = [] {
    void* const file = dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL);
    if (file == nullptr) throw RendererFailed(fmt::format("OSMesa: {}", dlerror()));
    const auto find = [&]<class F>(F& function, const char* name) {
      function = reinterpret_cast<F>(dlsym(file, name));
      if (function == nullptr) throw RendererFailed(fmt::format("OSMesa: {}", dlerror()));
    };
    Library out{};
    find(out.create, "OSMesaCreateContextExt");
    find(out.destroy, "OSMesaDestroyContext");
    find(out.make_current, "OSMesaMakeCurrent");
    find(out.function, "OSMesaGetProcAddress");
    return out;
  }();
  return loaded;
}

class OsmesaContext final : public Context {
 public:
  explicit OsmesaContext(MesaDriver driver, ShaderCode code) {
    claim_process("OSMesa", driver, code);
    context_.reset(library().create(OSMESA_RGBA, 0, 0, 0, nullptr));
    if (!context_) throw RendererFailed(fmt::format("OSMesa: no context from {}", name_of(driver)));
  }

  void make_current() override {
    if (!library().make_current(context_.get(), unused_frame_.data(), GL_UNSIGNED_BYTE, kSize, kSize)) {
      throw RendererFailed("OSMesa: the context cannot be made current");
    }
  }

  Function function(const char* name) const override { return library().function(name); }

 private:
  static constexpr int kSize = 4;  // side of the frame that OSMesa requires [pixels]; nothing is drawn to it
  struct Destroy {
    void operator()(osmesa_context* context) const { library().destroy(context); }
  };
  std::array<unsigned char, 4 * kSize * kSize> unused_frame_{};
  std::unique_ptr<osmesa_context, Destroy> context_;
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context(MesaDriver driver, ShaderCode code) {
  return std::make_unique<OsmesaContext>(driver, code);
}

}  // namespace osmesa
}  // namespace plumbline
