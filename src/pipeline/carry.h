// Varyings: what goes the colour's way through clip, window and attributes (varying.h).
#pragma once

#include <span>
#include <vector>

#include "capture/stages.h"
#include "pipeline/light_equation.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Appends the varying of each of the draw's vertices; zeros where the draw does not carry it. `lights`: stage
/// 0's.
void carry(const Scene& scene, const Draw& draw, Varying varying, Lights lights,
           std::span<const Vertex<float>> vertices, std::vector<Vec4<float>>& out);

/// The shading that a varying is assembled under: lit ones as the draw's colours, others never flat.
inline Shading shading_of(const Draw& draw, Varying v) { return is_lit(v) ? draw.shading : Shading::gouraud; }

}  // namespace plumbline::pipeline
