// One scene's judgement, to which each kind of row (rows.h) adds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "check/compare/compare_planes.h"
#include "check/verdict/ledger.h"
#include "check/verdict/measure.h"
#include "check/verdict/verdict.h"
#include "scene/scene.h"

namespace plumbline::check {

/// State of one scene's judgement: the candidate's capture, the judges' inputs, the rows appended so far.
struct SceneJudgement {
  const Scene& scene;  ///< as the candidate's conventions have it
  const Capture& candidate;
  const Legal& legal;                ///< an oracle's, or empty
  Renderer* referee;                 ///< runs stages, or null
  std::vector<Comparison>& rows;     ///< add(), repeat() and skip() append one each
  Profile profile = Profile::exact;  ///< of the reference
  bool foreign = false;              ///< the candidate is Profile::foreign: legal coverage is no difference
  Conventions conventions = {};      ///< of the candidate
  /// Ambiguous items that the comparison leaves out: pixels open by the alpha test or by a turned outline; in coverage,
  /// turned primitives.
  std::uint64_t open = 0;

  /// Copy with `more` added to `open`.
  SceneJudgement with_open(std::uint64_t more) const {
    SceneJudgement out = *this;
    out.open += more;
    return out;
  }
  void add(const JudgeId& judge, Stage stage, Measurement m, const Tolerance* row = nullptr,
           std::string note = "") const {
    m.ambiguous += open;
    rows.push_back(judged(scene.name, judge, stage, std::move(m), row, std::move(note)));
  }
  /// Legal answers of coverage for a foreign candidate, else none.
  const Legal& open_coverage() const {
    static const Legal none;
    return foreign ? legal : none;
  }
  /// not_shown: a foreign candidate leaves out the stencil values of a frame that has some, and its winners alone are
  /// compared. Else compared.
  Stencils stencils() const {
    const bool has_some = scene.frame.stencil != StencilFormat::none;
    return foreign && has_some && candidate.planes.stencil.empty() ? Stencils::not_shown : Stencils::compared;
  }
  /// Note of a row that compares winners.
  std::string note_of_winners() const {
    if (candidate.planes.id.empty() && !candidate.planes.stencil.empty())
      return "its stencil values alone: it shows no planes.id";
    return stencils() == Stencils::compared ? "" : "its winners alone: it shows no planes.stencil";
  }
  /// Appends a copy of the judge's row of stage `of` as the row of `stage`: the same plane shows both.
  void repeat(const JudgeId& judge, Stage of, Stage stage) const {
    const auto same = [&](const Comparison& c) { return c.judge == judge && c.stage == of; };
    const auto row = std::find_if(rows.begin(), rows.end(), same);
    if (row == rows.end()) return;
    Comparison copy = *row;
    copy.stage = stage;
    rows.push_back(std::move(copy));
  }
  void skip(const JudgeId& judge, Stage stage, Outcome outcome, std::string_view note) const {
    rows.push_back(not_judged(scene.name, judge, stage, outcome, std::string(note)));
  }
};

}  // namespace plumbline::check
