#include "pipeline/program.h"

#include "pipeline/clip.h"
#include "pipeline/matrices.h"
#include "pipeline/window.h"

namespace plumbline::pipeline {

std::vector<WindowTriangle<float>> program_triangles(std::span<const Vertex<float>> p_clip,
                                                     std::span<const Lit<float>> four, const FrameFormat& format,
                                                     const ProgramState& state) {
  std::vector<glm::uvec3> corners;
  for (std::uint32_t i = 0; i + 2 < p_clip.size(); i += 3) corners.push_back({i, i + 1, i + 2});
  ClipPolygons<float> polygons;
  clip({p_clip, four, corners, 0, state.shading}, polygons);
  Scene viewport;  // of stage 0 the window's part alone counts
  viewport.frame = format;
  std::vector<WindowTriangle<float>> out;
  to_window(matrices(viewport, Draw{}), state.cull, polygons, polygons.polygons, out);
  return out;
}

}  // namespace plumbline::pipeline
