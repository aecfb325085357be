// Antialiasing: a scene is drawn in passes, each a scene of one sample per pixel (or per sub-pixel) that any renderer
// draws and any comparator judges as it does every other; their colours are resolved into the frame.
//
// OpenGL shades a pixel's samples once (OpenGL 4.5, compatibility profile, section 14.3.1). A pass for each sample
// evaluates the same colour, at the pixel's centre, again: the same bits, a record for each sample, and no stage knows
// of more than one.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "scene/fixed_vector.h"
#include "scene/scene.h"

namespace plumbline {

/// Mesa's four samples (.375, .125), (.875, .375), (.125, .625), (.625, .875) of a pixel whose lower left corner is
/// (0, 0), from its centre, in 1/256 pixel. (GL_SAMPLE_POSITION gives an implementation's.)
inline constexpr std::array<glm::ivec2, 4> kSamples = {{{-32, -96}, {96, -32}, {-96, 32}, {32, 96}}};

/// GzRender's filter: vertices in the window are moved by (-dx, -dy), the six pictures are added up by weight. The
/// table is that of CSCI-580's last homework; the notes do not have it.
struct Tap {
  double dx, dy;
  int weight;  ///< in thousandths
};
inline constexpr std::array<Tap, 6> kTaps = {
    {{-.52, .38, 128}, {.41, .56, 119}, {.27, .08, 294}, {-.17, -.29, 249}, {.58, -.55, 104}, {-.31, -.71, 106}}};

/// The passes of a scene, in order; of a scene that is not antialiased, the scene itself. The passes of an antialiased
/// scene have antialias `none` and no path, for no file holds them. Scissor boxes grow with a supersampled frame.
std::vector<Scene> passes_of(const Scene& scene);
std::size_t pass_count(const Antialias& antialias);
/// The i-th of them, into a scene whose memory is kept; and what it alone has.
void pass_of(const Scene& scene, std::size_t i, Scene& pass);
Pass own_of_pass(const FrameFormat& frame, std::size_t i);

/// One of the samples that a pixel (x, y) of a frame is made of: pixel (x, y) * factor + offset of a pass.
struct PixelSample {
  std::size_t pass;
  glm::ivec2 offset;
  int weight;
};
using PixelSamples = FixedVector<PixelSample, 64>;
/// All of them, by pass, then row. The frame's depth is that of the first: depths are not averaged, and Mesa's
/// glBlitFramebuffer too takes sample 0's.
PixelSamples samples_of(const Antialias& antialias);

/// Offset from the pixel's centre of the pass' sample, where coverage and depth are taken [1/256 pixel].
inline glm::ivec2 sample_place(const FrameFormat& frame) {
  return frame.pass.sample ? kSamples[static_cast<std::size_t>(*frame.pass.sample)] : glm::ivec2(0);
}

}  // namespace plumbline
