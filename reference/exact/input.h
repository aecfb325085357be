// Checks and look-ups of given records, shared by the stages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Throws std::invalid_argument, naming `what`, unless `is` == `expected`.
void require_size(std::string_view what, std::size_t is, std::size_t expected);
/// Throws std::invalid_argument, naming `what`, unless `is` < `end`.
void require_index(std::string_view what, std::size_t is, std::size_t end);

/// Look-up of a primitive's draw. The scene must outlive the look-up.
class DrawOf {
 public:
  explicit DrawOf(const Scene& scene);
  /// Index into Scene::draws. Throws std::invalid_argument where the scene has no such primitive.
  std::size_t index(std::uint32_t primitive) const;
  const Draw& operator()(std::uint32_t primitive) const { return scene_.draws[index(primitive)]; }

 private:
  const Scene& scene_;
  std::vector<DrawRange> ranges_;
};

/// Fragments [first, last) of one triangle.
struct FragmentRun {
  std::uint32_t triangle;
  std::size_t first, last;
};
/// Runs of records.covered, one per triangle that has fragments. Throws std::invalid_argument where the fragments are
/// not in the triangles' order, or one names no triangle of the records or a pixel outside the frame.
std::vector<FragmentRun> runs_by_triangle(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
