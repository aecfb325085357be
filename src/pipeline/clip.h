// Stage 3: triangles are assembled and cut at the six planes of the view volume.
#pragma once

#include <span>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// One draw's vertices and the triangles, lines or points that join them.
struct Assembly {
  std::span<const Vertex<float>> vertices;
  std::span<const Lit<float>> lit;  ///< beside vertices
  std::span<const glm::uvec3> triangles;
  std::uint32_t first_primitive = 0;  ///< the number of the first triangle
  Shading shading = Shading::gouraud;
  bool depth_clamp = false;  ///< no near and far plane
  Topology topology = Topology::triangles;
};

/// Appends a convex polygon per triangle that is not wholly outside -w <= x, y, z <= w.
///
/// Sutherland-Hodgman (Reentrant polygon clipping, CACM 1974), planes in the order right, left, top, bottom, near, far,
/// those only that a vertex violates. A cut is taken from the end that is nearer to the plane (a tie: the inside end),
/// whichever way the edge runs, so that neighbours cut a shared edge at the same point. Triangles with a coordinate
/// that is not finite are dropped.
///
/// A line is cut at either end by the farthest of the cuts that the planes make there (Liang and Barsky, A new concept
/// and method for line clipping, TOG 1984); a point is kept or dropped (OpenGL 2.1, section 2.12).
void clip(const Assembly& assembly, ClipPolygons<float>& out);

/// The same at planes of one's own: inside is dot(plane, p_clip) >= 0. At most six.
void clip_at(std::span<const Vec4<float>> planes, const Assembly& assembly, ClipPolygons<float>& out);

/// -w <= x, y, z <= w, in the order above.
std::span<const Vec4<float>, 6> view_volume();

}  // namespace plumbline::pipeline
