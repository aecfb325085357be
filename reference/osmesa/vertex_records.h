// What GL tells of stages 0 to 2.
#pragma once

#include <vector>

#include "reference/osmesa/scene_in_gl.h"

namespace plumbline::osmesa {

/// Loads each draw's matrices and reads GL's own back. Call within a SavedState, a Target bound.
std::vector<Matrices<double>> read_matrices(const Gl& gl, const SceneInGl& scene);

/// A program that hands on what the fixed function computes of a vertex; made once per context.
class VertexProgram {
 public:
  explicit VertexProgram(const Gl& gl);

  /// All draws' vertices by transform feedback. Call as read_matrices.
  std::vector<Vertex<double>> run(const SceneInGl& scene) const;

 private:
  const Gl& gl_;
  Program program_;
  GLint normals_;  ///< where it is told what becomes of normals (scene.h, Normals)
};

/// All draws' vertices, lit, by feedback mode. Call as read_matrices.
std::vector<Lit<double>> read_lit(const Gl& gl, const SceneInGl& scene);

}  // namespace plumbline::osmesa
