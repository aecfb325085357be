// Points for another renderer, by scene and stage.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "check/verdict/verdict.h"

namespace plumbline::report {

/// What a scene is worth: the points of its stages, or, of none, of the whole scene.
struct SceneRubric {
  std::string scene;  ///< its name: group/file
  double points = 0;
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
/// Throws JsonError: other keys, no scene, points that are negative or beyond 1e6, stages that there are not, points
/// and stages of one scene.
Rubric read_rubric(const std::filesystem::path& file);

/// What was earned: a stage's points where it was judged, and nothing in it is wrong; a scene's where that holds of
/// all that was judged (text/conformance.h).
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
