// A scene of one sample a pixel, the candidate and its references: everything that can be compared is compared.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "capture/renderer.h"
#include "check/verdict/verdict.h"
#include "scene/scene.h"

namespace plumbline::check {

/// A reference, or its absence.
struct Reference {
  std::string name;
  Renderer* renderer = nullptr;  ///< not owned; null: not built in
};

/// What both sides handed out, for a report's pictures.
struct BothCaptures {
  Capture candidate;
  std::vector<Capture> references;  ///< in the references' order; empty captures where there is none
};

/// A reference's role follows from its info (renderer.h), not from its name. The referee judges the candidate's own
/// records, stage by stage (Kind::per_stage); a reference of legal answers is an oracle for coverage, depth, visibility
/// and colour; everything else that a reference shows is compared side by side.
///
/// Records of the candidate's fragments are not captured where its planes count more than `most_fragments` fragments,
/// or where these records do not fit the memory budget. Legal answers of the whole frame are not asked for in the first
/// case, nor kept beyond the budget: the referee then gives them at the pixels where a reference has another winner.
/// Throws OverBudget, before a reference draws, where the candidate's capture does not fit even without fragments.
SceneVerdict judge_single(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn = nullptr, std::uint64_t most_fragments = ~std::uint64_t{0});

/// Each painter's frame, drawn without records, bit for bit against `watched`, the frame drawn with records: one row
/// `picture` of the last stage, of the first painter that differs.
Comparison judge_picture(const Scene& scene, Renderer& candidate, const Capture& watched);

/// Stages as a referee makes them of the candidate's own records.
using MadeStages = std::map<Stage, Capture>;

/// Rows of Kind::per_stage: every stage but matrices and resolve, as `referee` makes it of the candidate's own records,
/// against the candidate's. `shown`: the candidate's info, which gives its abilities, profile and conventions; null: it
/// shows every stage, is not foreign, and draws by OpenGL's conventions. `made`: stages that the referee has run
/// already. `legal`: answers that are no difference in a foreign candidate's coverage (Profile::foreign).
std::vector<Comparison> judge_records(const Scene& scene, const Capture& candidate, Renderer& referee,
                                      const RendererInfo* shown = nullptr, const MadeStages& made = {},
                                      const Legal& legal = {});

}  // namespace plumbline::check
