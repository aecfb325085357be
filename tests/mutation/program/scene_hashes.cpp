// What the pipeline hands on of scenes, as hashes: scene_hashes FOLDER, or scene_hashes --random SEED COUNT. A line for
// each scene, fields apart by tabs: name, about what drawing it takes, the hash of each stage (-: none), and of the
// picture as it ships. Each scene has a process of its own; of one that crashes or never ends the line is name, work,
// "failed" and why. After three such no more are drawn.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/child_process.h"
#include "check/golden/golden_hash.h"
#include "mutation/program/random_scenes.h"
#include "renderers/pipeline_renderer.h"
#include "scene/antialias.h"
#include "scene/file/scene_file.h"

namespace plumbline::mutation {
namespace {

constexpr unsigned kMostSeconds = 60;  // of a scene: the slowest takes 2 s on an idle machine, 20 s on a busy one
constexpr int kMostFailed = 3;

// Pixels of each draw, and a triangle as 50 of them.
std::size_t work_of(const Scene& scene) {
  std::size_t out = 0;
  for (const Scene& pass : passes_of(scene)) {
    const std::size_t pixels = static_cast<std::size_t>(pass.frame.width) * static_cast<std::size_t>(pass.frame.height);
    for (const Draw& draw : pass.draws) out += pixels + 50 * pass.meshes[draw.mesh].triangles.size();
  }
  return out;
}

template <class T>
void add(check::Hasher& hasher, const Plane<T>& plane) {
  hasher.add(plane.values().data(), plane.size() * sizeof(T));
}

// The picture of every painter: a fault of one SIMD target changes the hash.
std::string hash_of_pictures(const Scene& scene) {
  const auto ours = pipeline::make_pipeline();
  check::Hasher pictures;
  for (const std::string& painter : ours->info().painters) {
    Request request;
    request.planes = WantedPlanes::picture;
    request.painter = painter;
    const Capture drawn = ours->capture(scene, request);
    add(pictures, drawn.planes.color);
    add(pictures, drawn.planes.depth);
    add(pictures, drawn.planes.stencil);
  }
  return to_string(pictures.done());
}

std::string hashes_of(const Scene& scene) {
  const check::Fingerprint drawn = check::fingerprint(scene, *pipeline::make_pipeline());
  std::string out;
  for (const auto& hash : drawn.stages) out += fmt::format("\t{}", hash ? to_string(*hash) : "-");
  return fmt::format("{}\t{}", out, hash_of_pictures(scene));
}

// Whether the scene could be drawn.
bool print_line(const Scene& scene) {
  std::string line;
  bool drawn = true;
  try {
    line = in_child_process([&] { return hashes_of(scene); }, kMostSeconds);
  } catch (const std::runtime_error& error) {
    line = fmt::format("\tfailed\t{}", error.what());
    drawn = false;
  }
  fmt::print("{}\t{}{}\n", scene.name, work_of(scene), line);
  std::fflush(stdout);
  return drawn;
}

int of_folder(const char* folder) {
  int failed = 0;
  const std::filesystem::path path = folder;
  for (const auto& file : find_scenes({&path, 1})) {
    if (!print_line(load_scene(file)) && ++failed == kMostFailed) break;
  }
  return EXIT_SUCCESS;
}

int of_random_scenes(std::uint64_t seed, int count) {
  int failed = 0;
  for (int i = 0; i < count && failed < kMostFailed; ++i) {
    Scene scene = random_scene_of(seed, i);
    scene.name = fmt::format("random {}", i);
    failed += print_line(scene) ? 0 : 1;
  }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace plumbline::mutation

int main(int argc, char** argv) {
  using namespace plumbline::mutation;
  try {
    if (argc == 2) return of_folder(argv[1]);
    if (argc == 4 && std::string_view(argv[1]) == "--random") {
      return of_random_scenes(std::strtoull(argv[2], nullptr, 10), std::atoi(argv[3]));
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "scene_hashes: {}\n", error.what());
    return 2;
  }
  fmt::print(stderr, "scene_hashes FOLDER | --random SEED COUNT\n");
  return 2;
}
