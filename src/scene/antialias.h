// Antialiasing by passes. A pass is a scene of one sample per pixel (or per sub-pixel), which renderers draw and
// comparators judge like any other scene; the passes' colours are resolved into the frame.
//
// OpenGL shades a multisampled pixel once, at its centre (OpenGL 4.5, compatibility profile, section 14.3.1). Each pass
// evaluates that colour again: the same bits, one record per sample, and no stage handles more than one sample.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "scene/fixed_vector.h"
#include "scene/scene.h"

namespace plumbline {

/// Sample offsets from the pixel's centre [1/256 pixel]: Mesa's four samples (.375, .125), (.875, .375), (.125, .625),
/// (.625, .875) of a pixel with its lower left corner at (0, 0). (GL_SAMPLE_POSITION gives an implementation's.)
inline constexpr std::array<glm::ivec2, 4> kSamples = {{{-32, -96}, {96, -32}, {-96, 32}, {32, 96}}};

/// One tap of GzRender's filter: a sample offset [pixels]. Its pass moves the picture by (-dx, -dy); the six pictures
/// are summed by weight. The table is from CSCI-580's last homework; the notes do not have it.
struct Tap {
  double dx, dy;
  int weight;  ///< in thousandths
};
inline constexpr std::array<Tap, 6> kTaps = {
    {{-.52, .38, 128}, {.41, .56, 119}, {.27, .08, 294}, {-.17, -.29, 249}, {.58, -.55, 104}, {-.31, -.71, 106}}};

/// Passes of a scene, in order; without antialiasing, a copy of the scene. A pass of an antialiased scene has
/// antialias `none` and an empty path: no file holds a pass. Supersampling scales scissor boxes by the factor.
std::vector<Scene> passes_of(const Scene& scene);
std::size_t pass_count(const Antialias& antialias);
/// Pass number i of passes_of() into `pass`, whose memory is reused.
void pass_of(const Scene& scene, std::size_t i, Scene& pass);
/// FrameFormat::pass of pass number i.
Pass state_of_pass(const FrameFormat& frame, std::size_t i);

/// One sample of a pixel (x, y) of the frame: pixel (x, y) * Antialias::factor + offset of pass number `pass`.
struct PixelSample {
  std::size_t pass;
  glm::ivec2 offset;
  int weight;  ///< share of the pixel's colour, relative to the sum of the pixel's weights
};
using PixelSamples = FixedVector<PixelSample, 64>;
/// All samples of a pixel, ordered by pass, then row, then column. The frame's depth is that of the first sample:
/// depths are not averaged (Mesa's glBlitFramebuffer takes sample 0's, too).
PixelSamples samples_of(const Antialias& antialias);

/// Offset from the pixel's centre to the pass' sample of coverage and depth [1/256 pixel].
inline glm::ivec2 sample_offset(const FrameFormat& frame) {
  return frame.pass.sample ? kSamples[static_cast<std::size_t>(*frame.pass.sample)] : glm::ivec2(0);
}

}  // namespace plumbline
