#include "matrix/matrix.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <thread>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "check/diagnose.h"
#include "pipeline/pipeline_renderer.h"
#include "reference/exact/exact.h"
#include "scene/antialias.h"
#include "stages/capture_columns.h"

namespace plumbline::matrix {

namespace {

/// job(0) to job(n - 1), each once, on so many threads. Nothing of the renderers is shared between them.
void in_parallel(std::size_t n, unsigned workers, const std::function<void(std::size_t)>& job) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> threads;
  for (unsigned i = 0; i < workers; ++i) {
    threads.emplace_back([&] {
      for (std::size_t k = next++; k < n; k = next++) job(k);
    });
  }
}

// All bits of a capture, column by column, for records have padding.
struct Bits {
  std::uint64_t hash = 0;
  void add(const auto& value) {
    std::array<std::uint32_t, (sizeof value + 3) / 4> words{};
    std::memcpy(words.data(), &value, sizeof value);
    for (const std::uint32_t word : words) hash = (hash ^ word) * 0x9e3779b97f4a7c15u ^ (hash >> 29);
  }
  void group(std::string_view, const auto& records, const auto&... columns) {
    add(records.size());
    const auto add_column = [&](const auto& column) {
      const std::size_t corners = std::max<std::size_t>(column.kCorners, 1);
      for (const auto& record : records) {
        for (std::size_t i = 0; i < corners; ++i) add(column.at(record, i));
      }
    };
    (add_column(columns), ...);
  }
  void plane(std::string_view, const auto& plane) {
    add(plane.size());
    for (const auto& value : plane.values()) add(value);
  }
};

std::uint64_t bits_of(const Scene& scene, const faults::Table& table) {
  const auto renderer = pipeline::make_pipeline(faults::stages_of(table));
  Bits bits;
  if (scene.frame.antialias.kind != Antialias::Kind::none) {
    const Capture resolved = renderer->capture(scene, {});
    visit_capture(resolved, bits);
  }
  for (const Scene& pass : passes_of(scene)) {
    const Capture capture = renderer->capture(pass, {StageSet::all(), false, {}, {}});
    visit_capture(capture, bits);
  }
  return bits.hash;
}

// Exact on one scene: what it draws does not hang on whom it judges, and is drawn once.
class ExactOnce : public Renderer {
 public:
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene& scene, const Request& request) override {
    unsigned stages = 0;
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      stages |= request.records.has(static_cast<Stage>(i)) ? 1u << i : 0u;
    }
    const FrameFormat& f = scene.frame;
    const Key key{f.antialias.kind, f.pass.sample.value_or(-1), f.pass.shift.x, f.pass.shift.y, request.legal, stages};
    const auto known = captures_.find(key);
    return known != captures_.end() ? known->second
                                    : captures_.emplace(key, exact_->capture(scene, request)).first->second;
  }
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in) override {
    return exact_->run_stage(scene, stage, in);
  }

 private:
  using Key = std::tuple<Antialias::Kind, int, double, double, bool, unsigned>;
  std::unique_ptr<Renderer> exact_ = exact::make_exact();
  RendererInfo info_ = exact_->info();
  std::map<Key, Capture> captures_;
};

Answer answer(const Scene& scene, std::size_t number, const Subject& subject, Renderer& exact) {
  const auto candidate = pipeline::make_pipeline(faults::stages_of(subject.table));
  const check::Reference references[] = {{"exact", &exact}};
  const check::Diagnosis diagnosis = check::diagnose(scene, *candidate, references);
  Answer out{number, "", diagnosis.first, diagnosis.wrong, ""};
  if (const check::Comparison* row = check::first_different(diagnosis.verdict)) {
    out.by = fmt::format("{}: {}", row->reference, name_of(row->stage));
  }
  for (const check::Comparison& c : diagnosis.verdict.comparisons) {
    if (c.outcome == check::Outcome::failed) out.failed = fmt::format("{}: {}", name_of(c.stage), c.note);
  }
  return out;
}

}  // namespace

bool names(const Answer& answer, const Subject& subject) {
  if (subject.broken.size() == 1) return answer.first == subject.broken[0] && answer.wrong == subject.broken;
  return std::ranges::includes(answer.wrong, subject.broken);
}

std::vector<std::vector<std::size_t>> affected(std::span<const Scene> scenes, std::span<const Subject> subjects,
                                               unsigned workers) {
  std::vector<std::vector<char>> changed(scenes.size(), std::vector<char>(subjects.size()));
  in_parallel(scenes.size(), workers, [&](std::size_t s) {
    const std::uint64_t right = bits_of(scenes[s], faults::production());
    for (std::size_t i = 0; i < subjects.size(); ++i) try { changed[s][i] = bits_of(scenes[s], subjects[i].table) != right; } catch (const std::exception& e) { fmt::print("{} {} {}\n", scenes[s].name, subjects[i].name, e.what()); }
  });
  std::vector<std::vector<std::size_t>> out(subjects.size());
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      if (changed[s][i] != 0) out[i].push_back(s);
    }
  }
  return out;
}

std::vector<std::vector<Answer>> diagnosed(std::span<const Scene> scenes, std::span<const Subject> subjects,
                                           std::span<const std::vector<std::size_t>> on, unsigned workers) {
  std::vector<std::vector<Answer>> out(subjects.size());
  std::vector<std::vector<Answer*>> of_scene(scenes.size());
  std::vector<std::vector<std::size_t>> subjects_of(scenes.size());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    out[i].resize(on[i].size());
    for (std::size_t k = 0; k < on[i].size(); ++k) {
      of_scene[on[i][k]].push_back(&out[i][k]);
      subjects_of[on[i][k]].push_back(i);
    }
  }
  in_parallel(scenes.size(), workers, [&](std::size_t s) {
    ExactOnce exact;
    for (std::size_t k = 0; k < of_scene[s].size(); ++k) {
      *of_scene[s][k] = answer(scenes[s], s, subjects[subjects_of[s][k]], exact);
    }
  });
  return out;
}

std::vector<std::size_t> sample(const std::vector<std::size_t>& scenes, std::size_t most) {
  if (scenes.size() <= most) return scenes;
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(scenes[i * scenes.size() / most]);
  return out;
}

}  // namespace plumbline::matrix
