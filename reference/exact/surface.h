// Stage 9: a fragment's colour from its attributes.
#pragma once

#include <array>
#include <vector>

#include "capture/stages.h"
#include "reference/arithmetic/light.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// A fragment's varyings, those that its draw carries.
using Fours = std::array<glm::dvec4, kVaryings>;

/// Texture environment, sum of colours, fog, in this order (OpenGL 2.1 spec, figure 3.1). `front`: its face. `texel`:
/// the texture source's components, where the draw has a texture. `lights`: the scene's, in eye space.
glm::dvec4 shade(const Scene& scene, const Draw& draw, math::Lights lights, bool front, const glm::dvec4& color,
                 const Fours& fours, const glm::dvec4& texel);

/// Colour of each of records.covered, lit by lights_of() (geometry.h). Throws std::invalid_argument where the records
/// do not fit the scene or each other.
std::vector<Shaded<double>> shade_fragments(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
