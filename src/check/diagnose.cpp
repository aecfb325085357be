#include "check/diagnose.h"

#include <algorithm>
#include <set>
#include <utility>

#include "check/case.h"
#include "check/causes.h"
#include "check/coverage_differences.h"
#include "check/judge_passes.h"
#include "check/repair.h"
#include "check/worst_record.h"
#include "scene/antialias.h"

namespace plumbline::check {

namespace {

Renderer* referee_of(std::span<const Reference> references) {
  for (const Reference& r : references) {
    if (r.renderer != nullptr && r.renderer->info()[Stage::vertex].runs) return r.renderer;
  }
  return nullptr;
}

bool is_wrong(const Comparison& c) { return c.outcome == Outcome::different || c.outcome == Outcome::failed; }

// Whether the row judges its stage by itself.
bool judges_alone(const Comparison& c) {
  return c.reference.ends_with("from its records") || c.reference.ends_with(kRepaired) ||
         (c.stage == Stage::matrices && c.reference.ends_with("from scene"));
}

Finding finding_of(const Evidence& evidence, const Comparison& row) {
  Finding out{row.stage, row.reference, row.measurement, worst_record(evidence, row.measurement), {}, ""};
  if (row.outcome == Outcome::failed) out.numbers = {row.note};
  for (const Cause& cause : likely_causes(evidence)) out.causes.push_back(cause.words);
  if (row.stage != Stage::coverage) return out;
  if (const auto worst = worst_triangle(evidence)) out.picture = coverage_picture(*worst);
  return out;
}

// One scene of one sample a pixel.
struct Pass {
  SceneVerdict verdict;
  std::vector<Finding> findings;  // of the stages that are wrong by themselves
  Capture repaired;               // what the candidate would have handed on, were its wrong stages right
};

// What exact makes of the records before the stage; nothing where they do not fit.
Capture run_or_nothing(const Scene& scene, Renderer& renderer, Stage stage, const Capture& in) {
  try {
    return renderer.run_stage(scene, stage, in);
  } catch (const std::exception&) {
    return {};
  }
}

void find(Pass& pass, const Scene& scene, Renderer& referee, const Capture& mine, const Comparison& row) {
  const Capture expected = run_or_nothing(scene, referee, row.stage, mine);
  pass.findings.push_back(finding_of({scene, row.stage, mine, expected, &referee}, row));
}

// From the first wrong stage on, each stage on records that are right.
void repair(Pass& pass, const Scene& scene, Renderer& candidate, Renderer& referee, const std::set<Stage>& known) {
  Capture& in = pass.repaired;
  const RendererInfo info = candidate.info(), referee_info = referee.info();
  for (auto i = static_cast<std::size_t>(*known.begin()); i <= static_cast<std::size_t>(Stage::merge); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::texture && !textured(scene)) continue;
    if (stage >= Stage::coverage && over_budget(in)) return;
    if (!info[stage].runs || !referee_info[stage].runs) return;
    bool wrong = known.contains(stage);
    if (!wrong) {
      const std::string name = referee_info.name + " " + std::string(kRepaired);
      std::vector<Comparison> rows;
      const Legal none;
      Case c{scene, in, none, &referee, rows};
      try {
        hand_on(stage, candidate.run_stage(scene, stage, in), in);
        graft(c, referee, stage, name);
      } catch (const std::exception& e) {
        c.skip(name, stage, Outcome::failed, e.what());
      }
      wrong = is_wrong(rows.back());
      if (wrong) find(pass, scene, referee, in, rows.back());
      pass.verdict.comparisons.push_back(std::move(rows.back()));
    }
    if (!wrong) continue;
    hand_on(stage, {}, in);  // exact takes levels of detail from texels that are there
    hand_on(stage, referee.run_stage(scene, stage, in), in);
    round_to_formats(scene, stage, in);
  }
}

Pass look_at(const Scene& scene, Renderer& candidate, std::span<const Reference> references) {
  Drawn drawn;
  Pass pass{judge(scene, candidate, references, &drawn), {}, {}};
  pass.repaired = std::move(drawn.candidate);
  Renderer* referee = referee_of(references);
  if (referee == nullptr || pass.repaired.width == 0) return pass;
  std::set<Stage> wrong;
  for (const Comparison& c : pass.verdict.comparisons) {
    if (!judges_alone(c) || !is_wrong(c) || !wrong.insert(c.stage).second) continue;
    find(pass, scene, *referee, pass.repaired, c);
  }
  if (wrong.empty()) return pass;
  try {
    repair(pass, scene, candidate, *referee, wrong);
  } catch (const std::exception&) {  // exact cannot go on; what was found stands
  }
  return pass;
}

// Resolve on the passes' repaired colours.
void judge_repaired_samples(const Scene& scene, std::span<const Pass> passes, Renderer& candidate, Renderer& referee,
                            Diagnosis& out) {
  if (!candidate.info()[Stage::resolve].runs) return;
  Capture in;
  for (const Pass& pass : passes) in.samples.push_back(pass.repaired.planes.color);
  const std::string name = referee.info().name + " " + std::string(kRepaired);
  try {
    hand_on(Stage::resolve, candidate.run_stage(scene, Stage::resolve, in), in);
    const Capture made = referee.run_stage(scene, Stage::resolve, in);
    out.verdict.comparisons.push_back(judged(scene.name, name, Stage::resolve,
                                             compare_resolved(scene, in, made, tolerance("exact.resolve").factor),
                                             "exact.resolve"));
    if (is_wrong(out.verdict.comparisons.back()))
      out.findings.push_back(finding_of({scene, Stage::resolve, in, made, &referee}, out.verdict.comparisons.back()));
  } catch (const std::exception& e) {
    out.verdict.comparisons.push_back(not_judged(scene.name, name, Stage::resolve, Outcome::failed, e.what()));
  }
}

bool tells_more(const Finding& a, const Finding& b) {
  const Measurement &m = a.measurement, &n = b.measurement;
  return m.differing != n.differing ? m.differing > n.differing : m.max_ratio > n.max_ratio;
}

// One for each stage, the worst.
std::vector<Finding> worst_of_each(std::vector<Finding> all) {
  std::vector<Finding> out;
  for (Finding& f : all) {
    const auto known = std::ranges::find(out, f.stage, &Finding::stage);
    if (known == out.end()) {
      out.push_back(std::move(f));
    } else if (tells_more(f, *known)) {
      *known = std::move(f);
    }
  }
  std::ranges::sort(out, {}, &Finding::stage);
  return out;
}

// An antialiased scene's passes, and what is made of them.
Diagnosis diagnose_passes(const Scene& scene, Renderer& candidate, std::span<const Reference> references) {
  Diagnosis out;
  std::vector<Pass> passes;
  std::vector<SceneVerdict> verdicts;
  bool wrong = false;
  for (const Scene& pass : passes_of(scene)) {
    passes.push_back(look_at(pass, candidate, references));
    verdicts.push_back(passes.back().verdict);
    wrong |= !passes.back().findings.empty();
    std::ranges::move(passes.back().findings, std::back_inserter(out.findings));
  }
  Drawn drawn;
  out.verdict = judge_resolved(scene, verdicts, candidate, references, &drawn);
  Renderer* referee = referee_of(references);
  if (referee == nullptr) return out;
  bool resolve_wrong = false;
  for (const Comparison& c : out.verdict.comparisons) {
    if (c.stage != Stage::resolve || !judges_alone(c) || !is_wrong(c)) continue;
    resolve_wrong = true;
    const Capture made = run_or_nothing(scene, *referee, Stage::resolve, drawn.candidate);
    out.findings.push_back(finding_of({scene, Stage::resolve, drawn.candidate, made, referee}, c));
  }
  if (wrong && !resolve_wrong) judge_repaired_samples(scene, passes, candidate, *referee, out);
  return out;
}

}  // namespace

Diagnosis diagnose(const Scene& scene, Renderer& candidate, std::span<const Reference> references) {
  Diagnosis out;
  if (scene.frame.antialias.kind == Antialias::Kind::none) {
    Pass pass = look_at(scene, candidate, references);
    out.verdict = std::move(pass.verdict);
    out.findings = std::move(pass.findings);
  } else {
    out = diagnose_passes(scene, candidate, references);
  }
  out.findings = worst_of_each(std::move(out.findings));
  for (const Finding& f : out.findings) out.wrong.push_back(f.stage);
  if (const Comparison* first = first_different(out.verdict)) {
    out.first = first->stage;
    if (out.wrong.empty()) {
      const Capture none;
      out.findings.push_back(finding_of({scene, first->stage, none, none, nullptr}, *first));
    }
  }
  return out;
}

Capture expected_capture(const Scene& scene, Renderer& referee) {
  Capture out;
  out.renderer = referee.info().name;
  out.width = scene.frame.width;
  out.height = scene.frame.height;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(Stage::merge); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::texture && !textured(scene)) continue;
    hand_on(stage, referee.run_stage(scene, stage, out), out);
    round_to_formats(scene, stage, out);
  }
  return out;
}

}  // namespace plumbline::check
