// Likely causes of a wrong stage, in words. A known cause is a change of the stage's input or output, likely if exact,
// with the cause put in, makes the candidate's records; or a pattern, likely if the differences of all records show it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "check/diagnose/evidence.h"

namespace plumbline::check {

/// One cause. At least one of its functions is not null.
struct KnownCause {
  Stage stage;
  std::string_view name;   ///< stage.cause
  std::string_view words;  ///< what is wrong
  /// Changes the input of the stage.
  void (*before)(Scene& scene, Capture& in) = nullptr;
  /// Changes the output of the stage; `in` is its input.
  void (*after)(const Scene& scene, const Capture& in, Capture& made) = nullptr;
  /// Whether the differences themselves show the cause's pattern.
  bool (*shows)(const Evidence& evidence) = nullptr;
};

template <class T>
void change_all(std::vector<T>& items, auto change) {
  for (T& item : items) change(item);
}

/// Calls change(x) for every x in the scene of the type that `change` takes: Scene, Draw, Light, Sampler, Material or
/// Rotate.
template <class Change>
void change_scene(Scene& scene, Change change) {
  if constexpr (std::is_invocable_v<Change, Scene&>) change(scene);
  if constexpr (std::is_invocable_v<Change, Draw&>) change_all(scene.draws, change);
  if constexpr (std::is_invocable_v<Change, Light&>) change_all(scene.lights, change);
  if constexpr (std::is_invocable_v<Change, Sampler&>) {
    change_all(scene.textures, [&](Texture& texture) { change(texture.sampler); });
  }
  for (Draw& draw : scene.draws) {
    if constexpr (std::is_invocable_v<Change, Material&>) {
      change(draw.material);
      if (draw.back_material) change(*draw.back_material);
    }
    if constexpr (std::is_invocable_v<Change, Rotate&>) {
      for (Transform& transform : draw.transforms) {
        if (Rotate* rotate = std::get_if<Rotate>(&transform)) change(*rotate);
      }
    }
  }
}

/// Calls change(x) for the capture, or for every record in the capture of the type that `change` takes.
template <class Change>
void change_records(const Scene& scene, Capture& capture, Change change) {
  Records<double>& r = capture.records;
  if constexpr (std::is_invocable_v<Change, Capture&>) change(capture);
  if constexpr (std::is_invocable_v<Change, Matrices<double>&>) change_all(r.matrices, change);
  if constexpr (std::is_invocable_v<Change, const Scene&, Matrices<double>&>) {
    change_all(r.matrices, [&](Matrices<double>& m) { change(scene, m); });
  }
  if constexpr (std::is_invocable_v<Change, Vertex<double>&>) change_all(r.vertices, change);
  if constexpr (std::is_invocable_v<Change, Texel<double>&>) change_all(r.texels, change);
  if constexpr (std::is_invocable_v<Change, WindowTriangle<double>&>) change_all(r.triangles, change);
  if constexpr (std::is_invocable_v<Change, WindowVertex<double>&>) {
    for (WindowTriangle<double>& triangle : r.triangles) std::ranges::for_each(triangle.v, change);
  }
}

/// A cause in the input of the stage.
template <auto change>
constexpr KnownCause given(Stage stage, std::string_view name, std::string_view words) {
  return {stage, name, words, [](Scene& scene, Capture& in) {
            if constexpr (std::is_invocable_v<decltype(change), Scene&, Capture&>) change(scene, in);
            change_scene(scene, change);
            change_records(scene, in, change);
          }};
}
/// A cause in the output of the stage.
template <auto change>
constexpr KnownCause made(Stage stage, std::string_view name, std::string_view words) {
  return {stage, name, words, nullptr, [](const Scene& scene, const Capture& in, Capture& out) {
            if constexpr (std::is_invocable_v<decltype(change), const Scene&, const Capture&, Capture&>)
              change(scene, in, out);
            change_records(scene, out, change);
          }};
}
/// A cause that the stage's differences show.
constexpr KnownCause seen(Stage stage, std::string_view name, std::string_view words, bool (*shows)(const Evidence&)) {
  return {stage, name, words, nullptr, nullptr, shows};
}

/// Causes of stages 0 to 4, 5 to 7 and 8 to 12, ordered by stage.
std::span<const KnownCause> geometry_causes();
std::span<const KnownCause> raster_causes();
std::span<const KnownCause> fragment_causes();
/// Causes of all stages.
std::vector<KnownCause> all_causes();

/// The referee's output of the stage with the cause in it, unrounded. The cause has `before` or `after`.
Capture made_with(const KnownCause& cause, const Scene& scene, const Capture& in, Renderer& renderer,
                  const Conventions& conventions = {});

/// Detector of truncation. add(): a code, and the real number that should be rounded to it [codes]. shows(): n > 0
/// codes are below the nearest code, and at most n/50 codes are not explained by truncation (within 1e-3 code).
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

template <class T>
void swap_red_and_blue(std::vector<T>& records) {
  for (T& r : records) std::swap(r.color.r, r.color.b);
}

/// Whether the sample at `place` [1/256 pixel] from the pixel's centre lies exactly on the line through two of the
/// triangle's snapped corners, even beyond these corners. Two corners that coincide have no line.
bool on_an_edge(const WindowTriangle<double>& triangle, glm::ivec2 pixel, glm::ivec2 place);

struct Cause {
  std::string_view name;  ///< such as "window.y_flipped"
  std::string words;      ///< the cause
  std::string shown{};    ///< what shows it, after a space; or empty
};

/// Likely causes. First: causes whose pattern the differences show. Then: of the causes that the referee tries, those
/// that leave the fewest records unexplained, at most 1 in 50 of the differing records (ties, and what rounding
/// decides). Both parts are in the order of all_causes(). Several causes that leave no record at all are not
/// named: the one cause "nothing_left" stands for all of them. Empty without a referee.
std::vector<Cause> likely_causes(const Evidence& evidence);

}  // namespace plumbline::check
