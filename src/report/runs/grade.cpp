#include "report/runs/grade.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/text/conformance.h"
#include "report/text/markdown.h"
#include "scene/json/json_file.h"

namespace plumbline::report {

namespace {

constexpr double kMostPoints = 1e6;

SceneRubric read_scene(std::string name, const JsonNode& node) {
  node.only({"points", "stages", "hint"});
  SceneRubric out{std::move(name), 0, {}, ""};
  const auto points = node.find("points"), stages = node.find("stages");
  if (points.has_value() == stages.has_value()) {
    node.refuse("exactly one of the keys points, stages", points ? "both" : "neither");
  }
  if (points) out.points = points->number(0, kMostPoints);
  if (stages) {
    stages->only(kStageNames);
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      const auto of_stage = stages->find(kStageNames[i]);
      if (!of_stage) continue;
      out.stages.emplace_back(static_cast<Stage>(i), of_stage->number(0, kMostPoints));
      out.points += out.stages.back().second;
    }
  }
  if (const auto hint = node.find("hint")) out.hint = hint->text();
  return out;
}

const check::SceneVerdict& verdict_of(const SceneRubric& rubric, std::span<const check::SceneVerdict> verdicts) {
  return *std::ranges::find(verdicts, rubric.scene, &check::SceneVerdict::scene);
}

// The remark with both values and counts: a student does not see the table.
std::string remark_with_values(const check::Comparison& c) {
  const check::Worst* worst = check::shown(c);
  if (worst == nullptr || c.outcome != check::Outcome::different) return check::remark(c);
  return fmt::format("{}: {:.4g}, expected {:.4g} ({} of {} differ)", check::remark(c), worst->candidate,
                     worst->reference, c.measurement.differing, c.measurement.items);
}

// Whether a row was compared, differs, and is known to (--expect).
bool is_known_to_differ(const check::Comparison& c) {
  return c.outcome == check::Outcome::expected && check::was_compared(c);
}

// The remark on one stage, and whether its points are earned.
std::pair<bool, std::string> stage_grade(const check::SceneVerdict& verdict, Stage stage) {
  const check::Comparison* wrong = nullptr;
  bool judged = false;
  for (const check::Comparison& c : verdict.comparisons) {
    if (c.stage != stage || !check::votes(c)) continue;
    judged |= check::was_compared(c);
    const bool differs = c.outcome == check::Outcome::different && !check::is_legal(verdict, stage);
    if (wrong == nullptr && (differs || is_known_to_differ(c) || c.outcome == check::Outcome::failed)) wrong = &c;
  }
  if (wrong != nullptr) return {false, fmt::format("wrong: {}", remark_with_values(*wrong))};
  return {judged, judged ? "right" : "not judged: the program does not show it"};
}

// The first stage's row that differs, known to or not; null: none.
const check::Comparison* first_wrong_or_known(const check::SceneVerdict& verdict) {
  const check::Comparison* first = first_wrong(verdict);
  for (const check::Comparison& c : verdict.comparisons) {
    if (check::votes(c) && is_known_to_differ(c) && (first == nullptr || c.stage < first->stage)) first = &c;
  }
  return first;
}

// The remark on a whole scene that is not right.
std::string scene_remark(const check::SceneVerdict& verdict) {
  const auto& rows = verdict.comparisons;
  if (const check::Comparison* first = first_wrong_or_known(verdict))
    return fmt::format("wrong, from the stage {} on: {}", name_of(first->stage), remark_with_values(*first));
  const auto lacks = [](const check::Comparison& c) {
    return c.outcome == check::Outcome::failed || c.outcome == check::Outcome::expected;
  };
  const auto lacking = std::ranges::find_if(rows, lacks), why = lacking != rows.end() ? lacking : rows.begin();
  return why == rows.end() ? "not judged" : fmt::format("not judged: {}", why->note);
}

}  // namespace

Rubric read_rubric(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonNode root = json.root();
  root.only({"title", "scenes"});
  Rubric out{root["title"].text(), {}};
  const JsonNode scenes = root["scenes"];
  if (scenes.value().kind != JsonValue::Kind::object || scenes.value().members.empty()) {
    scenes.refuse("an object of at least one scene");
  }
  for (const auto& [name, value] : scenes.value().members) out.scenes.push_back(read_scene(name, scenes[name]));
  return out;
}

SceneGrade grade(const SceneRubric& rubric, const check::SceneVerdict& verdict) {
  SceneGrade out{0, rubric.points, ""};
  for (const auto& [stage, points] : rubric.stages) {
    const auto [earned, says] = stage_grade(verdict, stage);
    out.earned += earned ? points : 0;
    out.text += fmt::format("{} ({} of {}): {}\n", name_of(stage), earned ? points : 0, points, says);
  }
  if (rubric.stages.empty()) {
    const Conformance is = conformance_of(verdict);
    const bool holds = is == Conformance::holds || is == Conformance::legal;
    out.earned = holds ? rubric.points : 0;
    out.text = (holds ? "right" : scene_remark(verdict)) + "\n";
  }
  if (out.earned < out.points && !rubric.hint.empty()) out.text += rubric.hint + "\n";
  return out;
}

std::vector<std::string> not_run(const Rubric& rubric, std::span<const check::SceneVerdict> verdicts) {
  std::vector<std::string> out;
  for (const SceneRubric& scene : rubric.scenes) {
    if (std::ranges::find(verdicts, scene.scene, &check::SceneVerdict::scene) == verdicts.end()) {
      out.push_back(scene.scene);
    }
  }
  return out;
}

std::string gradescope_json(const Rubric& rubric, std::span<const check::SceneVerdict> verdicts) {
  nlohmann::ordered_json tests = nlohmann::ordered_json::array();
  double score = 0;
  for (const SceneRubric& scene : rubric.scenes) {
    const SceneGrade g = grade(scene, verdict_of(scene, verdicts));
    score += g.earned;
    tests.push_back({{"name", scene.scene},
                     {"score", g.earned},
                     {"max_score", g.points},
                     {"status", g.earned == g.points ? "passed" : "failed"},
                     {"output", g.text}});
  }
  const nlohmann::ordered_json out = {{"score", score}, {"output", rubric.title}, {"tests", tests}};
  return out.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string grades_markdown(const Rubric& rubric, std::span<const check::SceneVerdict> verdicts) {
  std::string rows;
  double earned = 0, points = 0;
  for (const SceneRubric& scene : rubric.scenes) {
    const SceneGrade g = grade(scene, verdict_of(scene, verdicts));
    earned += g.earned, points += g.points;
    rows += fmt::format("| {} | {} of {} | {} |\n", cell(scene.scene), g.earned, g.points, cell(g.text));
  }
  return fmt::format("\n## {}: {} of {} points\n\n| scene | points | why |\n|---|---|---|\n{}", cell(rubric.title),
                     earned, points, rows);
}

}  // namespace plumbline::report
