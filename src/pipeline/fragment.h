// Stages 6 to 11 of one fragment, by the stage functions (stages.h).
#pragma once

#include "pipeline/frame.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// Lower left pixel of the tile of `pixel`, which is >= 0.
inline glm::ivec2 anchor_of(glm::ivec2 pixel) { return pixel / kTile * kTile; }

/// Setup of stages 6 to 8 for the triangle's fragments in the tile whose lower left pixel is `anchor`. Attributes: the
/// colour, and the varyings that `surface` carries.
TriangleSetup set_up(const Stages& stages, const ShadedTriangle& triangle, const Surface& surface,
                     const DepthState& depth, const SampleOffsets& offsets, glm::ivec2 anchor);

/// The pixel and its centre.
inline Pixels<float> pixel_at(glm::ivec2 pixel) { return {pixel.x, pixel.y, pixel.x + 0.5, pixel.y + 0.5}; }

/// Stage 7 of the colour and of all varyings that the surface carries; other varyings are 0, the texel is not set.
SurfaceAttributes<float> interpolated(const Stages& stages, const Surface& surface, const TriangleSetup& setup,
                                      const Pixels<float>& pixel);
/// Stage 8 at a fragment of a surface with a texture. `texcoords`: s, t of stage 7.
FilteredTexel<float> filtered(const Stages& stages, const TextureSetup& texture, const TriangleSetup& setup,
                              const Color<float>& texcoords, const Pixels<float>& pixel);

/// Input of stage 10 for one fragment.
struct TestedFragment {
  bool front;             ///< its triangle's facing
  bool passes_depth;      ///< the depth test's answer
  const Shaded& shaded;   ///< stage 9's
  std::uint8_t* stencil;  ///< the pixel's value; may be null where the draw has no stencil test
};
/// Stage 10: whether the fragment is not discarded and passes alpha, stencil and depth test, in this order (OpenGL 2.1
/// spec, chapter 4.1). A stencil test changes the pixel's value.
bool passes_tests(const Stages& stages, const Draw& draw, const TestedFragment& fragment, float color_scale);

/// Stage 11 of a fragment that is drawn: the stored colour by the blend equation, the logic op or as the fragment's,
/// in the channels of the mask.
void write_color(const Stages& stages, const Merge& state, const Color<float>& color, float color_scale,
                 const FramePixel& to);

}  // namespace plumbline::pipeline
