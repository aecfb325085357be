// How many scenes a second go to a server and come back (src/kit/README.md): written, drawn by a small rasterizer in C,
// read back; nothing is judged.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "base/supervise.h"
#include "cli/options/program_argument.h"
#include "scene/file/scene_file.h"
#include "tests/suite.h"

int main() {
  using namespace plumbline;
  using Clock = std::chrono::steady_clock;
  constexpr int kMostPixels = 64 * 64;
  constexpr std::chrono::seconds kTime{3};
  supervise();
  const auto renderer = cli::make_program({.command = PLUMBLINE_C_RENDERER " {serve}"});
  std::vector<Scene> scenes;
  for (const std::filesystem::path& file : suite_files()) {
    Scene scene = load_scene(file);
    if (scene.frame.width * scene.frame.height > kMostPixels) continue;
    try {
      renderer->capture(scene, {});
      scenes.push_back(std::move(scene));
    } catch (const Unsupported&) {
    }
  }
  if (scenes.empty()) {
    fmt::print(stderr, "protocol: {} draws none of the suite's scenes\n", PLUMBLINE_C_RENDERER);
    return 2;
  }
  std::size_t drawn = 0;
  const Clock::time_point start = Clock::now();
  while (Clock::now() - start < kTime) renderer->capture(scenes[drawn++ % scenes.size()], {});
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  fmt::print("protocol: {:.0f} scenes a second to a server and back ({} scenes of at most 64 x 64 pixels)\n",
             static_cast<double>(drawn) / seconds, scenes.size());
}
