// Bugs that people make, as what each does to a stage (causes.h).
#pragma once

#include <span>
#include <string_view>

#include "check/causes.h"

namespace plumbline::check {

/// One bug. Of the functions, those that are there act.
struct Hypothesis {
  Stage stage;
  std::string_view name;   ///< stage.bug
  std::string_view words;  ///< what is wrong
  /// Puts it into what the stage is given.
  void (*before)(Scene& scene, Capture& in) = nullptr;
  /// Puts it into what the stage made; `in` is what it was given.
  void (*after)(const Scene& scene, const Capture& in, Capture& made) = nullptr;
  /// Or says of the differences themselves whether they are the bug's.
  bool (*shows)(const Evidence& evidence) = nullptr;
};

/// A bug in what the stage is given, in what it made, and one that its differences show.
constexpr Hypothesis given(Stage stage, std::string_view name, std::string_view words,
                           void (*before)(Scene&, Capture&)) {
  return {stage, name, words, before};
}
constexpr Hypothesis made(Stage stage, std::string_view name, std::string_view words,
                          void (*after)(const Scene&, const Capture&, Capture&)) {
  return {stage, name, words, nullptr, after};
}
constexpr Hypothesis seen(Stage stage, std::string_view name, std::string_view words, bool (*shows)(const Evidence&)) {
  return {stage, name, words, nullptr, nullptr, shows};
}

/// Stages 0 to 4, and 5 to 12; by stage.
std::span<const Hypothesis> geometry_hypotheses();
std::span<const Hypothesis> fragment_hypotheses();

/// What the stage makes where the bug is in it (one with `before` or `after`), as real numbers.
Capture made_with(const Hypothesis& hypothesis, const Scene& scene, const Capture& in, Renderer& renderer);

/// Of triangle edges and ties: whether pixel (x, y)'s centre lies exactly on one of its snapped edges.
bool on_an_edge(const WindowTriangle<double>& triangle, glm::ivec2 pixel);

}  // namespace plumbline::check
