// Stage 2: the attributes of each vertex, its lit colour first.
#pragma once

#include <span>
#include <vector>

#include "kernels/light_equation.h"
#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Appends one record per vertex of the draw; attributes that the draw does not carry are zero. `lights`: stage 0's.
///
/// Colours are clamped to [0,1]. Lit: by light_equation.h, with the draw's material or what of it the mesh's colours
/// stand for (2.14.3). Unlit, or to be lit per fragment: the mesh's colour, or the material's diffuse.
void light(const Scene& scene, const Draw& draw, const Mesh& mesh, Lights lights,
           std::span<const Vertex<float>> vertices, std::vector<Attributes>& out);

/// One part of a lit draw's colours, into one attribute of each of `out`, which lie beside `vertices`; of a secondary
/// part, alpha is 0. `attribute`: 0 the colour, 1 + v a Varying.
void light_part(const Scene& scene, const Draw& draw, const Mesh& mesh, LitPart part, Lights lights,
                std::span<const Vertex<float>> vertices, std::size_t attribute, std::span<Attributes> out);

}  // namespace plumbline::pipeline
