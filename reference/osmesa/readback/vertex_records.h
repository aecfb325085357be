// What GL tells of stages 0 to 2.
#pragma once

#include <vector>

#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// Loads each draw's matrices and reads GL's own back. Call within a PassState, a Target bound.
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
  GLint normals_;  ///< location of the uniform that selects the normals' treatment (scene.h, Normals)
};

/// The vertices' colours; made once per context.
class VertexColors {
 public:
  explicit VertexColors(const Gl& gl);

  /// All draws' vertices, lit: each drawn as a point that is a pixel. (Feedback mode would hand them out, too, but
  /// Mesa compiles each vertex shader once more for it, and keeps none of these.) Call as read_matrices; leaves another
  /// target bound.
  std::vector<Lit<double>> read(const SceneInGl& scene) const;

 private:
  const Gl& gl_;
  Program primary_;  ///< its fragments have the primary colour
};

}  // namespace plumbline::osmesa
