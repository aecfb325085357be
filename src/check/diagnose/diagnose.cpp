#include "check/diagnose/diagnose.h"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "capture/by_conventions.h"
#include "check/diagnose/causes.h"
#include "check/diagnose/coverage_differences.h"
#include "check/diagnose/effect.h"
#include "check/diagnose/worst_record.h"
#include "check/judge/failing_stage.h"
#include "check/judge/judge_passes.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/scene_case.h"
#include "check/judge/stage_copy.h"
#include "reference/arithmetic/passes.h"

namespace plumbline::check {

namespace {

Renderer* referee_of(std::span<const Reference> references) {
  for (const Reference& r : references) {
    if (r.renderer != nullptr && is_referee(r.renderer->info())) return r.renderer;
  }
  return nullptr;
}

bool is_wrong(const Comparison& c) { return c.outcome == Outcome::different || c.outcome == Outcome::failed; }

// Fills in a finding beyond judge and measurement.
using Explain = void (*)(const Evidence&, Finding&);

void in_full(const Evidence& evidence, Finding& finding) {
  finding.numbers = worst_record(evidence, finding.judge, finding.measurement);
  if (finding.judge.kind != Kind::at_worst && !lacks_fragment_records(evidence.candidate)) {
    finding.explains = pixels_explained(evidence);
  }
  for (const Cause& cause : likely_causes(evidence)) finding.causes.push_back(cause.words);
  if (finding.stage != Stage::coverage || lacks_fragment_records(evidence.candidate) ||
      lacks_fragment_records(evidence.expected))
    return;  // of a side without records of fragments, all would be missing
  if (const auto worst = worst_triangle(evidence, finding.measurement.worst.place))
    finding.picture = coverage_picture(*worst);
}
void in_brief(const Evidence&, Finding&) {}

Finding finding_of(const Comparison& row) { return {row.stage, row.judge, row.measurement, {}, {}, 0, ""}; }

// One scene of one sample a pixel.
struct Pass {
  SceneVerdict verdict;
  std::vector<Finding> findings;  // of the stages that are wrong by themselves
  std::optional<Finding> first;   // or, where there is none, of the first different stage
  Plane<glm::vec4> color;         // the candidate's
  Capture repaired;               // what the candidate would have handed on, were its wrong stages right
};

// What exact makes of the records before the stage; nothing where they do not fit.
Capture run_or_nothing(const Scene& scene, Renderer& renderer, Stage stage, const Capture& in,
                       const Conventions& conventions) {
  try {
    return run_by_conventions(renderer, scene, stage, in, conventions);
  } catch (const std::exception&) {
    return {};
  }
}

bool is_foreign(Renderer& candidate) { return candidate.info().profile == Profile::foreign; }

// Makes findings of wrong rows, with exact's output as the expected one.
struct Finder {
  const Scene& scene;
  Renderer& referee;
  Explain explain;
  Conventions conventions;
  bool foreign;
  Finding operator()(const Capture& mine, const Comparison& row) const {
    Finding out = finding_of(row);
    if (row.outcome == Outcome::failed) {
      out.numbers = {row.note};
    } else if (explain != in_brief) {
      const Capture expected = run_or_nothing(scene, referee, row.stage, mine, conventions);
      explain({scene, row.stage, mine, expected, &referee, conventions, foreign}, out);
    }
    return out;
  }
};

// Adds the rows and findings of Kind::repaired. `known`: stages known to be wrong, not empty.
void repair(Pass& pass, const Finder& find, Renderer& candidate, const std::set<Stage>& known) {
  const Scene& scene = find.scene;
  Renderer& referee = find.referee;
  Capture& in = pass.repaired;
  const RendererInfo info = candidate.info(), referee_info = referee.info();
  const bool fragments_are_here = !lacks_fragment_records(in);
  for (auto i = static_cast<std::size_t>(*known.begin()); i <= static_cast<std::size_t>(Stage::merge); ++i) {
    copy_stage(static_cast<Stage>(i), {}, in);  // made of wrong records
  }
  for (auto i = static_cast<std::size_t>(*known.begin()); i <= static_cast<std::size_t>(Stage::merge); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::texture && !textured(scene)) continue;
    if (stage >= Stage::coverage && !fragments_are_here) return;
    if (!info[stage].runs || !referee_info[stage].runs) return;
    bool wrong = known.contains(stage);
    if (!wrong) {
      const JudgeId name(referee_info.name, Kind::repaired);
      std::vector<Comparison> rows;
      const Legal none;
      Case c{scene, in, none, &referee, rows};
      c.conventions = find.conventions, c.foreign = find.foreign;
      try {
        copy_stage(stage, candidate.run_stage(scene, stage, in), in);
        run_exact_stage(c, referee, stage, name);
      } catch (const OverBudget&) {
        return;
      } catch (const std::exception& e) {
        c.skip(name, stage, Outcome::failed, e.what());
      }
      wrong = is_wrong(rows.back());
      if (wrong) pass.findings.push_back(find(in, rows.back()));
      pass.verdict.comparisons.push_back(std::move(rows.back()));
    }
    if (!wrong) continue;
    copy_stage(stage, {}, in);  // else exact would take over the levels of detail of wrong texels
    copy_stage(stage, referee.run_stage(scene, stage, in), in);
    round_to_formats(scene, stage, in);
  }
}

// A row beside what its reference showed of the stage; nothing where there is no row.
std::optional<Finding> finding_beside(const Comparison* row, const Scene& scene, const Capture& mine,
                                      std::span<const Reference> references, std::span<const Capture> theirs,
                                      Explain explain) {
  if (row == nullptr) return std::nullopt;
  Finding out = finding_of(*row);
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    if (!judges_alone(*row) && row->judge.reference == references[i].name)
      explain({scene, row->stage, mine, theirs[i], nullptr, {}}, out);
  }
  return out;
}

