// A scene in, a frame out: the definition of the pipeline. The painter (painter/painter.h) draws the same bits, fast.
#pragma once

#include <vector>

#include "pipeline/frame.h"
#include "pipeline/recorder.h"
#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Frame of the scene by these stage functions. `records` keeps what its request names; of an antialiased scene,
/// nothing. Throws std::invalid_argument where the projection is not one of the dialect, and OverBudget (recorder.h).
Frame render(const Scene& scene, const Stages& stages = production_stages(), Recorder records = {});

/// Per-draw input of stages 3 to 11: primitives, and vertices as stages 0 to 2 leave them.
struct PreparedDraw {
  DrawInput input;
  std::span<const glm::uvec3> primitives;  ///< corners: numbers of vertices
  std::span<const Vertex<float>> vertices;
  std::span<const Attributes> attributes;  ///< beside vertices
  std::uint32_t first_primitive;           ///< number of primitives[0] in the scene
  Surface surface;
};
/// Stages 3 to 11: draws the primitives, in order, into `frame`, which has the format's size.
void draw_primitives(const PreparedDraw& draw, const FrameFormat& format, const Stages& stages, FrameBuffer& frame,
                     Recorder& records);

/// Frames of the scene's passes, in the order of passes_of().
std::vector<Frame> render_passes(const Scene& scene, const Stages& stages);

}  // namespace plumbline::pipeline
