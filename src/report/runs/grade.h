// Points for another renderer, by scene and stage.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// Points of a scene: of its stages; without stages, of the whole scene.
struct SceneRubric {
  std::string scene;  ///< its name: group/file
  double points = 0;  ///< of all stages together, or of the scene
  std::vector<std::pair<Stage, double>> stages;
  std::string hint;  ///< what a student sees when it is wrong, or empty
};
struct Rubric {
  std::string title;
  std::vector<SceneRubric> scenes;
};

/// Reads a rubric:
///
///   {"title": "Homework 2", "scenes": {
///     "coverage/shared_edges": {"stages": {"coverage": 4, "depth": 2, "merge": 4}, "hint": "An edge is drawn twice."},
///     "clip/behind_eye": {"points": 5}}}
///
/// Throws JsonError: other keys, no scene, points outside [0,1e6], unknown stages, a scene with both points and stages,
/// or with neither.
Rubric read_rubric(const std::filesystem::path& file);

/// Points earned: a stage's where it was judged and no row of it has failed or differs illegally; a whole scene's where
/// it holds or is legal (text/conformance.h).
struct SceneGrade {
  double earned = 0, points = 0;
  std::string text;  ///< a line per stage, then the hint
};
SceneGrade grade(const SceneRubric& rubric, const check::SceneVerdict& verdict);

/// Names of the rubric's scenes that were not run.
std::vector<std::string> not_run(const Rubric& rubric, std::span<const check::SceneVerdict> verdicts);

/// Gradescope's results.json; a table for GitHub Classroom. All the rubric's scenes must be among the verdicts.
std::string gradescope_json(const Rubric& rubric, std::span<const check::SceneVerdict> verdicts);
std::string grades_markdown(const Rubric& rubric, std::span<const check::SceneVerdict> verdicts);

}  // namespace plumbline::report
