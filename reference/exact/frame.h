// Stages 10 and 11: fragments are folded in draw order into the frame.
#pragma once

#include <utility>

#include "scene/scene.h"
#include "stages/capture.h"

namespace plumbline::exact {

/// The depth plane in the frame's format, cleared.
class DepthBuffer {
 public:
  explicit DepthBuffer(const FrameFormat& frame);
  /// A fragment of window z `depth` arrives; where it passes, it is stored.
  bool test(int x, int y, DepthFunc func, double depth);
  Plane<double> take() { return std::move(plane_); }

 private:
  DepthFormat format_;
  Plane<double> plane_;
};

/// What the frame keeps of a colour: clamped to [0,1] for rgba8 and rgba12 (but not rounded to codes), as it is for
/// rgba32f.
glm::vec4 kept_color(ColorFormat format, glm::dvec4 color);

/// Stage 10: planes.id, from records.triangles, covered and depth.
/// Throws std::invalid_argument where the records do not fit the scene or each other.
Plane<std::int32_t> visible_primitives(const Scene& scene, const Records<double>& records);

/// Stage 11: planes.color and planes.depth into `out`, from records.triangles, covered, depth and shaded, and the
/// winning primitives `id`.
/// Throws std::invalid_argument where the records do not fit the scene or each other.
void merge_fragments(const Scene& scene, const Records<double>& records, const Plane<std::int32_t>& id, Planes& out);

}  // namespace plumbline::exact
