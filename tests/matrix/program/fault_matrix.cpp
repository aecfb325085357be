// The fault matrix as a program: exit 0 where what must hold holds, 1 where it does not, 2 on bad usage.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <optional>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "faults/faults.h"
#include "matrix/legal.h"
#include "matrix/report.h"
#include "pipeline/stages.h"
#include "scene/file/scene_file.h"
#include "tests/scene_work.h"

namespace plumbline::matrix {

namespace {

// How much is judged.
struct Extent {
  bool models = false;                     // the big models' scenes too
  std::size_t affected = ~std::size_t{0};  // affected scenes sought per fault
  std::size_t scenes = 36;                 // most per fault, spread over those that it affects
  std::size_t pairs = 120, of_pair = 3;    // number, and scenes of each
  std::size_t of_legal = 30;               // scenes of each variant
  std::size_t every = 1;                   // stride over faults
  bool until_seen = false;                 // a fault's scenes one by one, cheapest first, until it is seen
};
constexpr Extent kUsual{};
constexpr Extent kAll{.models = true, .scenes = ~std::size_t{0}, .pairs = 400, .of_pair = 10, .of_legal = 100};
constexpr Extent kQuick{.affected = 1, .pairs = 0, .of_legal = 0, .every = 5, .until_seen = true};

bool is_model(const Scene& scene) { return scene.name.starts_with("models/"); }

std::vector<Scene> load(const std::filesystem::path& folder, bool models) {
  std::vector<Scene> out;
  for (const auto& file : find_scenes({&folder, 1})) {
    if (models || file.parent_path().stem() != "models") out.push_back(load_scene(file));
  }
  return out;
}

Subject subject_of(const faults::Fault& fault) {
  Subject out{std::string(fault.name), pipeline::production_stages(), {fault.stage}};
  fault.apply(out.stages);
  return out;
}

struct Pair {
  Subject subject;
  SceneList scenes;  // that each affects alone
};

// None: both faults are in one stage, replace a common function, or affect no common scene.
std::optional<Pair> pair_of(const faults::Fault& one, const faults::Fault& other, const SceneList& on_one,
                            const SceneList& on_other) {
  const faults::Fault &a = other.stage < one.stage ? other : one, &b = other.stage < one.stage ? one : other;
  pipeline::Stages a_then_b = pipeline::production_stages(), b_then_a = a_then_b;
  a.apply(a_then_b);
  b.apply(a_then_b);
  b.apply(b_then_a);
  a.apply(b_then_a);
  Pair pair{{fmt::format("{} + {}", a.name, b.name), a_then_b, {a.stage, b.stage}}, {}};
  std::ranges::set_intersection(on_one, on_other, std::back_inserter(pair.scenes));
  if (a.stage == b.stage || a_then_b != b_then_a || pair.scenes.empty()) return std::nullopt;
  return pair;
}

// Random pairs of faults (pair_of), drawn by a fixed seed: extent.pairs of them, or as many as there are.
std::vector<Pair> draw_pairs(std::span<const faults::Fault> all, std::span<const SceneList> on, const Extent& extent) {
  std::size_t most = 0;
  for (std::size_t i = 0; i < all.size() && most < extent.pairs; ++i) {
    for (std::size_t k = 0; k < i; ++k) most += pair_of(all[i], all[k], on[i], on[k]) ? 1 : 0;
  }
  std::mt19937 random(1);
  std::vector<Pair> out;
  while (out.size() < std::min(most, extent.pairs)) {
    const std::size_t i = random() % all.size(), k = random() % all.size();
    std::optional<Pair> pair = pair_of(all[i], all[k], on[i], on[k]);
    const auto has_its_name = [&](const Pair& p) { return p.subject.name == pair->subject.name; };
    if (pair && std::ranges::none_of(out, has_its_name)) out.push_back(std::move(*pair));
  }
  return out;
}

std::vector<Row> rows_of(std::span<const Scene> scenes, std::vector<Subject> subjects, const std::vector<SceneList>& on,
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

// Judges each subject on one scene after the other, until it is seen: a fault that changes last bits alone need not be.
std::vector<Row> until_seen(std::span<const Scene> scenes, std::vector<Subject> subjects,
                            const std::vector<SceneList>& on, unsigned workers) {
  std::vector<Row> rows = rows_of(scenes, std::move(subjects), on, 0, workers);
  for (std::size_t round = 0;; ++round) {
    std::vector<Row*> unseen;
    std::vector<Subject> again;
    std::vector<SceneList> next;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].seen() > 0 || round >= on[i].size()) continue;
      unseen.push_back(&rows[i]);
      again.push_back(rows[i].subject);
      next.push_back({on[i][round]});
    }
    if (unseen.empty()) return rows;
    const std::vector<std::vector<Answer>> answers = diagnosed(scenes, again, next, workers);
    for (std::size_t i = 0; i < unseen.size(); ++i) unseen[i]->answers = answers[i];
  }
}

