// Stage 9: a fragment's colour from its attributes.
#pragma once

#include <array>
#include <vector>

#include "capture/stages.h"
#include "reference/arithmetic/light.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// A fragment's varyings, indexed by Varying; 0 where its draw does not carry one.
using Fours = std::array<glm::dvec4, kVaryings>;

/// The fragment's colour: light (where the draw is lit per fragment), texture environment, colour sum and fog, in this
/// order (OpenGL 2.1 spec, figure 3.1). `front`: the fragment's face. `texel`: texture source components, where the
/// draw has a texture.
glm::dvec4 shade(const math::LitDraw& lit, bool front, const glm::dvec4& color, const Fours& fours,
                 const glm::dvec4& texel);

/// Stage 9: shade() of each of records.covered, with lights_of() (geometry.h). Throws std::invalid_argument where the
/// records do not fit the scene or each other.
std::vector<Shaded<double>> shade_fragments(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
