// Stages 5 to 11 of the definition, run on given window triangles.
#pragma once

#include <span>
#include <vector>

#include "pipeline/render.h"

namespace plumbline::test {

/// The frame of the triangles. Draw d has triangles [first[d], first[d + 1]), so that first.size() is draws.size() + 1;
/// a triangle's index is its primitive's number. Without shading inputs: no scene, lights or textures.
inline pipeline::Frame frame_of(std::span<const pipeline::ShadedTriangle> triangles,
                                std::span<const std::uint32_t> first, std::span<const Draw> draws,
                                const FrameFormat& format) {
  static thread_local std::span<const pipeline::ShadedTriangle> given;
  given = triangles;
  pipeline::Stages stages = pipeline::production_stages();
  stages.assemble = [](const pipeline::DrawInput&, const glm::uvec3&, std::span<const Vertex<float>>,
                       std::span<const pipeline::Attributes>) {
    pipeline::Polygon polygon;
    polygon.corners.push_back({});
    return polygon;
  };
  stages.clip = [](const pipeline::DrawInput&, pipeline::Polygon&) {};
  stages.window = [](const pipeline::DrawInput&, const pipeline::Polygon& polygon,
                     std::vector<pipeline::ShadedTriangle>& out) { out.push_back(given[polygon.primitive]); };
  const Scene scene;
  pipeline::FrameBuffer frame(format);
  pipeline::Recorder nothing;
  for (std::size_t d = 0; d < draws.size(); ++d) {
    const std::vector<glm::uvec3> primitives(first[d + 1] - first[d]);
    const pipeline::DrawInput input{&draws[d], Topology::triangles, false, false, {}};
    pipeline::draw_primitives({input, primitives, {}, {}, first[d], {&scene, &draws[d], {}, {}, {}}}, format, stages,
                              frame, nothing);
  }
  return pipeline::finished(format, frame);
}

}  // namespace plumbline::test
