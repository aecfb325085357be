#include "cli/judge_in_workers.h"

#include <unistd.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/worker_bytes.h"

namespace plumbline::cli {

std::size_t worker_count(const CheckOptions& o, std::size_t requests) {
  const int wanted = o.jobs > 0 ? o.jobs : static_cast<int>(std::thread::hardware_concurrency());
  return std::min(static_cast<std::size_t>(std::clamp(wanted, 1, kMostJobs)), std::max<std::size_t>(requests, 1));
}

namespace {

// Numbers of the scenes in the order of judging: those that take a good part of a thread's time come first, else they
// would be waited for at the end.
std::vector<std::size_t> order_to_judge(std::span<const Scene> scenes, std::size_t at_a_time) {
  constexpr double kPerPrimitive = 16;  // times as long as a pixel
  std::vector<double> costs;
  for (const Scene& scene : scenes) {
    double primitives = 0;
    for (const Draw& draw : scene.draws) primitives += static_cast<double>(scene.meshes[draw.mesh].triangles.size());
    costs.push_back(kPerPrimitive * primitives + static_cast<double>(scene.frame.width) * scene.frame.height);
  }
  const double most = std::accumulate(costs.begin(), costs.end(), 0.0) / (4.0 * static_cast<double>(at_a_time));
  std::vector<std::size_t> out(scenes.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  if (at_a_time > 1) std::stable_partition(out.begin(), out.end(), [&](std::size_t i) { return costs[i] > most; });
  return out;
}

}  // namespace

void judge_in_workers(std::span<const Scene> scenes, const CheckRules& rules, std::set<std::string>& words,
                      const std::function<void(JudgedScene)>& take) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::size_t at_a_time = worker_count(rules.options, scenes.size());
  const std::vector<std::size_t> order = order_to_judge(scenes, at_a_time);
  std::vector<JudgeRequest> requests(scenes.size());
  const auto make = [&](Progress& progress) -> Workers::Answer {
    const auto judge = std::make_shared<SceneJudge>(rules, progress);
    return [&, judge](const std::string& bytes) {
      JudgeRequest request = request_of(bytes);
      const Scene& scene = scenes[request.scene];
      return to_bytes(request.not_compared.empty() ? judge->judge(scene, std::move(request.ended))
                                                   : not_compared(scene, rules, request.not_compared),
                      rules);
    };
  };
  const auto ask = [&](std::size_t i) {
    if (terminal) fmt::print(stderr, "\r\x1b[K[{}/{}] {}\r", i + 1, scenes.size(), scenes[i].path);
    requests[i].scene = i;
    return to_bytes(requests[i]);
  };
  const auto ask_again = [&](std::size_t i, const WorkerEnd& end) {
    (end.step == Progress::kBetween ? requests[i].not_compared : requests[i].ended[end.step]) = end.how;
    return to_bytes(requests[i]);
  };
  const auto took = [&](std::size_t, const std::string& answer) { take(judged_scene_of(answer, rules, words)); };
  Workers(at_a_time, rules.options.limits, make).run({order, ask, took, ask_again});
}

}  // namespace plumbline::cli
