#include "capture/renderer.h"

#include <algorithm>

#include <fmt/format.h>

#include "capture/capture_columns.h"
#include "scene/antialias.h"

namespace plumbline {

Capture Renderer::run_stage(const Scene&, Stage stage, const Capture&, const Conventions&) {
  throw Unsupported(fmt::format("{} cannot run stage {} alone", info().name, name_of(stage)));
}

std::vector<Stage> stages_of(const Scene& scene, Stage first, Stage last) {
  std::vector<Stage> out;
  for (const Stage stage : kAllStages) {
    if (stage >= first && stage <= last && has_stage(scene, stage)) out.push_back(stage);
  }
  return out;
}

bool is_referee(const RendererInfo& info) {
  return info.profile == Profile::exact && std::ranges::any_of(info.stages, &Ability::runs);
}

void require_samples(const Scene& scene, const std::vector<Plane<glm::vec4>>& samples) {
  const Antialias& antialias = scene.frame.antialias;
  const int w = scene.frame.width * antialias.factor, h = scene.frame.height * antialias.factor;
  bool fit = samples.size() == samples_of(antialias).back().pass + 1;
  for (const Plane<glm::vec4>& color : samples) fit = fit && color.width() == w && color.height() == h;
  if (!fit) throw std::invalid_argument("samples are not those of the scene's passes");
}

std::size_t plane_bytes(const Scene& scene) {
  constexpr std::size_t kPixel =
      sizeof(std::uint32_t) + sizeof(std::uint64_t) + sizeof(std::int32_t) + 2 * sizeof(glm::vec4) + sizeof(double);
  // Blended colours have bounds, and a reference that folds them holds what is written and what is stored, as
  // intervals.
  constexpr std::size_t kBlended = 2 * sizeof(glm::vec4) + 18 * sizeof(double);
  const std::size_t pixel = kPixel + (colors_replace(scene) ? 0 : kBlended) +
                            (textured(scene) ? sizeof(glm::vec4) : 0) +
                            (scene.frame.stencil == StencilFormat::none ? 0 : 1);
  const Antialias& antialias = scene.frame.antialias;
  // One pass at a time, and the colours of all.
  const std::size_t samples = samples_of(antialias).size(), larger = static_cast<std::size_t>(antialias.factor);
  const std::size_t sampled = antialias.kind == Antialias::Kind::none ? 0 : (samples + 1) * sizeof(glm::vec4);
  return static_cast<std::size_t>(scene.frame.width) * static_cast<std::size_t>(scene.frame.height) *
         (larger * larger * pixel + sampled);
}

namespace {

struct FragmentBytes {
  const Scene& scene;
  StageSet stages;
  std::size_t bytes = 0;

  template <class Record>
  void group(Handed group, const auto&, const std::vector<Record>&) {
    const auto has = [&](Varying v) { return !is_back(v) && std::ranges::count(carried(scene), v) > 0; };
    if (group.per != Per::fragment || !stages.has(group.stage) || !has_stage(scene, group.stage)) return;
    if (!group.varying || has(*group.varying)) bytes += sizeof(Record);
  }
  void plane(Handed, const auto&) const {}
};

}  // namespace

std::size_t fragment_bytes(const Scene& scene, StageSet stages) {
  FragmentBytes out{scene, stages};
  const Capture none;
  visit_capture(out, none);
  return out.bytes;
}

void require_budget(const Scene& scene, std::size_t bytes, std::size_t budget) {
  if (bytes <= budget) return;
  throw OverBudget(fmt::format(
      "{}: at \"/frame\": expected a capture that takes at most {} MiB, found {} MiB for its {} x {} pixels and "
      "records",
      scene.path.empty() ? scene.name : scene.path, budget >> 20, bytes >> 20, scene.frame.width, scene.frame.height));
}

}  // namespace plumbline
