#include "pipeline/program.h"

#include <stdexcept>

#include <fmt/format.h>

#include "pipeline/clip.h"
#include "pipeline/matrices.h"
#include "pipeline/window.h"

namespace plumbline::pipeline {

void require_drawable(std::size_t triangles, const FrameFormat& format) {
  constexpr std::size_t kMostTriangles = std::size_t{1} << 24;
  constexpr int kLargestFrame = 16384;
  if (triangles > kMostTriangles) {
    throw std::invalid_argument(
        fmt::format("a program of {} triangles: expected at most {}", triangles, kMostTriangles));
  }
  const auto fits = [](int side) { return side >= 1 && side <= kLargestFrame; };
  if (!fits(format.width) || !fits(format.height)) {
    throw std::invalid_argument(fmt::format("a program's frame of {} x {} pixels: expected 1 to {} a side",
                                            format.width, format.height, kLargestFrame));
  }
}

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
  Draw draw;
  draw.cull = state.cull;
  to_window(matrices(viewport, draw), draw, polygons, polygons.polygons, out);
  return out;
}

}  // namespace plumbline::pipeline
