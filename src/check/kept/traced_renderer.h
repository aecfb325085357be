// Calls of a candidate for a scene, and hashes of its answers. A judge is a function of the answers: where they are the
// same, so is the verdict.
#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/byte_archive.h"
#include "capture/renderer.h"
#include "check/golden/golden_hash.h"

namespace plumbline::check {

/// One call of Renderer::capture(), which handed out a capture or threw OverBudget.
struct TracedCall {
  static constexpr std::uint64_t kWhole = ~std::uint64_t{0};
  std::uint64_t pass = kWhole;  ///< index of the pass drawn (passes_of()); kWhole: the scene
  Request request;              ///< without legal answers, by default conventions
  Hash answer;                  ///< of everything in the capture, or of OverBudget's words
  Hash info;                    ///< of what info() said then
};

Hash hash_of(const RendererInfo& info);

/// The renderer `inner`, not owned, with a list of the calls for `scene`.
class TracedRenderer : public Renderer {
 public:
  TracedRenderer(const Scene& scene, Renderer& inner) : scene_(scene), inner_(inner) {}
  RendererInfo info() const override { return inner_.info(); }
  Capture capture(const Scene& scene, const Request& request) override;
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions) override;

  /// Repeats these calls in order, up to the first that fails or whose answer or info() differs: then false. That
  /// answer is cached: the next capture() of the same request returns or throws it without drawing. Earlier answers are
  /// not cached.
  bool answers_as_before(std::span<const TracedCall> calls);
  /// All calls of capture(), in order. None where one cannot be repeated: it asked for legal answers, for conventions
  /// other than the default, or for a scene that is neither the scene nor a pass of it; it failed; or run_stage() was
  /// called.
  const std::optional<std::vector<TracedCall>>& calls() const { return calls_; }

 private:
  struct Answer {
    TracedCall call;
    Capture capture;
    std::optional<std::string> over_budget;
    std::exception_ptr failure;  ///< any other exception; `call` then holds no hashes
  };
  Answer ask(std::uint64_t pass, const Request& request);
  const Scene& scene_of(std::uint64_t pass);

  const Scene& scene_;
  Renderer& inner_;
  std::vector<Scene> passes_;
  std::optional<std::vector<TracedCall>> calls_ = std::vector<TracedCall>{};
  std::optional<Answer> held_;
};

template <class Archive>
void visit(Archive& archive, TracedCall& c) {
  std::vector<std::uint8_t> stages;
  for (const Stage stage : kAllStages) stages.push_back(c.request.records.has(stage));
  visit_all(archive, c.pass, stages, c.request.primitives);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (stages[i] != 0) c.request.records.add(kAllStages.at(i));
  }
  c.request.pixels.resize(archive.count(c.request.pixels));
  for (glm::ivec2& pixel : c.request.pixels) visit_all(archive, pixel.x, pixel.y);
  visit_all(archive, c.request.memory_budget, c.request.planes, c.request.painter, c.answer.high, c.answer.low,
            c.info.high, c.info.low);
}

}  // namespace plumbline::check
