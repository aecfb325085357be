// Any bytes as an image file of each format that we write (the first byte chooses).
#include "capture/files/image_file.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  constexpr const char* kNames[] = {"image.png", "image.exr", "image.tga", "image.ppm"};
  if (size == 0) return 0;
  const auto file = fuzz::folder().write(kNames[data[0] % std::size(kNames)], fuzz::text(data + 1, size - 1));
  try {
    read_stored(file);
  } catch (const ImageError&) {
  }
  return 0;
}
