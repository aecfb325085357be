// The light equation as a GLSL 1.20 program, for light that OpenGL's fixed function lacks or Mesa gets wrong: the only
// shader that replaces the fixed function in the reference's pictures.
#pragma once

#include <string>

#include "scene/scene.h"

namespace plumbline::osmesa {

/// Whether the draw's light is not the fixed function's: light per fragment, note 000's (R.E)^s, GzRender's flipped
/// normals, or a case that Mesa gets wrong.
bool needs_light_program(const Scene& scene, const Draw& draw);

/// Source of a vertex shader that transforms as the fixed function does and lights by the scene's model, or not at all
/// where the draw is lit per fragment. It reads GL's state: lights, material, matrices.
std::string light_vertex_shader(const Scene& scene, const Draw& draw);

/// Source of a fragment shader of light, texture environment, colour sum and fog; empty where the draw is not lit per
/// fragment, and the fixed function makes the fragments.
std::string light_fragment_shader(const Scene& scene, const Draw& draw);

}  // namespace plumbline::osmesa
