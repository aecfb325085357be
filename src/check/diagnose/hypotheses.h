// Bugs that people make, as what each does to a stage (causes.h).
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "check/diagnose/evidence.h"

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

/// Stages 0 to 4, 5 to 7, and 8 to 12; by stage.
std::span<const Hypothesis> geometry_hypotheses();
std::span<const Hypothesis> raster_hypotheses();
std::span<const Hypothesis> fragment_hypotheses();
/// All of them.
std::vector<Hypothesis> all_hypotheses();

/// What the stage makes where the bug is in it (one with `before` or `after`), as real numbers.
Capture made_with(const Hypothesis& hypothesis, const Scene& scene, const Capture& in, Renderer& renderer);

/// Codes beside the real numbers that they stand for: whether they are those below, not the nearest. (Of a number that
/// is a whole code but for rounding, either.)
class Truncation {
 public:
  void add(double code, double expected) {
    constexpr double kRounding = 1e-3;
    ++all_;
    fit_ += std::floor(expected - kRounding) <= code && code <= std::floor(expected + kRounding) ? 1 : 0;
    lower_ += code < std::nearbyint(expected) ? 1 : 0;
  }
  bool shows() const { return lower_ > 0 && (all_ - fit_) * 50 <= lower_; }

 private:
  std::size_t all_ = 0, fit_ = 0, lower_ = 0;
};

template <class Change>
void each_draw(Scene& scene, Change change) {
  for (Draw& draw : scene.draws) change(draw);
}

template <class T>
void swap_red_and_blue(std::vector<T>& records) {
  for (T& r : records) std::swap(r.color.r, r.color.b);
}

/// Whether pixel's centre, or what lies `place` (1/256 pixel) from it, is exactly on one of the snapped edges.
bool on_an_edge(const WindowTriangle<double>& triangle, glm::ivec2 pixel, glm::ivec2 place);

}  // namespace plumbline::check
