// Stage 2: each vertex is lit, or takes its own colour.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::pipeline {

/// Appends one colour per vertex of the draw, clamped to [0,1].
///
/// Lit: GL 2.1 spec, section 2.14.1, with an infinite viewer (the half vector is that of the light and +z), one side,
/// no attenuation; where a normal faces away from a light, its diffuse and specular terms are 0. Unlit: the mesh's
/// colour, or the material's diffuse.
void light(const Scene& scene, const Draw& draw, std::span<const Vertex<float>> vertices, std::vector<Lit<float>>& out);

}  // namespace plumbline::pipeline
