// The light equation as a GLSL 1.20 program, where OpenGL's fixed function has no such light: the one place where a
// shader takes its part.
#pragma once

#include <string>

#include "scene/scene.h"

namespace plumbline::osmesa {

/// Whether the draw's light is none of the fixed function's: per fragment, note 000's (R.E)^s, GzRender's turned
/// normals, or a case that Mesa has wrong.
bool needs_light_program(const Scene& scene, const Draw& draw);

/// A vertex shader that does what the fixed function does, but light by the scene's model, or, where that is per
/// fragment, none. It reads GL's own state: lights, material, matrices.
std::string light_vertex_shader(const Scene& scene, const Draw& draw);

/// What lights the fragments, and fogs them; empty where the fixed function makes them.
std::string light_fragment_shader(const Scene& scene, const Draw& draw);

}  // namespace plumbline::osmesa
