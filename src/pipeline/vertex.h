// Stage 1: each vertex of the mesh, once, from model space to eye and clip space.
#pragma once

#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// P M, rounded as the recipe below has it.
Mat4<float> clip_matrix(const Matrices<float>& matrices);

/// Appends one record per vertex of the mesh.
///
/// clip = (P M) p, both products in float, summed left to right without FMA: the recipe of a common OpenGL driver, so
/// that positions, and with them coverage, can be compared bit for bit. Normals go by the inverse transpose; then they
/// are brought to unit length, or divided by the length of its third column (OpenGL 2.1 spec 2.11.3: the third row of
/// the inverse), or stay as they are.
void transform(const Matrices<float>& matrices, Normals normals, const Mesh& mesh, std::vector<Vertex<float>>& out);

}  // namespace plumbline::pipeline