std::vector<Row> of_faults_and_pairs(std::span<const Scene> scenes, const Extent& extent, unsigned workers,
                                     std::vector<Row>& of_pairs) {
  std::vector<faults::Fault> faults;
  const std::vector<faults::Fault> all = faults::all();
  for (std::size_t i = 0; i < all.size(); i += extent.every) faults.push_back(all[i]);
  std::vector<Subject> subjects, pairs;
  for (const faults::Fault& fault : faults) subjects.push_back(subject_of(fault));
  const std::vector<SceneList> on = affected(scenes, subjects, extent.affected, workers);
  std::vector<SceneList> on_both;
  for (Pair& pair : draw_pairs(faults, on, extent)) {
    pairs.push_back(std::move(pair.subject));
    on_both.push_back(std::move(pair.scenes));
  }
  of_pairs = rows_of(scenes, std::move(pairs), on_both, extent.of_pair, workers);
  if (!extent.until_seen) return rows_of(scenes, std::move(subjects), on, extent.scenes, workers);
  std::vector<Row> rows = until_seen(scenes, std::move(subjects), on, workers);
  for (Row& row : rows) {  // looking for more scenes takes long, and few faults need them
    for (std::size_t most = 4; row.seen() == 0; most *= 4) {
      const std::vector<SceneList> more = affected(scenes, {&row.subject, 1}, most, workers);
      row = std::move(until_seen(scenes, {row.subject}, more, workers)[0]);
      if (more[0].size() < most) break;
    }
  }
  return rows;
}

// Rows of the pipeline itself, on all scenes, and of each legal variant, on some.
std::vector<Row> of_legal(const std::vector<Scene>& scenes, const Extent& extent, unsigned workers) {
  SceneList all(scenes.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<Row> out = rows_of(scenes, {{"ours", pipeline::production_stages(), {}}}, {{all}}, all.size(), workers);
  for (const faults::Variant& variant : faults::legal_variants()) {
    Subject subject{std::string(variant.name), pipeline::production_stages(), {}};
    if (variant.apply != nullptr) variant.apply(subject.stages);
    std::vector<Scene> said;
    SceneList where;
    for (const std::size_t s : all) {
      if (is_model(scenes[s])) continue;  // restated, they exceed the memory budget
      std::optional<Scene> otherwise = variant.scene == nullptr ? scenes[s] : variant.scene(scenes[s]);
      if (!otherwise) continue;
      said.push_back(std::move(*otherwise));
      where.push_back(s);
    }
    SceneList numbers(said.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    Row row = std::move(rows_of(said, {std::move(subject)}, {{numbers}}, extent.of_legal, workers)[0]);
    for (Answer& a : row.answers) a.scene = where[a.scene];
    out.push_back(std::move(row));
  }
  return out;
}

Matrix matrix_of(const std::filesystem::path& folder, const Extent& extent, unsigned workers) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Scene> scenes = load(folder, extent.models);
  if (extent.until_seen) std::ranges::stable_sort(scenes, {}, test::work_of);
  Matrix out;
  for (const Scene& scene : scenes) out.scenes.push_back(scene.name);
  out.faults = of_faults_and_pairs(scenes, extent, workers, out.pairs);
  if (extent.of_legal > 0) out.legal = of_legal(scenes, extent, workers);
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
  app.add_flag("--quick", quick, "one scene for each fifth fault; no pairs")->excludes("--all");
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
