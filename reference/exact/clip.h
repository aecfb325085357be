// Stage 3 in double: primitives are assembled and clipped to the view volume -w <= x, y, z <= w.
#pragma once

#include <array>
#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Number of clip planes.
inline constexpr int kPlanes = 6;
inline constexpr int kSides = 4;  ///< number without near and far, which do not cut under depth clamp
/// Coefficients of clip plane `index`, in the order right, left, top, bottom, near, far: inside is dot(plane, p_clip)
/// >= 0. Throws std::invalid_argument for an index beyond [0, kPlanes).
glm::dvec4 clip_plane(int index);

/// Part of a triangle inside the first `planes` clip planes, by Sutherland and Hodgman: no vertices, or 3 to 9, in the
/// triangle's winding. Only planes that a corner violates cut it. Cuts are computed from the edge's inside end, so that
/// triangles that share the edge share the cut. Colours are interpolated by the cut's parameter.
std::vector<ClipVertex<double>> clip_triangle(const std::array<ClipVertex<double>, 3>& corners, int planes = kPlanes);

/// Part of a line inside the first `planes` clip planes: the points a + t (b - a), t in [0,1], that are inside. Two
/// vertices, or none.
std::vector<ClipVertex<double>> clip_line(const ClipVertex<double>& a, const ClipVertex<double>& b,
                                          int planes = kPlanes);

/// Stage 3: polygons of all primitives, in draw order; a point is kept or dropped. Primitives outside, or with a corner
/// that is not finite, leave no polygon. Under flat shading, if `flat_applies` (lit colours alone), all corners have
/// the provoking vertex' colour. Throws std::invalid_argument where the records do not fit the scene.
ClipPolygons<double> clip_primitives(const Scene& scene, const std::vector<Vertex<double>>& vertices,
                                     const std::vector<Lit<double>>& lit, bool flat_applies = true);

}  // namespace plumbline::exact
