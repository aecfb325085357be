#include "check/golden/golden.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "check/compare/compare_bits.h"
#include "check/verdict/votes.h"

namespace plumbline::check {

namespace {

std::string word(const std::optional<Hash>& hash) { return hash ? to_string(*hash).substr(0, 16) : "nothing"; }

std::string hashes_at(const GoldenDifference& d, Stage stage) {
  const auto i = static_cast<std::size_t>(stage);
  return fmt::format("hash {}, the golden {}", word(d.drawn.stages[i]), word(d.golden.stages[i]));
}

}  // namespace

GoldenDifference compare_golden(const Scene& scene, Renderer& candidate, const GoldenSet& goldens) {
  GoldenDifference out;
  try {
    out.drawn = fingerprint(scene, candidate);
  } catch (const std::exception& error) {
    out.why = fmt::format("{} failed: {}", candidate.info().name, error.what());
    return out;
  }
  const auto golden = goldens.manifest().scenes.find(scene.name);
  if (golden == goldens.manifest().scenes.end()) {
    out.why = "it has no golden: scripts/regenerate_goldens makes one";
    return out;
  }
  try {
    out.golden = goldens.load(scene.name, scene.frame);
  } catch (const std::runtime_error& error) {
    out.why = error.what();
  }
  if (golden->second.scene != scene_hash(scene)) out.why = "the scene changed since its golden was made";
  if (out.golden.color.empty()) return out;
  for (const Stage stage : kAllStages) {
    const auto i = static_cast<std::size_t>(stage);
    if (out.golden.stages[i] != out.drawn.stages[i]) out.stages.push_back(stage);
  }
  out.color = compare_color_bits(out.drawn.color, out.golden.color, scene.frame.color);
  out.depth = compare_depth_bits(out.drawn.depth, out.golden.depth, scene.frame.depth);
  return out;
}

std::string describe(const GoldenDifference& d) {
  if (!d.why.empty()) return fmt::format("  {}\n", d.why);
  std::string out;
  if (d.stages.empty()) {
    const bool picture = d.color.differing + d.depth.differing > 0;
    out +=
        fmt::format("  every stage's hash is the golden's{}\n",
                    picture ? ": the picture, drawn with nothing watched, differs from what its stages come to" : "");
  } else {
    std::vector<std::string_view> later;
    for (const Stage stage : std::span(d.stages).subspan(1)) later.push_back(name_of(stage));
    out += fmt::format("  first stage that differs: {} ({}){}\n", name_of(d.stages[0]), hashes_at(d, d.stages[0]),
                       later.empty() ? "" : fmt::format("; then {}", fmt::join(later, ", ")));
  }
  for (const auto& [what, m] : {std::pair("colour", &d.color), std::pair("depth", &d.depth)}) {
    if (m->differing == 0) {
      out += fmt::format("  {}: no pixel differs\n", what);
    } else if (!m->mismatch.empty()) {
      out += fmt::format("  {}: {}\n", what, m->mismatch);
    } else {
      out +=
          fmt::format("  {}: {} of {} pixels differ, the worst at {}: {:.9g}, the golden {:.9g}, {:.4g} of {} apart\n",
                      what, m->differing, m->items, to_string(m->worst.place), m->worst.candidate, m->worst.reference,
                      m->worst.difference, m->unit);
    }
  }
  return out;
}

std::vector<Comparison> golden_rows(const Scene& scene, Renderer& candidate, const GoldenSet& goldens) {
  const JudgeId name("golden", Kind::golden);
  const GoldenDifference d = compare_golden(scene, candidate, goldens);
  if (!d.why.empty()) return {not_judged(scene.name, name, Stage::merge, Outcome::failed, d.why)};
  const Stage last = d.drawn.stages.back() ? Stage::resolve : Stage::merge;
  std::vector<Comparison> out;
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (!d.drawn.stages[i] && !d.golden.stages[i]) continue;
    const bool differs = std::ranges::count(d.stages, stage) > 0;
    Measurement m;
    if (stage == last) {
      m = d.color.differing > 0 || d.depth.differing == 0 ? d.color : d.depth;
    } else {
      m.items = 1;
      m.unit = "bits";
    }
    if (differs && m.differing == 0) {
      m.differing = 1;
      m.max_difference = m.max_ratio = HUGE_VAL;
    }
    out.push_back(judged(scene.name, name, stage, std::move(m), nullptr, differs ? hashes_at(d, stage) : ""));
  }
  return out;
}

Vouch vouch(const SceneVerdict& verdict, const std::string& candidate, std::span<const std::string> asked) {
  Vouch out;
  const std::set<std::string> names(asked.begin(), asked.end());
  if (names.contains(candidate)) out.refusals.push_back(fmt::format("{} cannot vouch for itself", candidate));
  if (names.size() < 3)
    out.refusals.push_back(fmt::format("expected three references or more, found {}", names.size()));
  std::map<std::string, std::map<Outcome, std::set<Stage>>> rows;
  std::set<Stage> judged, agreed;
  std::set<std::string> against;
  for (const Comparison& c : verdict.comparisons) {
    rows[title_of(c.judge)][c.outcome].insert(c.stage);
    const std::string& reference = c.judge.reference;
    if (is_failure(c.outcome)) {
      const std::string more = remark(c);
      against.insert(reference);
      out.refusals.push_back(fmt::format("{}, {}: {}{}{}", title_of(c.judge), name_of(c.stage), name_of(c.outcome),
                                         more.empty() ? "" : ": ", more));
    } else if (!votes(c)) {
      continue;
    } else if (reference == candidate) {
      out.refusals.push_back(fmt::format("{} cannot vouch for itself", candidate));
    } else if (c.outcome == Outcome::dispute) {
      out.disputed.push_back(fmt::format("{}, {}: {} of {}: {}", title_of(c.judge), name_of(c.stage),
                                         c.measurement.disputed, c.measurement.items, c.measurement.reason));
      judged.insert(c.stage);
    } else if (holds(c.outcome)) {
      judged.insert(c.stage);
      agreed.insert(c.stage);
      if (std::ranges::count(out.by, reference) == 0) out.by.push_back(reference);
    }
  }
  std::erase_if(out.by, [&](const std::string& reference) { return against.contains(reference); });
  for (const Stage stage : unjudged_stages(verdict)) {
    out.refusals.push_back(fmt::format("{}: nobody judges it", name_of(stage)));
  }
  for (const Stage stage : judged) {
    if (!agreed.contains(stage))
      out.refusals.push_back(fmt::format("{}: nobody agrees, all is disputed", name_of(stage)));
  }
  for (const auto& [reference, outcomes] : rows) {
    for (const auto& [outcome, stages] : outcomes) {
      std::vector<std::string_view> of_stages;
      for (const Stage stage : stages) of_stages.push_back(name_of(stage));
      out.references[reference][std::string(name_of(outcome))] = fmt::format("{}", fmt::join(of_stages, " "));
    }
  }
  return out;
}

}  // namespace plumbline::check