// The worst pixel of each row that differs, and those about it, row by row.
std::vector<glm::ivec2> worst_pixels(const Scene& scene, const SceneVerdict& verdict) {
  std::vector<glm::ivec2> out;
  for (const Comparison& c : verdict.comparisons) {
    const Place& at = c.measurement.worst.place;
    if (c.outcome != Outcome::different || at.x < 0) continue;
    for (int y = std::max(at.y - 2, 0); y <= std::min(at.y + 2, scene.frame.height - 1); ++y) {
      for (int x = std::max(at.x - 2, 0); x <= std::min(at.x + 2, scene.frame.width - 1); ++x) {
        if (std::ranges::find(out, glm::ivec2(x, y)) == out.end()) out.emplace_back(x, y);
      }
    }
  }
  return out;
}

// Judges stages 6 to 9 at worst_pixels() alone, where the scene has too many fragments to judge all of them.
void look_at_worst(Pass& pass, const Finder& find, Renderer& candidate) {
  const std::vector<glm::ivec2> pixels = worst_pixels(find.scene, pass.verdict);
  if (pixels.empty()) return;
  try {
    const Capture mine = candidate.capture(find.scene, {StageSet::all(), false, {}, pixels});
    const JudgeId name(find.referee.info().name, Kind::at_worst);
    const Legal none;
    Case c{find.scene, mine, none, &find.referee, pass.verdict.comparisons};
    c.conventions = find.conventions, c.foreign = find.foreign;
    for (const Stage stage : {Stage::depth, Stage::attributes, Stage::texture, Stage::shade}) {
      if ((stage == Stage::texture && !textured(find.scene)) || lacks_fragment_records(mine)) continue;
      run_exact_stage(c, find.referee, stage, name);
      if (is_wrong(c.out.back())) pass.findings.push_back(find(mine, c.out.back()));
    }
  } catch (const std::exception&) {  // what the planes show stands
  }
}

