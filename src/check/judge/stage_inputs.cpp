#include "check/judge/stage_inputs.h"

#include <fmt/format.h>

#include "check/bounds/open_pixels.h"

namespace plumbline::check {

bool has_plane(const Planes& planes, Stage stage) {
  switch (stage) {
    case Stage::coverage: return !planes.count.empty();
    case Stage::depth: return !planes.depth.empty();
    case Stage::visibility: return !planes.id.empty() || !planes.stencil.empty();
    case Stage::merge: return !planes.color.empty();
    default: return !planes.shaded.empty();
  }
}

namespace {

// The first of `inputs` whose records the candidate does not show, with the reason; empty: it shows all.
std::string lacking_records(const Scene& scene, const RendererInfo& candidate, StageSet inputs) {
  for (const Stage stage : stages_of(scene)) {
    if (!inputs.has(stage) || candidate[stage].given) continue;
    if (!candidate[stage].shows) return fmt::format("{}: {}", name_of(stage), candidate[stage].reason);
    if (candidate[stage].planes_alone) return fmt::format("{}: it shows planes, no records", name_of(stage));
  }
  return "";
}

}  // namespace

std::string lacking_beside(const Scene& scene, const Planes& planes, const RendererInfo& candidate, Stage stage) {
  if (stage == Stage::coverage && planes.id_sum.empty()) return "it shows counts of fragments alone";
  if (stage == Stage::visibility && planes.id.empty()) return "it shows no winners";
  if (stage == Stage::visibility && draws_lines_or_points(scene)) {
    if (planes.count.empty() || planes.id_sum.empty()) return "of lines and points, it shows no count or id_sum";
    return lacking_records(scene, candidate, {Stage::coverage, Stage::depth});
  }
  if (stage == Stage::coverage || stage == Stage::visibility) return "";
  if (stage > Stage::coverage && stage != Stage::texture && !has_plane(planes, stage))
    return fmt::format("it shows no {}", stage == Stage::depth   ? "planes.depth"
                                         : stage == Stage::merge ? "planes.color"
                                                                 : "planes.shaded");
  StageSet inputs = inputs_of(stage);
  if (stage > Stage::coverage) {
    if (planes.id.empty()) return "visibility: it shows no winners";
    for (const Stage each : kAllStages) {
      if (kGeometryStages.has(each)) inputs.add(each);
    }
  }
  return lacking_records(scene, candidate, inputs);
}

std::string lacking_per_stage(const Scene& scene, const RendererInfo& candidate, Stage stage) {
  const bool has_planes = stage == Stage::coverage || stage >= Stage::visibility;
  if (!candidate[stage].shows) return candidate[stage].reason;
  if (candidate[stage].planes_alone && !has_planes) return "it shows planes, no records";
  StageSet inputs = inputs_of(stage);
  if (stage == Stage::visibility && !tests_alpha(scene)) inputs = {Stage::window, Stage::coverage, Stage::depth};
  return lacking_records(scene, candidate, inputs);
}

}  // namespace plumbline::check
