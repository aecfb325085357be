// Comparators of stage 3: clip polygons of two captures. Those of renderers that leave the sides of the view volume to
// the raster are cut first.
#pragma once

#include "capture/capture.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Colours of the vertices of flat draws: all the provoking vertex', or each vertex' own.
enum class FlatColors { provoking, own };

/// Compares clip polygons, primitive by primitive. Both sides must have the same number of vertices; a vertex of the
/// mesh must be in the same place; a cut vertex must lie on the clip planes of its counterpart and in the plane of its
/// triangle, colour included. Where a corner lies within `factor` u of a clip plane, the number of vertices is
/// ambiguous. `copies`: error of a vertex of the mesh [u of its triangle's largest coordinate, or channel], for a
/// renderer that keeps clip positions in another form; a cut vertex within `copies` + `factor` u of a corner then
/// counts as the corner, and a triangle without area, to `factor` u, may have any polygon along itself, or none.
Measurement compare_polygons(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                             double factor, FlatColors of_flat = FlatColors::provoking, double copies = 0);
/// Compares positions of clip polygons. Tolerance: `factor` u of |p_clip| + |w|, per coordinate; for references that
/// rebuild p_clip from window positions.
Measurement compare_polygon_positions(const Records<double>& candidate, const Records<double>& reference,
                                      double factor);

/// Roundings of a stranger's clip positions that no plane cuts [u of the triangle's largest coordinate]: of a view
/// volume [0,w] in z, z' = (z + w) / 2 is rounded, which 2 z' - w doubles, and that difference is rounded again
/// (largest seen: 1.2 u).
inline constexpr double kCopiedVertices = 4;

/// Records with their polygons cut at the sides of the view volume, in double: a renderer may cut at a side, farther
/// out (guard band), or not at all, since no pixel of the frame lies beyond. A polygon is cut at a side if one of its
/// vertices is beyond it by more than rounding: kCopiedVertices of a vertex of the mesh, `factor` u more of a cut one.
/// Polygons wholly beyond a side are left out; lines, points, and polygons with a vertex of w <= 0, which no rasterizer
/// can place, stay unchanged. Varyings are not cut: their columns no longer fit the vertices.
Records<double> cut_at_sides(const Scene& scene, Records<double> records, double factor);

}  // namespace plumbline::check
