// Planes of a triangle, for stages 6 to 8.
#pragma once

#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// The lower left pixel of the tile that the pixel lies in.
inline glm::ivec2 anchor_of(glm::ivec2 pixel) { return pixel / kTile * kTile; }

/// For the fragments of the tile at `anchor`; those of `surface` are set up alone.
TriangleSetup set_up(const Stages& stages, const ShadedTriangle& triangle, const Surface& surface,
                     const DepthState& depth, const SampleOffsets& offsets, glm::ivec2 anchor);

inline Pixels<float> pixel_at(glm::ivec2 pixel) { return {pixel.x, pixel.y, pixel.x + 0.5, pixel.y + 0.5}; }

/// Stage 7 of all attributes that the surface carries.
SurfaceAttributes<float> interpolated(const Stages& stages, const Surface& surface, const TriangleSetup& setup,
                                      const Pixels<float>& pixel);
/// Stage 8 at a fragment of a surface with a texture.
FilteredTexel<float> filtered(const Stages& stages, const TextureSetup& texture, const TriangleSetup& setup,
                              const Color<float>& texcoords, const Pixels<float>& pixel);

}  // namespace plumbline::pipeline
