#include "capture/renderers/watched_renderer.h"

#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace plumbline {

namespace {

// The steps of one renderer: the stages, and these.
constexpr std::uint32_t kDraw = kStageNames.size(), kPaint = kDraw + 1, kMake = kDraw + 2, kSteps = kDraw + 3;

constexpr std::uint32_t number_of_step(std::uint32_t renderer, std::uint32_t step) {
  return renderer * kSteps + 1 + step;
}

// Throws RendererFailed with the words of the step's end before, and where memory is lacking.
template <class Work>
auto in_step(const Watch& watch, std::uint32_t number, const Work& work) {
  if (const auto found = watch.ended->find(number); found != watch.ended->end()) throw RendererFailed(found->second);
  const struct Step {
    Step(const Watch& watch, std::uint32_t number) : of(watch) { of.progress->begin(number, of.limit); }
    ~Step() { of.progress->end(of.limit); }
    const Watch& of;
  } here(watch, number);
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw RendererFailed("took more memory than a worker may have");
  }
}

class WatchedRenderer : public Renderer {
 public:
  WatchedRenderer(std::unique_ptr<Renderer> inner, std::uint32_t number, const Watch& watch)
      : inner_(std::move(inner)), number_(number), watch_(watch) {}

  RendererInfo info() const override { return inner_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    const bool picture = request.planes == WantedPlanes::picture && !request.records.any();
    return in_step(watch_, number_of_step(number_, picture ? kPaint : kDraw),
                   [&] { return inner_->capture(scene, request); });
  }
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions) override {
    const std::uint32_t step = number_of_step(number_, static_cast<std::uint32_t>(stage));
    return in_step(watch_, step, [&] { return inner_->run_stage(scene, stage, in, conventions); });
  }

 private:
  std::unique_ptr<Renderer> inner_;
  std::uint32_t number_;
  Watch watch_;
};

// A renderer that could not be made.
class NotMade : public Renderer {
 public:
  NotMade(const std::string& name, const std::string& why) : why_(why) {
    info_.name = name;
    info_.version = "not started: " + why;
    for (Ability& stage : info_.stages) stage.reason = why;
  }
  RendererInfo info() const override { return info_; }
  Capture capture(const Scene&, const Request&) override { throw RendererFailed(why_); }

 private:
  RendererInfo info_;
  std::string why_;
};

}  // namespace

std::unique_ptr<Renderer> make_watched(const std::string& name, const std::function<std::unique_ptr<Renderer>()>& make,
                                       std::uint32_t number, const Watch& watch) {
  try {
    return make_watched(in_step(watch, number_of_step(number, kMake), make), number, watch);
  } catch (const std::runtime_error& e) {
    return std::make_unique<NotMade>(name, fmt::format("{}: while it was made", e.what()));
  }
}

std::unique_ptr<Renderer> make_watched(std::unique_ptr<Renderer> inner, std::uint32_t number, const Watch& watch) {
  if (!inner) return nullptr;
  return std::make_unique<WatchedRenderer>(std::move(inner), number, watch);
}

}  // namespace plumbline
