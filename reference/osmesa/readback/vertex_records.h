// GL's records of stages 0 to 2.
#pragma once

#include <vector>

#include "reference/osmesa/scene/scene_in_gl.h"

namespace plumbline::osmesa {

/// Loads each draw's matrices into GL and reads them back; the normal matrix is computed from the model-view matrix.
/// Call within a PassState, with a Target bound.
std::vector<Matrices<double>> read_matrices(const Gl& gl, const SceneInGl& scene);

/// A vertex program that computes what the fixed function does and outputs it; to be made once per context.
class VertexProgram {
 public:
  explicit VertexProgram(const Gl& gl);

  /// All draws' vertices by transform feedback. Call as read_matrices(). Throws RendererFailed.
  std::vector<Vertex<double>> run(const SceneInGl& scene) const;

 private:
  const Gl& gl_;
  Program program_;
  GLint normals_;  ///< location of the uniform that selects the normals' treatment (scene.h, Normals)
};

/// Reader of vertex colours; to be made once per context.
class VertexColors {
 public:
  explicit VertexColors(const Gl& gl);

  /// The lit colours of all draws' vertices, each drawn as a point of one pixel. (Feedback mode would return them, too,
  /// but Mesa compiles each vertex shader once more for it, and keeps none of these.) Call as read_matrices(); leaves
  /// another target bound. Throws RendererFailed.
  std::vector<Lit<double>> read(const SceneInGl& scene) const;

 private:
  const Gl& gl_;
  Program primary_;  ///< fragment program that outputs the primary colour
};

}  // namespace plumbline::osmesa
