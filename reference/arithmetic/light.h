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

/// The scene's lights in eye space.
using Lights = std::span<const LightSource<double>>;
/// Built by matrices.h, unrounded.
std::vector<LightSource<double>> light_sources(const Scene& scene);

/// glMaterial in double.
struct DoubleMaterial {
  glm::dvec4 ambient, diffuse, specular, emission;
  double shininess;
};
/// The draw's, what follows the vertex colour being `color` (2.14.3) where its mesh has colours.
/// That part of it: the face's; the specular colour alone, or where the light model keeps that apart, all but it.
DoubleMaterial material_of(const Scene& scene, const Draw& draw, LitPart part, const glm::dvec4& color);
/// At the mesh's vertex number `vertex`.
DoubleMaterial material_at(const Scene& scene, const Draw& draw, LitPart part, std::uint32_t vertex);

/// The lit colour at a point: rgba, clamped to [0,1]; alpha is the material's diffuse alpha. `lights`: one for each of
/// the scene's. 0^0 is 1, and a vector without a direction (a light at the point itself) has a dot product of 0 with
/// everything.
glm::dvec4 light(const Scene& scene, const DoubleMaterial& material, Lights lights, glm::dvec3 p_eye, glm::dvec3 n_eye);

/// The colour of a fragment that is lit: at its interpolated vertex colour, normal (of any length) and position.
glm::dvec4 fragment_light(const Scene& scene, const Draw& draw, LitPart part, Lights lights, const glm::dvec4& color,
                          glm::dvec3 n, glm::dvec3 p_eye);

/// rgb of the two added up, the first's alpha; clamped to [0,1], alpha too (OpenGL 2.1 spec 3.9).
glm::dvec4 color_sum(const glm::dvec4& primary, const glm::dvec4& secondary);

/// The colour of the mesh's vertex number `vertex`: lit, or where the draw's vertices are not, the mesh's colour there,
/// or where it has none, the material's diffuse colour. rgba, clamped to [0,1]. Of the back, the normal is turned over;
/// the secondary part has no alpha.
glm::dvec4 vertex_color(const Scene& scene, const Draw& draw, Lights lights, std::uint32_t vertex, glm::dvec3 p_eye,
                        glm::dvec3 n_eye, LitPart part = {});

/// A normal as the draw has it: `n` by the normal matrix, brought to unit length, rescaled (2.11.3) or neither.
glm::dvec3 normal_in_eye_space(Normals normals, const glm::dmat3& normal_matrix, glm::dvec3 n);

}  // namespace plumbline::math
