// A scene's textures in GL: every level uploaded as the scene has it, for automatic generation would make others.
#pragma once

#include <string>
#include <vector>

#include "reference/osmesa/gl/gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

/// The draw's environment as GLSL 1.20 that changes `vec4 color`, from `uniform sampler2D image`; empty without a
/// texture. (What a format lacks, texture2D fills in as OpenGL 2.1 spec, table 3.21.)
std::string environment_of(const Scene& scene, const Draw& draw);

class TexturesInGl {
 public:
  /// Keeps references. Throws RendererFailed where GL refuses.
  TexturesInGl(const Gl& gl, const Scene& scene);
  ~TexturesInGl();
  TexturesInGl(const TexturesInGl&) = delete;
  TexturesInGl& operator=(const TexturesInGl&) = delete;

  // Call within a PassState.
  void set(const Draw& draw) const;  ///< the draw's texture and environment; without one, texturing is off
  /// The draw's fragments become the texture source, (0, 0, 0, 1) without a texture, if their colour is (0, 0, 0, 1):
  /// what a format lacks comes from there (OpenGL 2.1 spec, table 3.22, REPLACE).
  void set_source(const Draw& draw) const;

 private:
  void upload(const Texture& texture) const;

  const Gl& gl_;
  const Scene& scene_;
  std::vector<GLuint> names_;
};

}  // namespace plumbline::osmesa