Pass look_at(const Scene& of_dialect, Renderer& candidate, std::span<const Reference> references,
             std::uint64_t most_fragments, Explain explain) {
  BothCaptures drawn;
  Pass pass{judge(of_dialect, candidate, references, &drawn, most_fragments), {}, {}, {}, {}};
  const Conventions conventions = candidate.info().conventions;
  const bool foreign = is_foreign(candidate);
  const SceneByConventions by_conventions(of_dialect, conventions);
  const Scene& scene = *by_conventions;
  pass.color = drawn.candidate.planes.color;
  pass.repaired = std::move(drawn.candidate);
  Renderer* referee = referee_of(references);
  if (pass.repaired.width == 0) {  // it drew nothing
    for (const Comparison& c : pass.verdict.comparisons) {
      if (judges_alone(c) && is_wrong(c)) pass.findings.push_back(finding_of(c));
    }
    const auto at = referee != nullptr ? failing_stage(scene, candidate, *referee) : std::nullopt;
    if (at) pass.findings.push_back({at->stage, candidate.info().name, {}, {at->how}, {}, 0, ""});
    return pass;
  }
  std::set<Stage> wrong;
  for (const Comparison& c : pass.verdict.comparisons) {
    if (referee == nullptr || !judges_alone(c) || !is_wrong(c) || !wrong.insert(c.stage).second) continue;
    pass.findings.push_back(Finder{scene, *referee, explain, conventions, foreign}(pass.repaired, c));
  }
  if (referee != nullptr && lacks_fragment_records(pass.repaired))
    look_at_worst(pass, {scene, *referee, explain, conventions, foreign}, candidate);
  if (wrong.empty() && !pass.findings.empty()) return pass;
  const bool by_steps =
      foreign && std::ranges::all_of(wrong, [&](Stage s) { return differs_by_steps(pass.verdict, s); });
  if (by_steps || wrong.empty()) {
    const Comparison* row = by_steps ? first_beyond_steps(pass.verdict) : nullptr;
    pass.first = finding_beside(row != nullptr ? row : first_different(pass.verdict), scene, pass.repaired, references,
                                drawn.references, explain);
  }
  if (wrong.empty()) return pass;
  try {
    repair(pass, {scene, *referee, explain, conventions, foreign}, candidate, wrong);
  } catch (const std::exception&) {  // exact cannot go on; what was found stands
  }
  return pass;
}

