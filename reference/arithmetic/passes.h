// Passes and samples of antialiased scenes, written from their sources; the renderer's are in src/scene/antialias.h.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline::math {

/// Mesa's four samples in a pixel whose lower left corner is (0, 0) [pixels]. (GL_SAMPLE_POSITION gives an
/// implementation's.)
inline constexpr std::array<glm::dvec2, 4> kSamplePositions = {
    {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};

/// Offset of the pass' sample from the pixel's centre [pixels]; 0 where the pass has none.
glm::dvec2 sample_offset(const FrameFormat& frame);

/// The passes of a scene, each of one sample per pixel, in order; of a scene that is not antialiased, the scene itself
/// (OpenGL 4.5, section 14.3.1; CSCI-580, homework 6).
std::vector<Scene> pass_scenes(const Scene& scene);

/// One sample of a pixel's colour.
struct PixelShare {
  std::size_t pass;
  glm::ivec2 pixel;  ///< in the pass
  int weight;        ///< relative to the sum of the pixel's weights
};
/// The samples of pixel (x, y), by pass, then row.
std::vector<PixelShare> pixel_shares(const Antialias& antialias, int x, int y);

}  // namespace plumbline::math
