// Ours against OSMesa's llvmpipe, in one process, frame by frame in turns: scripts/bench.
#include <benchmark/benchmark.h>

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bench/scenes/bench_scenes.h"
#include "painter/painter.h"
#include "reference/osmesa/readback/frame_loop.h"
#include "renderers/pipeline_renderer.h"

namespace plumbline::bench {
namespace {

// Pixels whose colours differ by more than a code, or depths by more than two steps.
std::size_t differing(const Planes& ours, const Planes& theirs) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < ours.color.size(); ++i) {
    const glm::vec4 d = glm::abs(ours.color.values()[i] - theirs.color.values()[i]);
    const double z = std::abs(ours.depth.values()[i] - theirs.depth.values()[i]);
    out += std::max({d.r, d.g, d.b, d.a}) > 1.5f / 255 || z > 2.0 / 16777215 ? 1 : 0;
  }
  return out;
}

// Of each benchmark the shortest and the middle of its repetitions, in milliseconds.
class Times : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && !run.error_occurred)
        of_[run.run_name.function_name].push_back(run.GetAdjustedRealTime());
    }
  }
  double median(const std::string& name) {
    std::vector<double>& times = of_.at(name);
    std::ranges::sort(times);
    return times[times.size() / 2];
  }

 private:
  std::map<std::string, std::vector<double>> of_;
};

double milliseconds(const std::function<void()>& frame) {
  const auto begin = std::chrono::steady_clock::now();
  frame();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

// A sphere's frames in turns; the middle of eleven.
void print_growth(const std::string& what, int triangles, int size, int threads) {
  const Scene scene = sphere_scene(triangles, size);
  const auto in_use = [] { return static_cast<double>(::mallinfo2().uordblks + ::mallinfo2().hblkhd); };
  const double before = in_use();
  pipeline::Painter painter(threads);
  painter.draw(scene);
  const double kept = in_use() - before;
  OsmesaFrames theirs(scene);
  std::vector<double> ours_ms, theirs_ms;
  for (int i = 0; i < 12; ++i) {
    const double o = milliseconds([&] { painter.draw(scene); }), t = milliseconds([&] { theirs.draw(); });
    if (i == 0) continue;  // asks for memory, compiles
    ours_ms.push_back(o);
    theirs_ms.push_back(t);
  }
  std::ranges::sort(ours_ms);
  std::ranges::sort(theirs_ms);
  fmt::print("{:>14} {:9.3f} {:9.3f} {:6.2f} {:9.1f}\n", what, ours_ms[5], theirs_ms[5], ours_ms[5] / theirs_ms[5],
             kept / 1e6);
}

// How time and memory grow.
void print_growth(int threads) {
  fmt::print("\n{:>14} {:>9} {:>9} {:>6} {:>9}   ({} threads, ms; MB that ours keeps)\n", "20k triangles", "ours",
             "llvmpipe", "ratio", "MB", threads);
  for (const int size : {256, 512, 1024, 2048, 4096}) {
    print_growth(fmt::format("{0} x {0}", size), 20'000, size, threads);
  }
  fmt::print("{:>14}\n", "1024 x 1024");
  for (const int triangles : {1'000, 10'000, 100'000, 1'000'000, 3'000'000}) {
    print_growth(fmt::format("{}k", triangles / 1000), triangles, 1024, threads);
  }
}

int run(int argc, char** argv) {
  CLI::App app("Times our renderer against OSMesa's llvmpipe");
  int threads = 1, size = 1024;
  double seconds = 0.3;
  std::string json, only;
  bool growth = false;
  app.add_option("--threads", threads, "Of both")->check(CLI::Range(1, 64));
  app.add_option("--size", size, "Pixels a side")->check(CLI::Range(16, 4096));
  app.add_option("--seconds", seconds, "Per repetition; there are five");
  app.add_option("--only", only, "Scenes whose names hold this");
  app.add_flag("--growth", growth, "How time and memory grow with pixels and triangles instead");
  app.add_option("--json", json, "Write the table there as well");
  CLI11_PARSE(app, argc, argv);
  ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);

  if (growth) return print_growth(threads), 0;

  std::vector<std::string> names;
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<std::unique_ptr<OsmesaFrames>> osmesa;
  for (const BenchScene& b : bench_scenes()) {
    if (b.name.find(only) == std::string::npos) continue;
    Scene& scene = *scenes.emplace_back(std::make_unique<Scene>(b.make(size)));
    OsmesaFrames& theirs = *osmesa.emplace_back(std::make_unique<OsmesaFrames>(scene));
    names.push_back(b.name);
    theirs.draw();
    Request picture;
    picture.planes = WantedPlanes::picture;
    const Capture ours = pipeline::make_pipeline()->capture(scene, picture);
    fmt::print("{:22} {} of {} pixels differ\n", b.name, differing(ours.planes, theirs.read()),
               ours.planes.color.size());
    const auto add = [&](const std::string& who, auto frame) {
      benchmark::RegisterBenchmark((b.name + "/" + who).c_str(),
                                   [frame](benchmark::State& state) {
                                     for (auto _ : state) frame();
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->MinTime(seconds)
          ->Repetitions(5);
    };
    const auto painter = std::make_shared<pipeline::Painter>(threads);
    add("ours", [&scene, painter] { benchmark::DoNotOptimize(painter->draw(scene)); });
    add("llvmpipe", [&theirs] { theirs.draw(); });
  }
  std::string program = argv[0], interleaved = "--benchmark_enable_random_interleaving=true";
  char* arguments[] = {program.data(), interleaved.data(), nullptr};
  int count = 2;
  benchmark::Initialize(&count, arguments);
  Times times;
  benchmark::RunSpecifiedBenchmarks(&times);

  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  double sum = 0;
  fmt::print("\n{:22} {:>9} {:>9} {:>6}   ({} threads, {} x {}, ms)\n", "", "ours", "llvmpipe", "ratio", threads, size,
             size);
  for (const std::string& name : names) {
    const double ours = times.median(name + "/ours"), theirs = times.median(name + "/llvmpipe");
    sum += std::log(ours / theirs);
    fmt::print("{:22} {:9.3f} {:9.3f} {:6.2f}\n", name, ours, theirs, ours / theirs);
    out.push_back({{"scene", name}, {"ours_ms", ours}, {"llvmpipe_ms", theirs}, {"ratio", ours / theirs}});
  }
  fmt::print("{:22} {:9} {:9} {:6.2f}\n", "geometric mean", "", "", std::exp(sum / static_cast<double>(names.size())));
  if (!json.empty())
    std::ofstream(json) << nlohmann::ordered_json{{"threads", threads}, {"size", size}, {"scenes", out}}.dump(1)
                        << "\n";
  return 0;
}

}  // namespace
}  // namespace plumbline::bench

int main(int argc, char** argv) { return plumbline::bench::run(argc, argv); }