// Resolve on the passes' repaired colours.
void judge_repaired_samples(const Finder& find, std::span<const Pass> passes, Renderer& candidate, Diagnosis& out) {
  const Scene& scene = find.scene;
  const auto reached_the_end = [](const Pass& pass) { return !pass.repaired.planes.color.empty(); };
  if (!candidate.info()[Stage::resolve].runs || !std::ranges::all_of(passes, reached_the_end)) return;
  Capture in;
  for (const Pass& pass : passes) in.samples.push_back(pass.repaired.planes.color);
  const JudgeId name(find.referee.info().name, Kind::repaired);
  Comparison row;
  try {
    copy_stage(Stage::resolve, candidate.run_stage(scene, Stage::resolve, in), in);
    const Capture made = find.referee.run_stage(scene, Stage::resolve, in);
    const Tolerance& limit = tolerance(Profile::exact, Stage::resolve);
    row = judged(scene.name, name, Stage::resolve, compare_resolved(scene, in, made, limit.factor), &limit);
  } catch (const std::exception& e) {
    row = not_judged(scene.name, name, Stage::resolve, Outcome::failed, e.what());
  }
  if (is_wrong(row)) out.findings.push_back(find(in, row));
  out.verdict.comparisons.push_back(std::move(row));
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
Diagnosis diagnose_passes(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          std::uint64_t most_fragments, Explain explain, std::optional<Finding>& first) {
  Diagnosis out;
  std::vector<Pass> passes;
  std::vector<SceneVerdict> verdicts;
  std::vector<Plane<glm::vec4>> colors;
  const std::vector<Scene> scenes = math::pass_scenes(scene);
  for (const Scene& pass : scenes) {
    passes.push_back(look_at(pass, candidate, references, most_fragments / scenes.size(), explain));
    verdicts.push_back(passes.back().verdict);
    colors.push_back(std::move(passes.back().color));
    if (!first) first = passes.back().first;
    std::ranges::move(passes.back().findings, std::back_inserter(out.findings));
  }
  const bool repaired = !out.findings.empty();
  BothCaptures drawn;
  out.verdict = judge_resolved(scene, verdicts, colors, candidate, references, &drawn);
  Renderer* referee = referee_of(references);
  if (referee == nullptr) return out;
  const Finder find{scene, *referee, explain, candidate.info().conventions, is_foreign(candidate)};
  bool resolve_wrong = false;
  for (const Comparison& c : out.verdict.comparisons) {
    if (c.stage != Stage::resolve || !judges_alone(c) || !is_wrong(c)) continue;
    resolve_wrong = true;
    out.findings.push_back(find(drawn.candidate, c));
  }
  if (repaired && !resolve_wrong) judge_repaired_samples(find, passes, candidate, out);
  return out;
}

Diagnosis diagnosed(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                    std::uint64_t most_fragments, Explain explain) {
  Diagnosis out;
  std::optional<Finding> first;
  if (scene.frame.antialias.kind == Antialias::Kind::none) {
    Pass pass = look_at(scene, candidate, references, most_fragments, explain);
    out.verdict = std::move(pass.verdict);
    out.findings = std::move(pass.findings);
    first = std::move(pass.first);
  } else {
    out = diagnose_passes(scene, candidate, references, most_fragments, explain, first);
  }
  out.findings = worst_of_each(std::move(out.findings));
  for (const Finding& f : out.findings) out.wrong.push_back(f.stage);
  const bool by_tie_rule = candidate.info().profile == Profile::foreign && is_legal(out.verdict, Stage::coverage);
  const auto matters = std::ranges::find_if(
      out.findings, [&](const Finding& f) { return f.explains > 0 && !(f.stage == Stage::coverage && by_tie_rule); });
  const auto headline = matters != out.findings.end() ? std::optional(matters->stage) : std::nullopt;
  std::ranges::stable_sort(out.findings, std::greater(), &Finding::explains);
  if (const Comparison* row = first_different(out.verdict)) {
    out.first = row->stage;
    if (!out.wrong.empty() && row->stage < out.wrong[0] && holds_alone(out.verdict, row->stage))
      out.first = out.wrong[0];
    if (out.wrong.empty()) out.findings.push_back(first ? *first : finding_of(*row));
  } else if (!out.wrong.empty()) {
    out.first = out.wrong[0];  // which failed
  }
  const Comparison* beyond = first_beyond_steps(out.verdict);
  if (headline) {
    out.first = headline;
  } else if (is_foreign(candidate) && out.first && differs_by_steps(out.verdict, *out.first) && beyond != nullptr) {
    out.first = beyond->stage;
    if (std::ranges::find(out.wrong, beyond->stage) == out.wrong.end())
      out.findings.insert(out.findings.begin(), first ? *first : finding_of(*beyond));
  } else if (by_tie_rule && out.first == Stage::coverage) {
    const auto other = std::ranges::find_if(out.wrong, [](Stage stage) { return stage != Stage::coverage; });
    out.first = other != out.wrong.end() ? std::optional(*other) : std::nullopt;
  }
  return out;
}

}  // namespace

Diagnosis diagnose(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                   std::uint64_t most_fragments) {
  return diagnosed(scene, candidate, references, most_fragments, in_full);
}

Diagnosis diagnose_in_brief(const Scene& scene, Renderer& candidate, std::span<const Reference> references) {
  return diagnosed(scene, candidate, references, kMostFragments, in_brief);
}

Capture expected_capture(const Scene& scene, Renderer& referee) {
  Capture out;
  out.renderer = referee.info().name;
  out.width = scene.frame.width;
  out.height = scene.frame.height;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(Stage::merge); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::texture && !textured(scene)) continue;
    copy_stage(stage, referee.run_stage(scene, stage, out), out);
    round_to_formats(scene, stage, out);
  }
  return out;
}

}  // namespace plumbline::check
