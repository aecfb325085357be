// The fault matrix as a program: exit 0 where what must hold holds, 1 where it does not, 2 on bad usage.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "faults/faults.h"
#include "matrix/report.h"
#include "scene/scene_file.h"

namespace plumbline::matrix {

namespace {

// How much is judged.
struct Extent {
  bool models = false;                     // the big models' scenes too
  std::size_t affected = ~std::size_t{0};  // the first so many of a fault's scenes are looked for
  std::size_t scenes = 48;                 // at most, of each fault; spread over those that it affects
  std::size_t pairs = 120, of_pair = 3;    // of the scenes that both affect
};
constexpr Extent kUsual{};
constexpr Extent kAll{.models = true, .scenes = ~std::size_t{0}, .of_pair = 10};
constexpr Extent kQuick{.affected = 2, .pairs = 0};

std::vector<Scene> load(const std::filesystem::path& folder, bool models) {
  std::vector<Scene> out;
  for (const auto& file : find_scenes({&folder, 1})) {
    if (models || file.parent_path().stem() != "models") out.push_back(load_scene(file));
  }
  return out;
}

Subject subject_of(const faults::Fault& fault) {
  Subject out{std::string(fault.name), faults::production(), {fault.stage}};
  fault.apply(out.table);
  return out;
}

struct Pair {
  Subject subject;
  SceneList scenes;  // that each affects alone
};

// Two faults of two stages, at random; neither takes the other's place in the table.
std::vector<Pair> draw_pairs(std::span<const faults::Fault> all, std::span<const SceneList> on, const Extent& extent) {
  std::mt19937 random(1);
  std::vector<Pair> out;
  while (out.size() < extent.pairs) {
    std::size_t i = random() % all.size(), k = random() % all.size();
    if (all[k].stage < all[i].stage) std::swap(i, k);
    const faults::Fault &a = all[i], &b = all[k];
    faults::Table a_then_b = faults::production(), b_then_a = a_then_b;
    a.apply(a_then_b);
    b.apply(a_then_b);
    b.apply(b_then_a);
    a.apply(b_then_a);
    Pair pair{{fmt::format("{} + {}", a.name, b.name), a_then_b, {a.stage, b.stage}}, {}};
    std::ranges::set_intersection(on[i], on[k], std::back_inserter(pair.scenes));
    const bool drawn = std::ranges::any_of(out, [&](const Pair& p) { return p.subject.name == pair.subject.name; });
    if (a.stage == b.stage || a_then_b != b_then_a || pair.scenes.empty() || drawn) continue;
    out.push_back(std::move(pair));
  }
  return out;
}

std::vector<Row> rows_of(std::span<const Scene> scenes, std::vector<Subject> subjects, std::span<const SceneList> on,
                         std::size_t most, unsigned workers) {
  std::vector<SceneList> some;
  for (const SceneList& all : on) some.push_back(spread(all, most));
  std::vector<std::vector<Answer>> answers = diagnosed(scenes, subjects, some, workers);
  std::vector<Row> out;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    out.push_back({std::move(subjects[i]), on[i].size(), std::move(answers[i])});
  }
  return out;
}

Matrix matrix_of(const std::filesystem::path& folder, const Extent& extent, unsigned workers) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Scene> scenes = load(folder, extent.models);
  Matrix out;
  SceneList all_scenes;
  for (const Scene& scene : scenes) {
    all_scenes.push_back(out.scenes.size());
    out.scenes.push_back(scene.name);
  }
  const std::vector<faults::Fault> faults = faults::all();
  std::vector<Subject> subjects;
  for (const faults::Fault& fault : faults) subjects.push_back(subject_of(fault));
  const std::vector<SceneList> on = affected(scenes, subjects, extent.affected, workers);
  out.faults = rows_of(scenes, std::move(subjects), on, extent.scenes, workers);

  std::vector<SceneList> on_both;
  std::vector<Subject> pairs;
  for (Pair& pair : draw_pairs(faults, on, extent)) {
    pairs.push_back(std::move(pair.subject));
    on_both.push_back(std::move(pair.scenes));
  }
  out.pairs = rows_of(scenes, std::move(pairs), on_both, extent.of_pair, workers);

  if (extent.pairs > 0) {
    const SceneList on_all[] = {all_scenes};
    out.legal = rows_of(scenes, {{"ours", faults::production(), {}}}, on_all, all_scenes.size(), workers);
  }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace

}  // namespace plumbline::matrix

int main(int argc, char** argv) {
  using namespace plumbline;
  CLI::App app("Every fault on the scenes that it affects: is it seen, and its stage named?");
  bool all = false, quick = false;
  std::string json, scenes = PLUMBLINE_SOURCE_DIR "/tests/scenes";
  unsigned workers = std::max(1u, std::thread::hardware_concurrency());
  app.add_flag("--all", all, "all scenes that a fault affects, and the big models");
  app.add_flag("--quick", quick, "two scenes for each fault; no pairs")->excludes("--all");
  app.add_option("--json", json, "the same as JSON");
  app.add_option("--scenes", scenes, "the folder of scenes")->check(CLI::ExistingDirectory);
  app.add_option("--workers", workers, "threads")->check(CLI::Range(1u, 1024u));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  try {
    const matrix::Extent extent = all ? matrix::kAll : quick ? matrix::kQuick : matrix::kUsual;
    const matrix::Matrix result = matrix::matrix_of(scenes, extent, workers);
    fmt::print("{}", matrix::text_of(result));
    if (!json.empty()) matrix::write_json(result, json);
    return matrix::holds(matrix::shares(result)) ? 0 : 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "fault_matrix: {}\n", e.what());
    return 2;
  }
}
