// Stage 2 in double: a vertex' colour by the equations of the OpenGL 2.1 specification, section 2.14.1, and of note
// 000.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::math {

/// The scene's lights in eye space, one per Scene::lights.
using Lights = std::span<const LightSource<double>>;
/// The scene's lights taken to eye space by view_matrix() (matrices.h), unrounded.
std::vector<LightSource<double>> light_sources(const Scene& scene);

/// A draw of a scene, and the scene's lights in eye space.
struct LitDraw {
  const Scene& scene;
  const Draw& draw;
  Lights lights;
};

/// glMaterial in double.
struct DoubleMaterial {
  glm::dvec4 ambient, diffuse, specular, emission;
  double shininess;
};
/// The draw's material for one part of its lit colour: of the part's face; the specular colour alone for the secondary
/// part, and without it for the primary one where the light model separates the two. `color`: the vertex colour, which
/// replaces the colours of Draw::color_material (2.14.3) where the mesh has colours.
DoubleMaterial material_of(const Scene& scene, const Draw& draw, LitPart part, const glm::dvec4& color);
/// material_of() with the colour of the mesh's vertex number `vertex`.
DoubleMaterial material_at(const Scene& scene, const Draw& draw, LitPart part, std::uint32_t vertex);

/// The lit colour at a point: rgba, clamped to [0,1]; alpha is the material's diffuse alpha. 0^0 is 1. The dot products
/// of a vector of length 0 (to a light at the point itself) are 0.
glm::dvec4 light(const Scene& scene, const DoubleMaterial& material, Lights lights, glm::dvec3 p_eye, glm::dvec3 n_eye);

/// The lit colour of a fragment, from its interpolated vertex colour, normal (of any length) and position. For a back
/// face, the normal is negated here.
glm::dvec4 fragment_light(const LitDraw& lit, LitPart part, const glm::dvec4& color, glm::dvec3 n, glm::dvec3 p_eye);

/// Colour sum (OpenGL 2.1 spec 3.9): primary.rgb + secondary.rgb and primary's alpha, clamped to [0,1].
glm::dvec4 color_sum(const glm::dvec4& primary, const glm::dvec4& secondary);

/// The colour of the mesh's vertex number `vertex`: rgba, clamped to [0,1]. A draw that is lit per vertex has the lit
/// colour (for a back face, the normal is negated here; the secondary part has alpha 0). Any other draw has the mesh's
/// colour, or the material's diffuse colour where the mesh has none, whatever `part` is.
glm::dvec4 vertex_color(const LitDraw& lit, std::uint32_t vertex, glm::dvec3 p_eye, glm::dvec3 n_eye,
                        LitPart part = {});

/// The normal in eye space: normal_matrix * n, brought to unit length, rescaled (2.11.3) or neither.
glm::dvec3 normal_in_eye_space(Normals normals, const glm::dmat3& normal_matrix, glm::dvec3 n);

}  // namespace plumbline::math
