// Stages 6 to 11 of one fragment: what the stage functions (stages.h) are called with.
#pragma once

#include "pipeline/frame.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// The lower left pixel of the tile that the pixel lies in.
inline glm::ivec2 anchor_of(glm::ivec2 pixel) { return pixel / kTile * kTile; }

/// Planes of stages 6 to 8 for the fragments of the tile at `anchor`; of attributes, the colour and those of `surface`.
TriangleSetup set_up(const Stages& stages, const ShadedTriangle& triangle, const Surface& surface,
                     const DepthState& depth, const SampleOffsets& offsets, glm::ivec2 anchor);

/// The pixel's centre.
inline Pixels<float> pixel_at(glm::ivec2 pixel) { return {pixel.x, pixel.y, pixel.x + 0.5, pixel.y + 0.5}; }

/// Stage 7 of all attributes that the surface carries.
SurfaceAttributes<float> interpolated(const Stages& stages, const Surface& surface, const TriangleSetup& setup,
                                      const Pixels<float>& pixel);
/// Stage 8 at a fragment of a surface with a texture.
FilteredTexel<float> filtered(const Stages& stages, const TextureSetup& texture, const TriangleSetup& setup,
                              const Color<float>& texcoords, const Pixels<float>& pixel);

/// Stage 10: whether the fragment passes alpha, stencil and depth test, in this order (OpenGL 2.1 spec, chapter 4.1).
/// `nearer`: the depth test's answer. The stencil value `held` changes where the draw has a stencil test.
bool passes_tests(const Stages& stages, const Draw& draw, bool front, bool nearer, const Shaded& shaded,
                  float color_scale, std::uint8_t* held);

/// Stage 11 of a fragment that is drawn: colour by the blend equation, the logic op or as it is, and depth, as far as
/// the masks allow.
void write_fragment(const Stages& stages, const Merge& state, float z, const Color<float>& color, float color_scale,
                    const FramePixel& to);

}  // namespace plumbline::pipeline
