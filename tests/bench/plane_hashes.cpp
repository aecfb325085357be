// A hash of each scene's planes, and that every SIMD target and 1 to 8 threads draw them: scripts/same_bits compares
// what builds by different compilers print. plane_hashes TARGET SCENE...: of what that target draws alone, for machines
// that are slow (scripts/emulate_avx512).
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "painter/painter.h"
#include "pipeline/render.h"
#include "scene/file/scene_file.h"
#include "tests/suite.h"

namespace plumbline::pipeline {
namespace {

// FNV-1a.
class Hash {
 public:
  template <class T>
  void add(const Plane<T>& plane) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(plane.values().data());
    for (std::size_t i = 0; i < plane.size() * sizeof(T); ++i) value_ = (value_ ^ bytes[i]) * 1099511628211u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037u;
};

std::uint64_t hash(const Frame& frame) {
  Hash out;
  out.add(frame.color_rgba8), out.add(frame.color_rgba16), out.add(frame.color_rgba32f);
  out.add(frame.depth_code), out.add(frame.depth_z32f), out.add(frame.stencil);
  return out.value();
}

int run() {
  std::vector<std::unique_ptr<Painter>> painters;
  for (const SimdTarget& target : simd_targets()) painters.push_back(std::make_unique<Painter>(1, target));
  for (int threads = 2; threads <= 8; ++threads) painters.push_back(std::make_unique<Painter>(threads));
  int differing = 0;
  for (const std::filesystem::path& file : suite_files()) {
    const Scene scene = load_scene(file, {});
    const std::uint64_t definition = hash(render(scene, production_stages()));
    fmt::print("{:016x} {}\n", definition, scene.name);
    differing += static_cast<int>(
        std::ranges::count_if(painters, [&](const auto& painter) { return hash(painter->draw(scene)) != definition; }));
  }
  fmt::print(stderr, "{} targets and up to 8 threads: {} pictures differ\n", simd_targets().size(), differing);
  return differing == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

int run(std::string_view name, std::span<char*> files) {
  const auto target = std::ranges::find(simd_targets(), name, &SimdTarget::name);
  if (target == simd_targets().end()) {
    fmt::print(stderr, "no {} on this machine\n", name);
    return 2;
  }
  Painter painter(1, *target);
  for (const char* file : files) {
    const Scene scene = load_scene(file, {});
    fmt::print("{:016x} {}\n", hash(painter.draw(scene)), scene.name);
  }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace plumbline::pipeline

int main(int argc, char** argv) {
  if (argc == 1) return plumbline::pipeline::run();
  return plumbline::pipeline::run(argv[1], std::span(argv, static_cast<std::size_t>(argc)).subspan(2));
}
