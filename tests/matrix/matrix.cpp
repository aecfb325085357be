#include "matrix/matrix.h"

#include <algorithm>
#include <map>
#include <memory>
#include <tuple>

#include <fmt/format.h>

#include "check/diagnose/diagnose.h"
#include "matrix/parallel.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"

namespace plumbline::matrix {

namespace {

// Exact on one scene. Its captures do not depend on the candidate, so that each pass is drawn once and kept; but those
// of some pixels or primitives alone are drawn every time.
class ExactOnce : public Renderer {
 public:
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene& scene, const Request& request) override {
    unsigned stages = 0;
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      stages |= request.records.has(static_cast<Stage>(i)) ? 1u << i : 0u;
    }
    if (!request.pixels.empty() || !request.primitives.empty()) return exact_->capture(scene, request);
    const FrameFormat& f = scene.frame;
    const Key key{f.antialias.kind, f.pass.sample.value_or(-1), f.pass.shift.x, f.pass.shift.y, request.legal, stages};
    const auto known = captures_.find(key);
    return known != captures_.end() ? known->second
                                    : captures_.emplace(key, exact_->capture(scene, request)).first->second;
  }
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions) override {
    return exact_->run_stage(scene, stage, in, conventions);
  }

 private:
  using Key = std::tuple<Antialias::Kind, int, double, double, bool, unsigned>;
  std::unique_ptr<Renderer> exact_ = exact::make_exact();
  RendererInfo info_ = exact_->info();
  std::map<Key, Capture> captures_;
};

Answer answer_of(const Scene& scene, std::size_t number, const Subject& subject, Renderer& exact) {
  const auto candidate = pipeline::make_pipeline(subject.stages);
  const check::Reference references[] = {{"exact", &exact}};
  const check::Diagnosis diagnosis = check::diagnose_in_brief(scene, *candidate, references);
  Answer out{number, "", diagnosis.first, diagnosis.wrong, ""};
  if (const check::Comparison* row = check::first_different(diagnosis.verdict)) {
    out.by = fmt::format("{}: {}", title_of(row->judge), name_of(row->stage));
  }
  for (const check::Comparison& c : diagnosis.verdict.comparisons) {
    if (c.outcome == check::Outcome::failed) out.failed = fmt::format("{}: {}", name_of(c.stage), c.note);
  }
  return out;
}

}  // namespace

bool is_right(const Answer& answer, const Subject& subject) {
  if (!answer.failed.empty()) return false;
  switch (subject.broken.size()) {
    case 0: return !answer.seen();
    case 1: return answer.first == subject.broken[0] && answer.wrong == subject.broken;
    default: return std::ranges::includes(answer.wrong, subject.broken);
  }
}

std::vector<std::vector<Answer>> diagnosed(std::span<const Scene> scenes, std::span<const Subject> subjects,
                                           std::span<const SceneList> on, unsigned workers) {
  std::vector<std::vector<Answer>> out(subjects.size());
  struct Question {
    const Subject* subject;
    Answer* answer;
  };
  std::vector<std::vector<Question>> of_scene(scenes.size());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    out[i].resize(on[i].size());
    for (std::size_t k = 0; k < on[i].size(); ++k) of_scene[on[i][k]].push_back({&subjects[i], &out[i][k]});
  }
  in_parallel(scenes.size(), workers, [&](std::size_t s) {
    ExactOnce exact;
    for (const Question& q : of_scene[s]) *q.answer = answer_of(scenes[s], s, *q.subject, exact);
  });
  return out;
}

SceneList spread(const SceneList& scenes, std::size_t most) {
  if (scenes.size() <= most) return scenes;
  SceneList out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(scenes[i * scenes.size() / most]);
  return out;
}

}  // namespace plumbline::matrix
