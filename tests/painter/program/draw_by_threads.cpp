// Frames by 1 to 8 threads: exit 0 where all are the same. For ThreadSanitizer (scripts/test_tsan), with the painter as
// it is, and with one that takes its tiles' numbers without an atomic.
#include <cstdlib>

#include <fmt/format.h>

#include "painter/painter.h"
#include "tests/painter/painter_frames.h"

int main() {
  using namespace plumbline;
  const Scene scene = pipeline::spheres(120, Cull::none);
  const pipeline::Frame expected = pipeline::paint(scene);
  int differing = 0;
  for (int threads = 1; threads <= 8; ++threads) {
    for (const pipeline::SimdTarget& target : pipeline::simd_targets())
      differing += same_bits(expected, pipeline::Painter(threads, target).draw(scene)) ? 0 : 1;
  }
  fmt::print("{} frames differ\n", differing);
  return differing == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
