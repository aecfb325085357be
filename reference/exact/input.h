// What every stage here asks of the scene and records that it is given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Throws std::invalid_argument, naming what has the wrong size.
void require_size(std::string_view what, std::size_t is, std::size_t expected);
/// Throws std::invalid_argument, naming the index, where it is not below `end`.
void require_index(std::string_view what, std::size_t is, std::size_t end);

/// The draw that a primitive of the scene belongs to.
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
/// The fragments split by triangle. Throws std::invalid_argument where they are not in the triangles' order, or one
/// names a triangle that is not there or a pixel outside the frame.
std::vector<FragmentRun> runs_by_triangle(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
