// A scene's textures in GL. Each level is uploaded as the scene has it: GL's automatic generation would make others.
#pragma once

#include <string>
#include <vector>

#include "reference/osmesa/gl/gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

/// GLSL 1.20 statements that apply the draw's texture environment to `vec4 color`, from `uniform sampler2D image`;
/// empty without a texture. (texture2D fills in components that a format lacks: OpenGL 2.1 spec, table 3.21.)
std::string environment_of(const Scene& scene, const Draw& draw);

class TexturesInGl {
 public:
  /// Uploads all textures; keeps references to `gl` and `scene`. Throws RendererFailed where GL refuses a texture.
  TexturesInGl(const Gl& gl, const Scene& scene);
  ~TexturesInGl();
  TexturesInGl(const TexturesInGl&) = delete;
  TexturesInGl& operator=(const TexturesInGl&) = delete;

  // Call within a PassState.
  void set(const Draw& draw) const;  ///< sets the draw's texture and environment; without a texture, texturing is off
  /// Sets the draw's texture with the environment REPLACE. Fragments of colour (0, 0, 0, 1) become the texture source,
  /// as components that a format lacks stay the fragment's (OpenGL 2.1 spec, table 3.22).
  void set_source(const Draw& draw) const;

 private:
  void upload(const Texture& texture) const;

  const Gl& gl_;
  const Scene& scene_;
  std::vector<GLuint> names_;
};

}  // namespace plumbline::osmesa
