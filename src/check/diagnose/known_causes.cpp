#include "check/diagnose/known_causes.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "check/compare/compare_records.h"
#include "check/judge/judge_passes.h"
#include "check/judge/rows.h"
#include "check/judge/run_by_conventions.h"

namespace plumbline::check {

namespace {

// How many records of the candidate's stage differ from what was made.
std::uint64_t differing(const Evidence& e, const Capture& made) {
  if (e.stage == Stage::matrices) {
    const double factor = tolerance(Profile::exact, e.stage).factor;
    return compare_matrices(e.candidate.records, made.records, factor).differing +
           compare_lights(e.scene, e.candidate.records, made.records, factor).differing;
  }
  if (e.stage == Stage::resolve) {
    return compare_resolved(e.scene, e.candidate, made, tolerance(Profile::exact, e.stage).factor).differing;
  }
  std::vector<Comparison> rows;
  const Legal none;
  const SceneJudgement c{.scene = e.scene,
                         .candidate = e.candidate,
                         .legal = none,
                         .referee = nullptr,
                         .rows = rows,
                         .foreign = e.foreign,
                         .conventions = e.conventions};
  compare_stage(c, made, e.stage, "");
  return rows.empty() ? 0 : rows.back().measurement.differing;
}

// Whether a stage that hands on fewer records than it takes in has handed on none.
bool is_empty(const Capture& made, Stage stage) {
  switch (stage) {
    case Stage::clip: return made.records.polygons.polygons.empty();
    case Stage::window: return made.records.triangles.empty();
    case Stage::coverage: return made.records.covered.empty();
    default: return false;
  }
}

struct Tried {
  std::uint64_t left;  // records that the cause leaves unexplained
  bool is_empty;       // the cause leaves no record
  Cause cause;
};

}  // namespace

Capture made_with(const KnownCause& cause, const Scene& scene, const Capture& in, Renderer& renderer,
                  const Conventions& conventions) {
  Capture made;
  if (cause.before != nullptr) {
    Scene wrong = scene;
    Capture changed = in;
    cause.before(wrong, changed);
    made = run_by_conventions(renderer, wrong, cause.stage, changed, conventions);
  } else {
    made = run_by_conventions(renderer, scene, cause.stage, in, conventions);
  }
  if (cause.after != nullptr) cause.after(scene, in, made);
  return made;
}

std::vector<KnownCause> all_causes() {
  std::vector<KnownCause> out;
  for (const auto& list : {geometry_causes(), raster_causes(), fragment_causes()})
    out.insert(out.end(), list.begin(), list.end());
  return out;
}

std::vector<Cause> likely_causes(const Evidence& e) {
  std::vector<Cause> out;
  std::vector<Tried> tried;
  if (e.referee == nullptr) return out;
  const std::uint64_t all = differing(e, e.expected);
  if (all == 0) return out;
  for (const KnownCause& cause : all_causes()) {
    if (cause.stage != e.stage) continue;
    try {
      if (cause.shows != nullptr) {
        if (cause.shows(e)) out.push_back({cause.name, std::string(cause.words)});
        continue;
      }
      const Capture made = made_with(cause, e.scene, e.candidate, *e.referee, e.conventions);
      const std::uint64_t left = differing(e, made);
      if (left > all / 50) continue;
      tried.push_back(
          {left,
           is_empty(made, e.stage),
           {cause.name, std::string(cause.words), fmt::format(" (explains {} of {} that differ)", all - left, all)}});
    } catch (const std::exception&) {  // the referee refuses the altered records: not this cause
    }
  }
  std::uint64_t least = all;
  for (const Tried& t : tried) least = std::min(least, t.left);
  std::erase_if(tried, [=](const Tried& t) { return t.left > least; });
  if (tried.size() > 1 && std::ranges::all_of(tried, &Tried::is_empty)) {
    out.push_back({"nothing_left", "it leaves nothing, as several mistakes would"});
    return out;
  }
  for (Tried& t : tried) out.push_back(std::move(t.cause));
  return out;
}

}  // namespace plumbline::check
