// Stage 3 in double: triangles are assembled and cut at the view volume -w <= x, y, z <= w.
#pragma once

#include <array>
#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Number of clip planes.
inline constexpr int kPlanes = 6;
inline constexpr int kSides = 4;  ///< number without near and far, which do not cut under depth clamp
/// Coefficients of clip plane `index`: inside is dot(plane, p_clip) >= 0. Right, left, top, bottom, near, far.
glm::dvec4 clip_plane(int index);

/// What is left of one triangle at the first `planes`, by Sutherland and Hodgman: no vertices, or 3 to 9, in the
/// triangle's sense of rotation. Only planes that one of its corners violates cut it. A cut is taken from the inside
/// end of the edge, so that triangles which share the edge share the cut. Colours are cut at the same place.
std::vector<ClipVertex<double>> clip_triangle(const std::array<ClipVertex<double>, 3>& corners, int planes = kPlanes);

/// What is left of a line between two vertices: none, or two. Of all t in [0,1], those whose a + t (b - a) is inside
/// are an interval; its ends are the line's.
std::vector<ClipVertex<double>> clip_line(const ClipVertex<double>& a, const ClipVertex<double>& b,
                                          int planes = kPlanes);

/// Stage 3; a point inside is left as it is. Primitives with a corner that is not finite, and those that lie outside,
/// leave no polygon. Throws std::invalid_argument where the records do not fit the scene.
ClipPolygons<double> clip_primitives(const Scene& scene, const std::vector<Vertex<double>>& vertices,
                                     const std::vector<Lit<double>>& lit, bool flat_applies = true);

}  // namespace plumbline::exact
