// Ours against OSMesa's llvmpipe, in one process, frame by frame in turns: scripts/bench.
#include <benchmark/benchmark.h>

#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <thread>

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

// Median of each benchmark's repetitions [ms].
class Times : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration) of_[run.run_name.function_name].push_back(run.GetAdjustedRealTime());
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

// A sphere's frames in turns; the median of eleven.
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

// Least share of a processor [0, 1] that one of `threads` threads gets while all compute for 0.1 s.
double share_of_processors(int threads) {
  std::vector<double> shares(static_cast<std::size_t>(threads));
  const auto compute = [](double& share) {
    const auto of_thread = [] {
      ::timespec t{};
      ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
      return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
    };
    const double before = of_thread();
    const double wall = milliseconds([] {
      const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
      while (std::chrono::steady_clock::now() < end) {
      }
    });
    share = (of_thread() - before) / wall;
  };
  {
    std::vector<std::jthread> running;
    for (double& share : shares) running.emplace_back([&] { compute(share); });
  }
  return *std::ranges::min_element(shares);
}

void warn_unless_idle(int threads) {
  constexpr double kEnough = 0.95;
  const double share = share_of_processors(threads);
  if (share < kEnough) {
    fmt::print("warning: the machine is not idle, a thread got {:.0f} % of a processor: do not rely on these times\n",
               100 * share);
  }
}

// A scene, made, and both renderers for it.
struct Timed {
  BenchScene of;
  int size;
  Scene scene;
  OsmesaFrames theirs;
  pipeline::Painter painter;
  Plane<std::uint32_t> read{};

  Timed(const BenchScene& b, int asked_size, int threads, OsmesaFrames::Filters filters)
      : of(b), size(b.size > 0 ? b.size : asked_size), scene(b.make(size)), theirs(scene, filters), painter(threads) {
    if (b.is_read) read = Plane<std::uint32_t>(size, size);
  }
  std::string name(const std::string& who) const { return of.name + "/" + who; }

  void draw_ours() {
    const pipeline::Frame& frame = painter.draw(scene);
    if (of.is_read) use(reinterpret_cast<const std::uint32_t*>(frame.color_rgba8.values().data()));
    benchmark::DoNotOptimize(frame);
  }
  void draw_theirs() {
    theirs.draw();
    if (!of.is_read) return;
    theirs.read_codes(read);
    use(read.values().data());
  }

 private:
  void use(const std::uint32_t* codes) { benchmark::DoNotOptimize(std::reduce(codes, codes + read.size())); }
};

struct Options {
  int threads = 1, size = 1024;
  double seconds = 0.3;
  std::string json, only;
  bool growth = false, approximate = false;
};

// Draws each scene once; returns those to be timed.
std::vector<std::unique_ptr<Timed>> timed_scenes(const Options& options) {
  using Filters = OsmesaFrames::Filters;
  std::vector<std::unique_ptr<Timed>> out;
  for (const BenchScene& b : bench_scenes()) {
    if (b.name.find(options.only) == std::string::npos) continue;
    Timed& timed = *out.emplace_back(std::make_unique<Timed>(
        b, options.size, options.threads, options.approximate ? Filters::approximate : Filters::exact));
    timed.theirs.draw();
    Request picture;
    picture.planes = WantedPlanes::picture;
    const Capture ours = pipeline::make_pipeline()->capture(timed.scene, picture);
    fmt::print("{:22} {} of {} pixels differ\n", b.name, differing(ours.planes, timed.theirs.read()),
               ours.planes.color.size());
    const auto add = [&](const std::string& who, auto frame) {
      benchmark::RegisterBenchmark(timed.name(who).c_str(),
                                   [frame](benchmark::State& state) {
                                     for (auto _ : state) frame();
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->MinTime(options.seconds)
          ->Repetitions(5);
    };
    add("ours", [&timed] { timed.draw_ours(); });
    add("llvmpipe", [&timed] { timed.draw_theirs(); });
  }
  return out;
}

// The table and, if asked for, the file.
void print_times(const Options& options, std::span<const std::unique_ptr<Timed>> scenes, Times& times) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  double of_all = 0, of_others = 0;
  int others = 0;
  fmt::print("\n{:24} {:>5} {:>9} {:>9} {:>6}   ({} threads, ms)\n", "", "side", "ours", "llvmpipe", "ratio",
             options.threads);
  for (const auto& timed : scenes) {
    const double ours = times.median(timed->name("ours")), theirs = times.median(timed->name("llvmpipe"));
    const double ratio = ours / theirs;
    of_all += std::log(ratio);
    if (!timed->of.is_of_layers) of_others += std::log(ratio), ++others;
    fmt::print("{:24} {:5} {:9.3f} {:9.3f} {:6.2f}\n", timed->of.name, timed->size, ours, theirs, ratio);
    out.push_back({{"scene", timed->of.name},
                   {"size", timed->size},
                   {"ours_ms", ours},
                   {"llvmpipe_ms", theirs},
                   {"ratio", ratio}});
  }
  const auto print_mean = [](const char* of, double sum, double count) {
    if (count > 0) fmt::print("{:50} {:6.2f}\n", of, std::exp(sum / count));
  };
  print_mean("geometric mean", of_all, static_cast<double>(scenes.size()));
  print_mean("geometric mean without the scenes of layers", of_others, others);
  if (options.json.empty()) return;
  std::ofstream(options.json) << nlohmann::ordered_json{{"threads", options.threads}, {"scenes", out}}.dump(1) << "\n";
}

int run(int argc, char** argv) {
  CLI::App app(
      "Times our renderer against OSMesa's llvmpipe. Ours: Painter::draw(), from the scene to colour and depth codes "
      "in\n"
      "row-linear planes. llvmpipe: the same draws into a frame buffer object, which is row-linear as well, state set\n"
      "for each, until glFinish(); no read-back, but for scenes whose names end in _read: there the colours are "
      "summed\n"
      "up, llvmpipe's after glReadPixels(). Both filter textures exactly, unless --approximate is given.");
  Options options;
  app.add_option("--threads", options.threads, "Of both")->check(CLI::Range(1, 64));
  app.add_option("--size", options.size, "Pixels a side, of scenes that have no size of their own")
      ->check(CLI::Range(16, 4096));
  app.add_option("--seconds", options.seconds, "Per repetition; there are five");
  app.add_option("--only", options.only, "Scenes whose names hold this");
  app.add_flag("--growth", options.growth, "How time and memory grow with pixels and triangles instead");
  app.add_flag("--approximate", options.approximate,
               "llvmpipe filters textures as it does by default: weights of 8 bits, levels of detail of four pixels");
  app.add_option("--json", options.json, "Write the table there as well");
  CLI11_PARSE(app, argc, argv);
  ::setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), 1);

  warn_unless_idle(options.threads);
  if (options.growth) {
    print_growth(options.threads);
  } else {
    const std::vector<std::unique_ptr<Timed>> scenes = timed_scenes(options);
    std::string program = argv[0], interleaved = "--benchmark_enable_random_interleaving=true";
    char* arguments[] = {program.data(), interleaved.data(), nullptr};
    int count = 2;
    benchmark::Initialize(&count, arguments);
    Times times;
    benchmark::RunSpecifiedBenchmarks(&times);
    print_times(options, scenes, times);
  }
  warn_unless_idle(options.threads);
  return 0;
}

}  // namespace
}  // namespace plumbline::bench

int main(int argc, char** argv) { return plumbline::bench::run(argc, argv); }
