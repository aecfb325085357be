// Stages 0 to 4, from the scene to window triangles. Each stage stands in a source file of its name.
#pragma once

#include <span>
#include <vector>

#include "kernels/light_equation.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

// 0. A draw's transforms, camera and projection (dialect.h) become matrices; the camera takes lights to eye space.

/// Matrices of a draw, built in double, rounded once to float (entries of magnitude below 1e-12 become 0). Throws
/// std::invalid_argument where the projection is not one of the scene's dialect.
Matrices<float> matrices(const Scene& scene, const Draw& draw);

/// The scene's lights (at most 8) in eye space, built in double, rounded once to float.
FixedVector<LightSource<float>, 8> light_sources(const Scene& scene);

// 1. Each vertex of the mesh, once, from model space to eye and clip space.

/// Product P M of transform()'s recipe.
Mat4<float> clip_matrix(const Matrices<float>& matrices);

/// Appends one record per vertex of the mesh, which has as many normals as positions.
///
/// p_clip = (P M) p, both products in float, summed left to right without FMA: the recipe of a common OpenGL driver, so
/// that positions, and with them coverage, can be compared bit for bit. Normals go by the inverse transpose. Then
/// they are brought to unit length (NaN for a zero normal), or divided by the length of that matrix' third column
/// (OpenGL 2.1 spec 2.11.3: the third row of the inverse), or stay as they are.
void transform(const Matrices<float>& matrices, Normals normals, const Mesh& mesh, std::vector<Vertex<float>>& out);

// 2. The attributes of each vertex, its lit colour first.

/// Appends one record per vertex of the draw; attributes that the draw does not carry are zero.
///
/// Colours are clamped to [0,1]. Lit: by light_equation.h, with the draw's material, in which the mesh's colours
/// replace what the draw's ColorMaterial names (2.14.3). Unlit, or to be lit per fragment: the mesh's colour, or the
/// material's diffuse.
void light(const LightInput& in, std::vector<Attributes>& out);

// 3. Primitives are assembled and cut at the six planes of the view volume.

/// Primitive of the vertices `corners`: 3 of a triangle, the first 2 of a line, the first of a point; its number is
/// left 0. Under flat shading every corner has the colours of the provoking (last) vertex (OpenGL 2.1 spec 2.14.7).
Polygon assemble(const DrawInput& input, const glm::uvec3& corners, std::span<const Vertex<float>> vertices,
                 std::span<const Attributes> attributes);

/// Cuts the polygon to -w <= x, y, z <= w; under depth clamp, to -w <= x, y <= w. A polygon that lies outside, or has a
/// coordinate that is not finite, loses all corners.
///
/// Triangles: Sutherland-Hodgman (Reentrant polygon clipping, CACM 1974), by each plane that an original vertex
/// violates, in the order right, left, top, bottom, near, far. A cut is taken from the end that is nearer to the
/// plane (a tie: the inside end), whichever way the edge runs, so that neighbours cut a shared edge at the same point.
///
/// A line is cut at either end by the plane that cuts off most there (Liang and Barsky, A new concept and method for
/// line clipping, TOG 1984); a point is kept or dropped (OpenGL 2.1, section 2.12).
void clip(const DrawInput& input, Polygon& polygon);

/// clip() at other planes, at most six: inside is dot(plane, p_clip) >= 0.
void clip_at(std::span<const Vec4<float>> planes, Polygon& polygon);

/// Planes of -w <= x, y, z <= w, in clip()'s order.
std::span<const Vec4<float>, 6> view_volume();

// 4. Polygons are divided by w, moved to the window, split into triangles, snapped and faced.

/// Appends a polygon's fan of triangles, corners (i-1, i, 0); a line or point as it is; of a polygon that the draw does
/// not fill, its edges or corners (capture/stages.h). Where the draw is lit from two sides, back faces have the back's
/// colours. Dropped: triangles of zero snapped area, what the draw culls, and polygons, lines and points with a corner
/// that is not drawable: |x| or |y| beyond 2^20 pixels, or z or 1/w not finite.
///
/// p_win = p_clip * (1/w) * scale + translate: the last two operations are one FMA for vertices of the mesh and two
/// roundings for cut ones, as in the driver whose recipe transform() follows.
void to_window(const DrawInput& input, const Polygon& polygon, std::vector<ShadedTriangle>& out);

}  // namespace plumbline::pipeline
