#include "renderers/pipeline_renderer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "painter/painter.h"
#include "renderers/run_stage.h"

namespace plumbline::pipeline {

namespace {

// Finished frame of `color`, of its size; depth and stencil are the clear values.
Frame frame_of_colors(const FrameFormat& format, const Plane<glm::vec4>& color) {
  FrameFormat of_pass = format;
  of_pass.width = color.width();
  of_pass.height = color.height();
  FrameBuffer buffer(of_pass);
  const auto scale = static_cast<float>(color_scale(format.color));
  for (std::size_t i = 0; i < color.size(); ++i) {
    buffer.color.values()[i] = scale == 0.0f ? color.values()[i] : glm::round(color.values()[i] * scale);
  }
  return finished(of_pass, buffer);
}

class PipelineRenderer : public Renderer {
 public:
  PipelineRenderer(std::string name, const Stages& stages, bool paints)
      : name_(std::move(name)), stages_(stages), paints_(paints) {}

  RendererInfo info() const override {
    RendererInfo info{.name = name_, .version = PLUMBLINE_VERSION, .stages = {}, .profile = Profile::dialect};
    info.conventions.tie_rule = Conventions::TieRule::left_bottom;
    for (Ability& ability : info.stages) ability = {true, true, ""};
    if (!paints_) return info;
    for (const SimdTarget& target : simd_targets()) info.painters.emplace_back(target.name);
    return info;
  }

  Capture capture(const Scene& scene, const Request& request) override {
    require_budget(scene, plane_bytes(scene), request.memory_budget);
    Capture out = empty_capture(scene);
    if (request.planes == WantedPlanes::picture && !request.records.any()) {
      copy_planes(picture(scene, request.painter), scene.frame, out.planes);
      return out;
    }
    if (antialiased(scene)) {
      const std::vector<Frame> passes = render_passes(scene, stages_);
      copy_planes(resolve(stages_.resolve, scene.frame, passes), scene.frame, out.planes);
      for (const Frame& pass : passes) {
        Planes of_pass;
        copy_planes(pass, scene.frame, of_pass);
        out.samples.push_back(std::move(of_pass.color));
      }
      return out;
    }
    const Frame frame = render(scene, stages_, {scene, request, plane_bytes(scene), out});
    copy_planes(frame, scene.frame, out.planes);
    return out;
  }

  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& by) override {
    if (!info()[stage].runs) return Renderer::run_stage(scene, stage, in, by);
    if (stage == Stage::resolve) return resolved(scene, in.samples);
    Capture out = empty_capture(scene);
    pipeline::run_stage(scene, stage, stages_, in, out);
    return out;
  }

 private:
  Capture empty_capture(const Scene& scene) const {
    Capture out;
    out.renderer = name_;
    out.version = PLUMBLINE_VERSION;
    out.width = scene.frame.width;
    out.height = scene.frame.height;
    return out;
  }

  Capture resolved(const Scene& scene, const std::vector<Plane<glm::vec4>>& samples) {
    require_samples(scene, samples);
    std::vector<Frame> passes;
    for (const Plane<glm::vec4>& color : samples) passes.push_back(frame_of_colors(scene.frame, color));
    Capture made, out = empty_capture(scene);
    copy_planes(resolve(stages_.resolve, scene.frame, passes), scene.frame, made.planes);
    out.planes.color = std::move(made.planes.color);
    return out;
  }

  Frame picture(const Scene& scene, std::string_view painter) const {
    if (!paints_) return render(scene, stages_);
    const auto targets = simd_targets();
    const auto target =
        painter.empty() ? std::prev(targets.end()) : std::ranges::find(targets, painter, &SimdTarget::name);
    if (target == targets.end()) throw std::invalid_argument(fmt::format("no painter is named {}", painter));
    return std::move(Painter(1, *target).draw(scene));
  }

  std::string name_;
  Stages stages_;
  bool paints_;  // pictures are the painter's
};

}  // namespace

std::unique_ptr<Renderer> make_pipeline() {
  return std::make_unique<PipelineRenderer>("ours", production_stages(), true);
}

std::unique_ptr<Renderer> make_definition() {
  return std::make_unique<PipelineRenderer>("definition", production_stages(), false);
}

std::unique_ptr<Renderer> make_pipeline(const Stages& stages) {
  return std::make_unique<PipelineRenderer>("ours", stages, false);
}

}  // namespace plumbline::pipeline
