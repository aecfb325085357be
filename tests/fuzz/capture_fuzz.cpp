// Any text as the manifest of a capture folder whose arrays are a few bytes long, and any bytes as those.
#include "capture/files/capture_folder.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  const std::string_view all = fuzz::text(data, size);
  const std::size_t split = all.find('\0');
  const std::string_view rest = split == all.npos ? std::string_view() : all.substr(split + 1);
  fuzz::folder().write("manifest.json", all.substr(0, split));
  for (const char* name : {"planes.id.bin", "clip.polygon.first.bin", "coverage.x.bin"})
    fuzz::folder().write(name, rest);
  try {
    read_capture(fuzz::folder().path());
  } catch (const CaptureError&) {
  }
  return 0;
}
