#include "stages/watched_renderer.h"

#include <new>
#include <utility>

namespace plumbline {

namespace {

constexpr std::uint32_t kSteps = kStageNames.size() + 2;  // of one renderer: the stages, and two ways of drawing

class WatchedRenderer : public Renderer {
 public:
  WatchedRenderer(std::unique_ptr<Renderer> inner, std::uint32_t number, const Watch& watch)
      : inner_(std::move(inner)), first_(number * kSteps + 1), watch_(watch) {}

  RendererInfo info() const override { return inner_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    const bool picture = request.planes == WantedPlanes::picture && !request.records.any();
    const std::uint32_t step = picture ? kSteps - 1 : kSteps - 2;
    return in_step(step, [&] { return inner_->capture(scene, request); });
  }
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in) override {
    return in_step(static_cast<std::uint32_t>(stage), [&] { return inner_->run_stage(scene, stage, in); });
  }

 private:
  template <class Work>
  Capture in_step(std::uint32_t step, const Work& work) {
    if (const auto found = watch_.ended->find(first_ + step); found != watch_.ended->end()) {
      throw RendererFailed(found->second);
    }
    const struct Step {
      Step(const Watch& watch, std::uint32_t number) : of(watch) { of.progress->begin(number, of.limit); }
      ~Step() { of.progress->end(of.limit); }
      const Watch& of;
    } here(watch_, first_ + step);
    try {
      return work();
    } catch (const std::bad_alloc&) {
      throw RendererFailed("took more memory than a worker may have");
    }
  }

  std::unique_ptr<Renderer> inner_;
  std::uint32_t first_;
  Watch watch_;
};

}  // namespace

std::unique_ptr<Renderer> make_watched(std::unique_ptr<Renderer> inner, std::uint32_t number, const Watch& watch) {
  if (!inner) return nullptr;
  return std::make_unique<WatchedRenderer>(std::move(inner), number, watch);
}

}  // namespace plumbline
