// Hashes of what the pipeline hands on: scene_hashes FOLDER, or scene_hashes --random SEED COUNT. A line for each
// scene, fields apart by tabs: name, work (about what drawing takes), the hash of each stage (-: none), and that of all
// painters' pictures. Another process draws; of a scene on which it crashes, throws or never ends the line is name,
// work, "failed" and why. After three such no more are drawn.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/workers.h"
#include "check/golden/golden_hash.h"
#include "mutation/program/random_scenes.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/scene_work.h"

namespace plumbline::mutation {
namespace {

// Time limit of a scene; the slowest takes 2 s on an idle machine, 20 s on a busy one.
constexpr std::chrono::seconds kMostTime{60};
constexpr int kMostFailed = 3;

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

std::string line_of(const Scene& scene, const std::string& fields) {
  return fmt::format("{}\t{}{}\n", scene.name, test::work_of(scene), fields);
}
std::string failed(const std::string& why) { return "\tfailed\t" + why; }

// A line of each scene, in their order.
int print_lines(std::size_t count, const std::function<Scene(std::size_t)>& scene_of) {
  constexpr std::uint32_t kDraws = 1;  // Progress
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  int lines_failed = 0;
  const auto make = [&](Progress& progress) -> Workers::Answer {
    return [&](const std::string& request) -> std::string {
      if (request.empty()) return "";
      const std::size_t number = std::stoull(request), why = request.find(' ');
      const Scene scene = scene_of(number);
      if (why != request.npos) return line_of(scene, failed(request.substr(why + 1)));
      progress.begin(kDraws, kMostTime);
      std::string fields;
      try {
        fields = hashes_of(scene);
      } catch (const std::exception& error) {
        fields = failed(error.what());
      }
      progress.end(kMostTime);
      return line_of(scene, fields);
    };
  };
  const auto ask = [&](std::size_t i) { return lines_failed < kMostFailed ? std::to_string(i) : ""; };
  const auto ask_again = [&](std::size_t i, const WorkerEnd& end) {
    if (end.step != kDraws) throw std::runtime_error(fmt::format("scene {}: the process that loads it {}", i, end.how));
    return fmt::format("{} {}", i, end.how);
  };
  const auto take = [&](std::size_t, const std::string& line) {
    lines_failed += line.find("\tfailed\t") == line.npos ? 0 : 1;
    fmt::print("{}", line);
    std::fflush(stdout);
  };
  Workers(1, {.step = kMostTime}, make).run({order, ask, take, ask_again});
  return EXIT_SUCCESS;
}

int of_folder(const char* folder) {
  const std::filesystem::path path = folder;
  const std::vector<std::filesystem::path> files = find_scenes({&path, 1});
  return print_lines(files.size(), [&](std::size_t i) { return load_scene(files[i]); });
}

int of_random_scenes(std::uint64_t seed, int count) {
  return print_lines(static_cast<std::size_t>(count), [&](std::size_t i) {
    Scene scene = random_scene_of(seed, static_cast<int>(i));
    scene.name = fmt::format("random {}", i);
    return scene;
  });
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
