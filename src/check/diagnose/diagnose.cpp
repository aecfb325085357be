#include "check/diagnose/diagnose.h"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "capture/by_conventions.h"
#include "check/diagnose/coverage_differences.h"
#include "check/diagnose/evidence.h"
#include "check/diagnose/known_causes.h"
#include "check/judge/captures.h"
#include "check/judge/judge_passes.h"
#include "check/judge/rows.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/stage_copy.h"
#include "check/judge/stage_inputs.h"
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
  for (const Cause& cause : likely_causes(evidence)) {
    finding.causes.push_back(cause.words + cause.shown);
    finding.kinds.push_back(cause.words);
  }
  if (finding.stage != Stage::coverage || lacks_fragment_records(evidence.candidate) ||
      lacks_fragment_records(evidence.expected))
    return;  // of a side without records of fragments, all would be missing
  if (const auto worst = worst_triangle(evidence, finding.measurement.worst.place))
    finding.picture = coverage_picture(*worst);
}
void in_brief(const Evidence&, Finding&) {}

Finding finding_of(const Comparison& row) { return {row.stage, row.judge, row.measurement, {}, {}, {}, 0, ""}; }

// One scene of one sample a pixel.
struct Pass {
  SceneVerdict verdict;
  std::vector<Finding> findings;  // of the stages that are wrong by themselves
  std::optional<Finding> first;   // or, where there is none, of the first different stage
  Plane<glm::vec4> color;         // the candidate's
  Capture repaired;               // the candidate's capture, its wrong stages' records replaced
};

// Exact's stage, run on the records before it; nothing where the records do not fit.
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
  // The judgement of the candidate's capture, to which run_exact_stage() adds.
  SceneJudgement case_of(const Capture& mine, std::vector<Comparison>& rows) const {
    static const Legal none;
    return {.scene = scene,
            .candidate = mine,
            .legal = none,
            .referee = &referee,
            .rows = rows,
            .foreign = foreign,
            .conventions = conventions};
  }
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
  clear_stages_after(*known.begin(), in);  // made of wrong records
  for (const Stage stage : stages_of(scene, *known.begin())) {
    if (stage >= Stage::coverage && !fragments_are_here) return;
    if (!info[stage].runs || !referee_info[stage].runs) return;
    bool wrong = known.contains(stage);
    if (!wrong) {
      const JudgeId name(referee_info.name, Kind::repaired);
      std::vector<Comparison> rows;
      const SceneJudgement c = find.case_of(in, rows);
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
void judge_worst_pixels(Pass& pass, const Finder& find, Renderer& candidate) {
  const std::vector<glm::ivec2> pixels = worst_pixels(find.scene, pass.verdict);
  if (pixels.empty()) return;
  try {
    const Capture mine = candidate.capture(find.scene, {.records = StageSet::all(), .pixels = pixels});
    const JudgeId name(find.referee.info().name, Kind::at_worst);
    const SceneJudgement c = find.case_of(mine, pass.verdict.comparisons);
    if (lacks_fragment_records(mine)) return;
    for (const Stage stage : stages_of(find.scene, Stage::depth, Stage::shade)) {
      run_exact_stage(c, find.referee, stage, name);
      if (is_wrong(c.rows.back())) pass.findings.push_back(find(mine, c.rows.back()));
    }
  } catch (const std::exception&) {  // what the planes show stands
  }
}

Pass diagnose_pass(const Scene& of_dialect, Renderer& candidate, std::span<const Reference> references,
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
    if (at) pass.findings.push_back({at->stage, candidate.info().name, {}, {at->how}, {}, {}, 0, ""});
    return pass;
  }
  std::set<Stage> wrong;
  for (const Comparison& c : pass.verdict.comparisons) {
    if (referee == nullptr || !judges_alone(c) || !is_wrong(c) || !wrong.insert(c.stage).second) continue;
    pass.findings.push_back(Finder{scene, *referee, explain, conventions, foreign}(pass.repaired, c));
  }
  if (referee != nullptr && lacks_fragment_records(pass.repaired))
    judge_worst_pixels(pass, {scene, *referee, explain, conventions, foreign}, candidate);
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
    passes.push_back(diagnose_pass(pass, candidate, references, most_fragments / scenes.size(), explain));
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

// Diagnosis::first, of findings in the stages' order.
std::optional<Stage> headline(const Diagnosis& d, bool foreign) {
  const bool by_tie_rule = foreign && is_legal(d.verdict, Stage::coverage);
  const auto is_legal_coverage = [&](Stage stage) { return stage == Stage::coverage && by_tie_rule; };
  const auto matters =
      std::ranges::find_if(d.findings, [&](const Finding& f) { return f.explains > 0 && !is_legal_coverage(f.stage); });
  if (matters != d.findings.end()) return matters->stage;
  const Comparison* const row = first_different(d.verdict);
  if (row == nullptr && d.wrong.empty()) return std::nullopt;
  const bool by_wrong = row == nullptr ||  // it failed
                        (!d.wrong.empty() && row->stage < d.wrong[0] && holds_alone(d.verdict, row->stage));
  const Stage stage = by_wrong ? d.wrong[0] : row->stage;
  const Comparison* const beyond = first_beyond_steps(d.verdict);
  if (foreign && differs_by_steps(d.verdict, stage) && beyond != nullptr) return beyond->stage;
  if (!is_legal_coverage(stage)) return stage;
  const auto other = std::ranges::find_if(d.wrong, [](Stage s) { return s != Stage::coverage; });
  return other != d.wrong.end() ? std::optional(*other) : std::nullopt;
}

Diagnosis diagnosed(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                    std::uint64_t most_fragments, Explain explain) {
  Diagnosis out;
  std::optional<Finding> first;
  if (!antialiased(scene)) {
    Pass pass = diagnose_pass(scene, candidate, references, most_fragments, explain);
    out.verdict = std::move(pass.verdict);
    out.findings = std::move(pass.findings);
    first = std::move(pass.first);
  } else {
    out = diagnose_passes(scene, candidate, references, most_fragments, explain, first);
  }
  out.findings = worst_of_each(std::move(out.findings));
  for (const Finding& f : out.findings) out.wrong.push_back(f.stage);
  const bool foreign = is_foreign(candidate);
  out.first = headline(out, foreign);
  std::ranges::stable_sort(out.findings, std::greater(), &Finding::explains);
  if (const Comparison* row = first_different(out.verdict)) {
    if (out.wrong.empty()) out.findings.push_back(first ? *first : finding_of(*row));
    const Comparison* const beyond = first_beyond_steps(out.verdict);
    if (foreign && out.first != row->stage && beyond != nullptr && out.first == beyond->stage &&
        std::ranges::find(out.wrong, beyond->stage) == out.wrong.end())
      out.findings.insert(out.findings.begin(), first ? *first : finding_of(*beyond));
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
  for (const Stage stage : stages_of(scene)) {
    copy_stage(stage, referee.run_stage(scene, stage, out), out);
    round_to_formats(scene, stage, out);
  }
  return out;
}

}  // namespace plumbline::check
