// Error bounds from number format and formula: largest difference between a stage's formula in float and in double.
// u = 2^-24 is the unit roundoff of float. The factors are in the ledger.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture/conventions.h"
#include "capture/stages.h"
#include "reference/arithmetic/bounded.h"
#include "scene/draw_index.h"
#include "scene/scene.h"

namespace plumbline::check {

using math::kFloatRounding;
using math::kFlushedUnderflow;
using math::kGradualUnderflow;
using math::Roundings;

/// Barycentric weights at a point, and their slopes [1/pixel]. Triangle: of the unsnapped corners (stages.h, 6); of the
/// snapped ones where the unsnapped area contradicts the facing. Line: by projection.
struct Barycentrics {
  Vec3<double> value, d_dx, d_dy;
};

/// Weights of the point (x, y) [pixel]; their sum is 1. Not finite where the snapped corners have no area either.
Barycentrics barycentrics(const WindowTriangle<double>& triangle, double x, double y);
/// Weights of the point's projection onto a line; value[1] is the share of the way to the line's second end.
Barycentrics along_line(const WindowTriangle<double>& line, double x, double y);

/// Absolute slopes of the depth in x and y [window z per pixel].
glm::dvec2 depth_slopes(const WindowTriangle<double>& triangle);

/// |M| |p|, the magnitude of the rounding errors of M p.
Vec4<double> magnitude(const Mat4<double>& m, const Vec4<double>& p);

/// Magnitude of a unit normal N n / |N n|: the length of |N| |n| over the length of N n.
double normal_magnitude(const Mat3<double>& n_matrix, const Vec3<double>& n);

/// Magnitude of a unit normal for a renderer that inverts the model-view M in float, as Mesa does: length of |N| |M|^T
/// |N| |n| over the length of N n. An error e |M| of M moves the unit normal by e times this magnitude.
double inverted_normal_magnitude(const Mat4<double>& model_view, const Mat3<double>& n_matrix, const Vec3<double>& n);

/// Error bounds of a plane's value at a pixel centre: of depth, and of the colour's four channels.
struct PlaneBounds {
  double depth;        ///< [u of window z]
  Vec4<double> color;  ///< [u], to first order; where `inv_w` is large, use color_error()
  double inv_w = 0;    ///< relative error of the interpolated 1/w [u]
  /// Line: value interpolated by the position on the major axis, as by llvmpipe, less the value at the centre's
  /// projection onto the line (OpenGL 2.1, equation 3.5); signed [window z; colour].
  double line_shift_depth = 0;
  Vec4<double> line_shift_color{0};

  /// Error of a colour whose planes have `factor` times the errors above: (E(c/w) + |c| E(1/w)) / (1/w - E(1/w));
  /// infinite where 1/w may be 0.
  Vec4<double> color_error(double factor) const;
};

/// Clamp range of a primitive's depths [window z]: its draw's depth range, sorted, under depth_clamp, else [0,1].
struct DepthLimits {
  double low = 0, high = 1;
};
DepthLimits depth_limits(const DrawIndex& draws, std::int32_t primitive);

/// Bounds for a renderer that evaluates a = a0 + da/dx x + da/dy y in float from the window's origin, as llvmpipe does:
/// |a|max + |da/dx| (x + x0) + |da/dy| (y + y0), x0 and y0 the corners' largest |x| and |y|, plus the gradients' own
/// error, which grows with the inverse of the area, times the distance from the corners. Colour: such bounds E of c/w
/// and of 1/w, joined by the division: (E(c/w) + |c| E(1/w)) w. Line: the larger bound of both interpolations
/// (PlaneBounds), which differ where 1/w differs much between the ends. Flushing of gradients and results to zero is
/// included. Infinite where area_may_vanish().
PlaneBounds bounds_from_origin(const WindowTriangle<double>& triangle, int x, int y, const DepthLimits& limits = {});
/// Bounds of a primitive at a pixel, at least 1 [u]: the largest over those of its window triangles that come within a
/// pixel of the pixel's centre; where none does, over all. Line shifts: those of the edge nearest to the centre.
PlaneBounds primitive_bounds(const Records<double>& records, std::int32_t primitive, int x, int y,
                             const DepthLimits& limits = {});

inline constexpr auto kUnsnapped = [](const WindowVertex<double>& v) { return glm::dvec2(v.p_win); };
inline constexpr auto kSnapped = [](const WindowVertex<double>& v) { return glm::dvec2(v.snapped); };

/// Twice the signed area of the corners' positions, by kUnsnapped [pixel^2] or by kSnapped [(1/256 pixel)^2]. Positive:
/// counter-clockwise with y up.
template <class Place>
double twice_area(const WindowTriangle<double>& t, Place place) {
  const glm::dvec2 a = place(t.v[0]), b = place(t.v[1]) - a, c = place(t.v[2]) - a;
  return b.x * c.y - b.y * c.x;
}

/// True if a triangle's area, computed from its corners in float, may be 0; the planes are then undefined.
bool area_may_vanish(const WindowTriangle<double>& triangle);

/// True if a pixel's centre is in or beside the triangle: no barycentric below -1/64.
bool is_near(const WindowTriangle<double>& triangle, int x, int y);

/// View of the primitive's window triangles, possibly empty. `records.triangles` must be sorted by primitive.
std::span<const WindowTriangle<double>> triangles_of(const Records<double>& records, std::int32_t primitive);

/// Error that a polygon offset adds to a depth [u of window z], for a renderer that computes the slope in float and
/// offsets the corners: |factor| times (the error of a gradient in bounds_from_origin(), plus 4 times the slope), plus
/// 2 times the offset.
class OffsetErrors {
 public:
  explicit OffsetErrors(const Scene& scene, const Conventions& conventions = {});
  double of(const WindowTriangle<double>& triangle) const;
  /// The largest over the triangles that primitive_bounds() takes.
  double of(const Records<double>& records, std::int32_t primitive, int x, int y) const;
  /// Offset with the slope as the length of the depth's gradient, minus the offset with the slope as the gradient's
  /// larger component; both are legal (OpenGL 2.1 spec 3.5.5) [window z].
  double by_length(const WindowTriangle<double>& triangle) const;
  /// Offset with the slope of the plane through the snapped corners, minus that through the corners as they are
  /// [window z]; 0 where either has no area.
  double by_grid(const WindowTriangle<double>& triangle) const;

 private:
  double factor_of(const WindowTriangle<double>& triangle) const;

  DrawIndex draws_;
  Conventions conventions_;
  bool any_;  // whether any draw has an offset
};

/// Values that a pixel may hold where edges of an unfilled triangle meet: two per edge that lies within its width plus
/// two pixels of the pixel's centre, one by projection and one by the position on the major axis. Empty for fewer than
/// two edges.
struct EdgeValue {
  double depth;
  Vec4<double> color;
};
std::vector<EdgeValue> edge_values(std::span<const WindowTriangle<double>> edges, int x, int y,
                                   const DepthLimits& limits = {});

/// Corners of one triangle, drawn as points, that cover the pixel and may hide each other: their depths are within
/// `tie` [window z] and both rounding errors. Empty where no two tie.
std::vector<EdgeValue> tied_corners(std::span<const WindowTriangle<double>> corners, int x, int y, double tie);

}  // namespace plumbline::check
