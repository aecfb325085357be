#include "pipeline/program.h"

#include <stdexcept>

#include <fmt/format.h>

namespace plumbline::pipeline {

void require_drawable(std::size_t triangles, const FrameFormat& format) {
  constexpr std::size_t kMostPrimitives = std::size_t{1} << 24;
  constexpr int kLargestFrame = 16384;
  if (triangles > kMostPrimitives)
    throw std::invalid_argument(
        fmt::format("a program of {} triangles: expected at most {}", triangles, kMostPrimitives));
  if (format.antialias.kind != Antialias::Kind::none)
    throw std::invalid_argument("a program's frame: expected one sample a pixel");
  const auto fits = [](int side) { return side >= 1 && side <= kLargestFrame; };
  if (!fits(format.width) || !fits(format.height)) {
    throw std::invalid_argument(fmt::format("a program's frame of {} x {} pixels: expected 1 to {} a side",
                                            format.width, format.height, kLargestFrame));
  }
}

Frame draw_program(std::span<const Vertex<float>> vertices, std::span<const Attributes> varyings,
                   std::size_t varying_fours, const FrameFormat& format, const ProgramState& state,
                   decltype(Stages::shade) shade, const void* program) {
  Scene scene;  // read for the viewport alone
  scene.frame = format;
  Draw draw;
  draw.cull = state.cull;
  draw.depth_func = state.depth_func;
  std::vector<Attributes> by_corner(varyings.begin(), varyings.end());
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 0; i + 2 < vertices.size(); i += 3) {
    triangles.push_back({i, i + 1, i + 2});
    if (state.shading == Shading::flat) by_corner[i] = by_corner[i + 1] = by_corner[i + 2];
  }
  Stages stages = production_stages();
  stages.shade = shade;
  Surface surface{&scene, &draw, {}, {}, {}, program};
  for (std::size_t i = 1; i < varying_fours; ++i) surface.carried.push_back(kAllVaryings[i - 1]);
  const DrawInput input{&draw, Topology::triangles, false, false, stages.matrices(scene, draw)};
  FrameBuffer frame(format);
  Recorder nothing;
  draw_primitives({input, triangles, vertices, by_corner, 0, surface}, format, stages, frame, nothing);
  return finished(format, frame);
}

}  // namespace plumbline::pipeline
