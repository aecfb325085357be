// The verdict of exact on a renderer's frame, by the conventions that it declares.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "capture/renderers/replayed_renderer.h"
#include "check/judge/judge_single.h"
#include "reference/exact/exact.h"
#include "tests/suite.h"

namespace plumbline::test {

/// Verdict on the renderer's colours and depths, or on all of its planes.
inline check::SceneVerdict verdict_of(const Scene& scene, std::unique_ptr<Renderer> renderer,
                                      const Conventions& conventions, bool of_all_planes = false) {
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  const Planes drawn = renderer->capture(scene, Request{}).planes;
  Capture frame;
  frame.width = scene.frame.width, frame.height = scene.frame.height;
  frame.planes.color = drawn.color, frame.planes.depth = drawn.depth;
  if (of_all_planes) frame.planes = drawn;
  const auto replayed = make_replayed_renderer(std::move(frame), scene, "test", conventions);
  return check::judge_single(scene, *replayed, references);
}
inline check::SceneVerdict verdict_of(const std::string& scene, std::unique_ptr<Renderer> renderer,
                                      const Conventions& conventions) {
  return verdict_of(suite_scene(scene), std::move(renderer), conventions);
}

inline bool is_wrong(const check::SceneVerdict& verdict) {
  return std::ranges::any_of(verdict.comparisons,
                             [](const check::Comparison& c) { return c.outcome == check::Outcome::different; });
}
/// Colours were judged, nothing is different, and nothing failed.
inline bool is_right(const check::SceneVerdict& verdict) {
  const auto judges_colors = [](const check::Comparison& c) { return c.stage == Stage::merge && was_compared(c); };
  const auto is_failed = [](const check::Comparison& c) { return check::is_failure(c.outcome); };
  return std::ranges::none_of(verdict.comparisons, is_failed) &&
         std::ranges::any_of(verdict.comparisons, judges_colors);
}

/// A mipmapped floor in front of the eye that no side of the window cuts.
inline Scene narrow_floor() {
  Scene scene = suite_scene("texture/floor_nearest_mipmap_nearest");
  for (glm::vec3& p : scene.meshes[0].positions) p = {p.x / 18, p.y, p.z > 0 ? 0.5f : -8.0f};
  return scene;
}

}  // namespace plumbline::test
