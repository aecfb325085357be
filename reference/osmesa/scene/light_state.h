// GL state of lights, materials and normals for the fixed function (OpenGL 2.1 spec 2.14).
#pragma once

#include "reference/osmesa/gl/gl.h"
#include "scene/scene.h"

namespace plumbline::osmesa {

/// Sets light model and lights; leaves the identity in MODELVIEW. Call within a PassState.
void set_lights(const Gl& gl, const Scene& scene);

/// Sets the materials of a lit draw, the colours that follow the vertex colour, and the treatment of normals.
void set_material(const Gl& gl, const Scene& scene, const Draw& draw);

}  // namespace plumbline::osmesa
