// A scene in, a frame out: the definition of the pipeline. The painter (painter/painter.h) draws the same bits, fast.
#pragma once

#include <vector>

#include "pipeline/frame.h"
#include "pipeline/recorder.h"
#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Draws the scene by these stage functions; of a scene that is not antialiased, `records` keeps what it is asked for.
Frame render(const Scene& scene, const Stages& stages = production_stages(), Recorder records = {});

/// Input of stages 3 to 11 of one draw: its primitives, and vertices that have been through stages 0 to 2.
struct PreparedDraw {
  DrawInput input;
  std::span<const glm::uvec3> primitives;  ///< corners: numbers of vertices
  std::span<const Vertex<float>> vertices;
  std::span<const Attributes> attributes;  ///< beside vertices
  std::uint32_t first_primitive;           ///< number of the first
  Surface surface;
};
/// Draws the primitives into `frame`: stages 3 to 11.
void draw_primitives(const PreparedDraw& draw, const FrameFormat& format, const Stages& stages, FrameBuffer& frame,
                     Recorder& records);

/// The frames of an antialiased scene's passes.
std::vector<Frame> render_passes(const Scene& scene, const Stages& stages);

}  // namespace plumbline::pipeline
