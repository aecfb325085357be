// Stage 3: primitives are assembled and cut at the six planes of the view volume.
#pragma once

#include <span>

#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// The primitive whose vertices are `corners`: 3 of a triangle, the first 2 of a line, the first of a point. Under flat
/// shading every corner has the provoking (last) vertex' lit colours (OpenGL 2.1 spec 2.14.7).
Polygon assemble(const DrawInput& input, const glm::uvec3& corners, std::span<const Vertex<float>> vertices,
                 std::span<const Attributes> attributes);

/// Cuts it to -w <= x, y, z <= w (of a draw with depth clamp, x and y alone). One that lies outside loses all corners,
/// and so does one with a coordinate that is not finite.
///
/// Triangles: Sutherland-Hodgman (Reentrant polygon clipping, CACM 1974), planes in the order right, left, top, bottom,
/// near, far, those only that a vertex violates. A cut is taken from the end that is nearer to the plane (a tie: the
/// inside end), whichever way the edge runs, so that neighbours cut a shared edge at the same point.
///
/// A line is cut at either end by the farthest of the cuts that the planes make there (Liang and Barsky, A new concept
/// and method for line clipping, TOG 1984); a point is kept or dropped (OpenGL 2.1, section 2.12).
void clip(const DrawInput& input, Polygon& polygon);

/// The same at other planes: inside is dot(plane, p_clip) >= 0. At most six.
void clip_at(std::span<const Vec4<float>> planes, Polygon& polygon);

/// -w <= x, y, z <= w, in the order above.
std::span<const Vec4<float>, 6> view_volume();

}  // namespace plumbline::pipeline
