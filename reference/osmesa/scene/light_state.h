// Lights, materials and normals as GL's fixed function has them (OpenGL 2.1 spec 2.14).
#pragma once

#include "reference/osmesa/gl/gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

/// Light model and lights; leaves MODELVIEW the identity. Call within a PassState.
void set_lights(const Gl& gl, const Scene& scene);

/// Of a draw that is lit: material, what of it follows the vertex colour, and what becomes of normals.
void set_material(const Gl& gl, const Scene& scene, const Draw& draw);

}  // namespace plumbline::osmesa
