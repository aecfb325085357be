// Coverage and winners of a renderer that shows pictures alone: found by scenes that are made for it.
#pragma once

#include <cstdint>

#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline {

/// The most primitives of a scene that is probed: each is a picture.
inline constexpr std::size_t kMostProbes = 4096;

/// The scene with one primitive alone: white on black, no test, nothing blended, so that its pixels are those covered.
Scene primitive_alone(const Scene& scene, std::uint32_t primitive);
/// The scene whose colours tell the winners: each primitive has one colour, nothing is blended; depth and stencil tests
/// are the scene's. `winner_of` takes a colour back that is rounded to the nearest or down, or as `rounding` says.
Scene primitives_by_color(const Scene& scene, Conventions::Rounding rounding = Conventions::Rounding::nearest);
std::int32_t winner_of(const glm::vec4& color);

/// Adds to a capture the planes of coverage (count, id_sum) and of winners (id) that it lacks, from pictures that the
/// renderer draws of these scenes. Winners only where no draw tests alpha and the frame has no stencil values. Throws
/// what the renderer throws, and Unsupported for more than kMostProbes primitives, for pictures without planes.color,
/// and where winners are drawn in colours of no primitive, or encoded (Conventions::color_encoding).
void add_probed_planes(const Scene& scene, Renderer& renderer, Capture& capture);

}  // namespace plumbline
