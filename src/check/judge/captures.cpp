#include "check/judge/captures.h"

#include <algorithm>
#include <exception>
#include <numeric>

#include "check/judge/stage_copy.h"

namespace plumbline::check {

namespace {

Capture capture_reference(const Scene& scene, Renderer& renderer, bool legal, const Conventions& conventions) {
  const RendererInfo info = renderer.info();
  Request request{.records = kGeometryStages, .legal = legal && info.legal, .conventions = conventions};
  if (may_draw(scene, Topology::lines)) request.records.add(Stage::coverage);  // for compare_covered_lines()
  if (is_referee(info) || (info.legal && !legal)) request.planes = WantedPlanes::none;
  try {
    return renderer.capture(scene, request);
  } catch (const OverBudget&) {
    request.legal = false;
    if (info.legal) request.planes = WantedPlanes::none;
    return renderer.capture(scene, request);
  }
}

}  // namespace

bool more_than(std::uint64_t most_fragments, const Capture& capture) {
  const auto& count = capture.planes.count.values();
  return std::accumulate(count.begin(), count.end(), std::uint64_t{0}) > most_fragments;
}

Capture capture_all(const Scene& scene, Renderer& candidate, std::uint64_t most_fragments) {
  try {
    // A foreign candidate hands out all that it shows at once.
    if (most_fragments != ~std::uint64_t{0} && candidate.info().profile != Profile::foreign) {
      Capture counted = candidate.capture(scene, {.records = kGeometryStages});
      if (more_than(most_fragments, counted)) return counted;
    }
    return candidate.capture(scene, {.records = StageSet::all()});
  } catch (const OverBudget&) {
    return candidate.capture(scene, {.records = kGeometryStages});
  }
}

ReferenceCaptures capture_references(const Scene& scene, std::span<const Reference> references, bool legal,
                                     const Conventions& conventions) {
  ReferenceCaptures out{std::vector<Capture>(references.size()), {}};
  for (std::size_t i = 0; i < references.size(); ++i) {
    Renderer* const renderer = references[i].renderer;
    out.refusals.push_back(renderer == nullptr ? Refusal{Outcome::missing, "not built in"} : refusal_of([&] {
      out.captures[i] = capture_reference(scene, *renderer, legal, conventions);
    }));
  }
  return out;
}

Legal legal_where_apart(const Scene& scene, const Capture& mine, std::span<const Capture> theirs, Renderer& oracle,
                        const Conventions& conventions) {
  Request request{.legal = true, .planes = WantedPlanes::none, .conventions = conventions};
  const auto differ = [](const auto& a, const auto& b, int x, int y) {
    return a.width() == b.width() && a.height() == b.height() && !a.empty() && a(x, y) != b(x, y);
  };
  const Planes& p = mine.planes;
  const auto apart = [&](int x, int y) {
    return std::ranges::any_of(theirs, [&](const Capture& c) {
      const Planes& q = c.planes;
      return differ(p.id, q.id, x, y) || differ(p.count, q.count, x, y) || differ(p.id_sum, q.id_sum, x, y);
    });
  };
  for (int y = 0; y < scene.frame.height; ++y) {
    for (int x = 0; x < scene.frame.width; ++x) {
      if (apart(x, y)) request.pixels.emplace_back(x, y);
    }
  }
  if (request.pixels.empty()) return {};
  try {
    return oracle.capture(scene, request).legal;
  } catch (const std::exception&) {  // the oracle failed: no legal answers
    return {};
  }
}

Capture run_alone(const Scene& scene, Renderer& candidate, RendererInfo& shown) {
  Capture out;
  for (std::size_t i = 0; i < shown.stages.size() && shown.stages[i].shows; ++i) {
    try {
      copy_stage(static_cast<Stage>(i), candidate.run_stage(scene, static_cast<Stage>(i), out), out);
    } catch (const std::exception& e) {
      for (Ability& later : std::span(shown.stages).subspan(i)) later = {false, false, e.what()};
    }
  }
  return out;
}

std::optional<FailingStage> failing_stage(const Scene& scene, Renderer& candidate, Renderer& referee) {
  const RendererInfo info = candidate.info();
  Capture in;
  in.width = scene.frame.width;
  in.height = scene.frame.height;
  for (const Stage stage : stages_of(scene)) {
    try {
      if (info[stage].runs) candidate.run_stage(scene, stage, in);
    } catch (const Unsupported&) {  // no failure
    } catch (const std::exception& e) {
      return FailingStage{stage, e.what()};
    }
    try {
      copy_stage(stage, referee.run_stage(scene, stage, in), in);
    } catch (const std::exception&) {
      return std::nullopt;
    }
    round_to_formats(scene, stage, in);
  }
  return std::nullopt;
}

}  // namespace plumbline::check
