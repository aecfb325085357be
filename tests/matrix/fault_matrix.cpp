// a first measurement
#include <chrono>
#include <fmt/format.h>
#include "faults/faults.h"
#include "matrix/matrix.h"
#include "scene/scene_file.h"
using namespace plumbline;
int main() {
  const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
  std::vector<Scene> scenes;
  for (const auto& f : find_scenes(folder)) scenes.push_back(load_scene(f, {}));
  std::vector<matrix::Subject> subjects;
  for (const auto& f : faults::all()) { matrix::Subject s{std::string(f.name), faults::production(), {f.stage}}; f.apply(s.table); subjects.push_back(s); }
  auto t0 = std::chrono::steady_clock::now();
  auto lap = [&](const char* w) { auto t = std::chrono::steady_clock::now(); fmt::print("{} {:.2f} s cpu {:.2f}\n", w, std::chrono::duration<double>(t - t0).count(), double(clock())/CLOCKS_PER_SEC); t0 = t; };
  auto on = matrix::affected(scenes, subjects, 2);
  lap("affected");
  for (std::size_t i = 0; i < on.size(); ++i) { fmt::print("{} {}\n", subjects[i].name, on[i].size()); on[i] = matrix::sample(on[i], 3); }
  std::vector<matrix::Subject> prod{{"production", faults::production(), {}}};
  std::vector<std::vector<std::size_t>> allscenes(1);
  for (std::size_t s = 0; s < scenes.size(); ++s) allscenes[0].push_back(s);
  auto pa = matrix::diagnosed(scenes, prod, allscenes, 2);
  lap("production");
  for (auto& a : pa[0]) if (!a.by.empty() || !a.failed.empty()) fmt::print("ALARM {} {} {}\n", scenes[a.scene].name, a.by, a.failed);
  auto an = matrix::diagnosed(scenes, subjects, on, 2);
  lap("3 each");
  for (std::size_t i = 0; i < on.size(); ++i) for (auto& a : an[i]) if (!matrix::names(a, subjects[i])) { fmt::print("{} {} by {} first {} failed {} wrong", subjects[i].name, scenes[a.scene].name, a.by, a.first ? name_of(*a.first) : "-", a.failed); for (auto w : a.wrong) fmt::print(" {}", name_of(w)); fmt::print("\n"); }
}
