// Stages 0 to 2 in double: matrices, vertices, their colours.
#pragma once

#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Stage 0: one per draw, unrounded.
std::vector<Matrices<double>> make_matrices(const Scene& scene);

/// Stage 1: all draws' vertices. p_clip = (projection * model_view) * p_model; n_eye is normalised.
/// Throws std::invalid_argument where a mesh has not as many normals as positions.
std::vector<Vertex<double>> transform_vertices(const Scene& scene, const std::vector<Matrices<double>>& matrices);

/// The recorded lights; where there are none, the scene's, unrounded.
/// Throws std::invalid_argument where the records have another number of lights than the scene.
std::vector<LightSource<double>> lights_of(const Scene& scene, const Records<double>& records);

/// Stage 2: a colour per vertex, from records.vertices and lights_of().
std::vector<Lit<double>> light_vertices(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
