// Stages 0 to 2 in double: matrices, vertices, vertex colours.
#pragma once

#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Stage 0: the matrices of each draw, unrounded.
std::vector<Matrices<double>> make_matrices(const Scene& scene);

/// Stage 1: all draws' vertices. p_clip = (projection * model_view) * p_model; n_eye is normalised, rescaled or
/// neither, by Draw::normals. Throws std::invalid_argument where `matrices` has not one entry per draw, or a mesh not
/// as many normals as positions.
std::vector<Vertex<double>> transform_vertices(const Scene& scene, const std::vector<Matrices<double>>& matrices);

/// The recorded lights; if none are recorded, the scene's, unrounded. Throws std::invalid_argument where another number
/// of lights is recorded than the scene has.
std::vector<LightSource<double>> lights_of(const Scene& scene, const Records<double>& records);

/// Stage 2: a colour per vertex, from records.vertices and lights_of(). Throws std::invalid_argument where the records
/// do not fit the scene.
std::vector<Lit<double>> light_vertices(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::exact
