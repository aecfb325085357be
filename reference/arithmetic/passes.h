// Passes and samples of antialiased scenes, from their sources: the renderer's are src/scene/antialias.h.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline::math {

/// Mesa's four samples in a pixel whose lower left corner is (0, 0) [pixels]; OpenGL's own are GL_SAMPLE_POSITION.
inline constexpr std::array<glm::dvec2, 4> kSamplePositions = {
    {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};

/// Place of the pass's sample from the pixel's centre [pixels]; 0 where the pass has none.
glm::dvec2 sample_offset(const FrameFormat& frame);

/// The scenes of one sample that a scene is drawn as (OpenGL 4.5, section 14.3.1; CSCI-580, homework 6), in order.
std::vector<Scene> pass_scenes(const Scene& scene);

/// One sample's share of a pixel's colour, weights of a pixel being integers.
struct PixelShare {
  std::size_t pass;
  glm::ivec2 pixel;  ///< of the pass
  int weight;
};
/// The samples of pixel (x, y), by pass, then row.
std::vector<PixelShare> pixel_shares(const Antialias& antialias, int x, int y);

}  // namespace plumbline::math
