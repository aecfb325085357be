// Probes: coverage and winners of a renderer that shows pictures alone, found from pictures of scenes made for it.
#pragma once

#include <cstdint>

#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline {

/// Largest number of primitives of a probed scene; each primitive costs one picture.
inline constexpr std::size_t kMostProbes = 4096;

/// The scene with one primitive alone: white on black, in a frame cleared to depth 1, nothing blended, so that its
/// pixels are those covered. `func`: always; or less_equal, which every depth of [0,1] passes, too; or less, which all
/// but 1 pass.
Scene primitive_alone(const Scene& scene, std::uint32_t primitive, DepthFunc func = DepthFunc::always);
/// The scene whose colours tell the winners: each primitive has one colour, nothing is blended; depth and stencil tests
/// are the scene's. `rounding`: how the renderer rounds colours to 8-bit codes.
Scene primitives_by_color(const Scene& scene, Conventions::Rounding rounding = Conventions::Rounding::nearest);
/// The primitive that primitives_by_color() draws in this colour; kBackground for black, 255^3 for a colour of none.
std::int32_t winner_of(const glm::vec4& color);

/// Adds planes to a capture from the renderer's pictures of primitive_alone() and primitives_by_color(): count and
/// id_sum, where the capture has neither; id, where it has none, no draw tests alpha, and the frame has no stencil
/// values. Throws what the renderer throws, and Unsupported for more than kMostProbes primitives, for pictures without
/// planes.color, and where winners are drawn in colours of no primitive, or encoded (Conventions::color_encoding).
void add_probed_planes(const Scene& scene, Renderer& renderer, Capture& capture);

}  // namespace plumbline
