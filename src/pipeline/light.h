// Stage 2: each vertex is lit, or takes its own colour.
#pragma once

#include <span>
#include <vector>

#include "capture/stages.h"
#include "pipeline/light_equation.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Appends one colour per vertex of the draw, clamped to [0,1].
///
/// Lit: by light_equation.h, with the draw's material or what of it the mesh's colours stand for (2.14.3). Unlit,
/// or to be lit per fragment: the mesh's colour, or the material's diffuse. `lights`: stage 0's.
void light(const Scene& scene, const Draw& draw, Lights lights, std::span<const Vertex<float>> vertices,
           std::vector<Lit<float>>& out);

/// One part of a lit draw's colours; of the secondary one, alpha is 0.
void light_part(const Scene& scene, const Draw& draw, LitPart part, Lights lights,
                std::span<const Vertex<float>> vertices, std::vector<Vec4<float>>& out);

}  // namespace plumbline::pipeline
