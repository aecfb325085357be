#include "images/image_codec.h"

#include <dlfcn.h>

#include <stdexcept>

#include <fmt/format.h>

namespace plumbline {

const ImageCodec& image_codec() {
  // Never unloaded: images that the module opened may live until the process ends.
  static const ImageCodec* const kCodec = [] {
    void* module = dlopen("plumbline_openimageio.so", RTLD_LAZY | RTLD_LOCAL);
    const void* codec = module == nullptr ? nullptr : dlsym(module, "plumbline_image_codec");
    if (codec == nullptr) throw std::runtime_error(fmt::format("images cannot be read or written: {}", dlerror()));
    return static_cast<const ImageCodec*>(codec);
  }();
  return *kCodec;
}

}  // namespace plumbline
