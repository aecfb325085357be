// One scene's judgement, shared by judge_single.cpp, ask_oracle.cpp, run_exact_stage.cpp, side_by_side.cpp and
// src/check/diagnose.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "check/verdict/ledger.h"
#include "check/verdict/measure.h"
#include "check/verdict/verdict.h"
#include "scene/scene.h"

namespace plumbline::check {

inline constexpr std::string_view kOnlyShaded = "it hands out the final colour alone; see shade";
inline constexpr std::string_view kOverBudget = "more fragments than are looked at one by one";

/// One scene's judgement of one candidate, as it grows.
struct Case {
  const Scene& scene;  // as the candidate's conventions have it
  const Capture& candidate;
  const Legal& legal;  // an oracle's, or empty
  Renderer* referee;   // runs stages, or null
  std::vector<Comparison>& out;
  Profile profile = Profile::exact;  // of the reference
  bool foreign = false;              // the candidate is Profile::foreign: legal coverage is no difference
  Conventions conventions = {};      // of the candidate
  // Ambiguous items that the current stage's comparison leaves out: pixels open by the alpha test or by a turned
  // outline; in coverage, turned primitives.
  std::uint64_t open = 0;

  void add(const JudgeId& judge, Stage stage, Measurement m, const Tolerance* row = nullptr, std::string note = "") {
    m.ambiguous += open;
    out.push_back(judged(scene.name, judge, stage, std::move(m), row, std::move(note)));
  }
  // Legal answers of coverage where the candidate's tie rule is not known, else none.
  const Legal& open_coverage() const {
    static const Legal none;
    return foreign ? legal : none;
  }
  // Repeats the judge's row of stage `of` for another stage that the same plane shows.
  void repeat(const JudgeId& judge, Stage of, Stage stage) {
    const auto same = [&](const Comparison& c) { return c.judge == judge && c.stage == of; };
    const auto row = std::find_if(out.begin(), out.end(), same);
    if (row == out.end()) return;
    Comparison copy = *row;
    copy.stage = stage;
    out.push_back(std::move(copy));
  }
  void skip(const JudgeId& judge, Stage stage, Outcome outcome, std::string_view note) {
    out.push_back(not_judged(scene.name, judge, stage, outcome, std::string(note)));
  }
};

/// Whether the count plane has fragments and the records none: beyond the budget, or a capture of planes alone.
inline bool lacks_fragment_records(const Capture& c) {
  const auto& count = c.planes.count.values();
  return c.records.covered.empty() && std::any_of(count.begin(), count.end(), [](std::uint32_t n) { return n != 0; });
}

inline bool draws_lines_or_points(const Scene& scene) {
  return draws(scene, Topology::lines) || draws(scene, Topology::points);
}

/// The stage as `referee` makes it of the candidate's own records, against the candidate's.
void run_exact_stage(Case& c, Renderer& referee, Stage stage, const JudgeId& name);

/// The stage as it was made of the candidate's own records, against the candidate's. Not of matrices, nor of resolve.
void compare_stage(Case& c, const Capture& made, Stage stage, const JudgeId& name);

/// Coverage, depth, colour and visibility against an oracle's legal answers.
void ask_oracle(Case& c, const Legal& legal, Stage stage, const JudgeId& name);

/// What the reference shows, beside the candidate's.
void side_by_side(Case& c, const Capture& theirs, Stage stage, const JudgeId& name);

/// Whether the stage's comparison needs legal texels and the candidate's capture holds none.
bool lacks_texels(const Case& c, Stage stage);

}  // namespace plumbline::check
