// Stage 6: the depth of each fragment.
//
// Depth is affine in the window, and so are barycentric coordinates, over w or not: planes in double serve depth here
// and attributes in stage 7. Planes go through the *unsnapped* positions; snapped positions decide coverage alone
// (planes through them would visibly move the colours of tiny triangles). In float, even the third bit of a sliver's
// depth may be wrong: hence double.
#pragma once

#include "kernels/lanes.h"
#include "kernels/window_triangle.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Function affine in the window: its value at an anchor, a pixel's centre nearby, and its slopes by x and y.
template <class W>
struct Affine {
  W at_0, x, y;
};
/// Offset of the point of evaluation from the anchor [pixels].
template <class R>
struct Offset {
  Wide<R> dx, dy;
};
/// Value of `f`: one function in double, or each lane's own in Wide<R>. The bracketed sum is the same along a row.
template <class R, class W>
[[gnu::always_inline]] inline Wide<R> value_at(const Affine<W>& f, const Offset<R>& from_anchor) {
  return (f.at_0 + from_anchor.dy * f.y) + from_anchor.dx * f.x;
}

/// a b - c d to within two roundings of the result, however close the products are (Kahan).
template <class W>
W difference_of_products(W a, W b, W c, W d) {
  const W cd = c * d;
  const W error = fused(-c, d, cd);
  return fused(a, b, -cd) + error;
}

/// Window positions that a triangle's planes go through [pixels]: corner 0, and the others' differences from it.
template <class W>
struct PlaneCorners {
  W p0_x, p0_y, d1_x, d1_y, d2_x, d2_y;
  W twice_area;
};
template <class W>
[[gnu::always_inline]] inline PlaneCorners<W> plane_corners(const W (&x)[3], const W (&y)[3]) {
  const W d1_x = x[1] - x[0], d1_y = y[1] - y[0], d2_x = x[2] - x[0], d2_y = y[2] - y[0];
  return {x[0], y[0], d1_x, d1_y, d2_x, d2_y, difference_of_products(d1_x, d2_y, d1_y, d2_x)};
}
/// PlaneCorners of a line. The third corner lies at a right angle to the line; given the first's values there, planes
/// are constant across the line.
template <class W>
[[gnu::always_inline]] inline PlaneCorners<W> line_corners(const W& x0, const W& y0, const W& x1, const W& y1) {
  const W d_x = x1 - x0, d_y = y1 - y0;
  return {x0, y0, d_x, d_y, -d_y, d_x, d_x * d_x + d_y * d_y};
}
/// PlaneCorners of the unsnapped positions; of the snapped ones where the unsnapped area is 0 or has not the sign of
/// the snapped area. `facing`: that sign, 1 of a front face, -1 of a back face.
template <class R>
PlaneCorners<Wide<R>> plane_corners(const R (&x_win)[3], const R (&y_win)[3], const Int<R> (&snapped_x)[3],
                                    const Int<R> (&snapped_y)[3], const Wide<R>& facing) {
  using W = Wide<R>;
  W x[3] = {to_wide(x_win[0]), to_wide(x_win[1]), to_wide(x_win[2])};
  W y[3] = {to_wide(y_win[0]), to_wide(y_win[1]), to_wide(y_win[2])};
  const PlaneCorners<W> unsnapped = plane_corners<W>(x, y);
  const auto usable = unsnapped.twice_area * facing > W(0);
  if (all(usable)) return unsnapped;
  const auto place = [](const Int<R>& snapped) { return to_wide(snapped) * W(1.0 / 256.0) + W(0.5); };
  for (int k = 0; k < 3; ++k) {
    x[k] = select(usable, x[k], place(snapped_x[k]));
    y[k] = select(usable, y[k], place(snapped_y[k]));
  }
  return plane_corners<W>(x, y);
}

/// Common terms of a triangle's planes, and its barycentric coordinates l1 and l2 (l0 = 1 - l1 - l2).
template <class W>
struct CornerPlanes {
  PlaneCorners<W> corners;
  W area_1, area_2;  ///< l1 and l2 at the anchor, times twice the triangle's area
  Affine<W> l1, l2;

  /// Plane through the values v0, v0 + d1 and v0 + d2 at corners 0, 1 and 2. Its slopes are within a few roundings of
  /// the exact ones, also for a sliver.
  [[gnu::always_inline]] Affine<W> through(const W& v0, const W& d1, const W& d2) const {
    const PlaneCorners<W>& c = corners;
    return {v0 + difference_of_products(area_1, d1, -area_2, d2) / c.twice_area,
            difference_of_products(d1, c.d2_y, d2, c.d1_y) / c.twice_area,
            difference_of_products(d2, c.d1_x, d1, c.d2_x) / c.twice_area};
  }
};
template <class W>
[[gnu::always_inline]] inline CornerPlanes<W> corner_planes(const PlaneCorners<W>& c, double anchor_x,
                                                            double anchor_y) {
  const W dx = W(anchor_x) - c.p0_x, dy = W(anchor_y) - c.p0_y, inv = W(1) / c.twice_area;
  const W area_1 = difference_of_products(dx, c.d2_y, dy, c.d2_x);
  const W area_2 = difference_of_products(c.d1_x, dy, c.d1_y, dx);
  return {c, area_1, area_2, {area_1 * inv, c.d2_y * inv, -c.d2_x * inv}, {area_2 * inv, -c.d1_y * inv, c.d1_x * inv}};
}

/// Point that planes are evaluated from.
struct Anchor {
  double x0, y0;  ///< window position [pixels]
};
/// Planes of a window triangle, line or point, and their anchor.
struct BarycentricPlanes : CornerPlanes<double>, Anchor {};

/// Planes anchored at the centre of pixel (x0, y0), which is at most a tile from the pixels of evaluation: from a far
/// anchor, the terms of a sliver's sum would be too large for double. Of a triangle through the corners that
/// plane_corners() chooses; along a line, l1 = (p - p0).(p1 - p0) / |p1 - p0|^2 and l2 = 0 (OpenGL 2.1, equation 3.5);
/// of a point, l1 = l2 = 0.
BarycentricPlanes planes_of(const WindowTriangle& triangle, int x0, int y0);

/// Planes whose value at p is the given planes' at p + offset [1/256 pixel].
BarycentricPlanes at_offset(const BarycentricPlanes& planes, glm::ivec2 offset);

template <class R>
[[gnu::always_inline]] inline Offset<R> from_anchor(const Anchor& anchor, const Pixels<R>& p) {
  return {p.x_win - anchor.x0, p.y_win - anchor.y0};
}

/// Per-draw state of stage 6.
struct DepthState {
  DepthFormat format;
  double low = 0, high = 1;  ///< clamp range [window z]
  PolygonOffset offset = {};
};
/// State of stage 6 of the draw. Clamp range: with depth clamp the draw's depth range (GL_ARB_depth_clamp), else [0,1].
DepthState depth_state(const Draw& draw, DepthFormat format, bool depth_clamp);

/// Window depths of a triangle's corners, polygon offset included: corner 0's, and the others' differences from it.
struct DepthSetup {
  double z0, dz1, dz2;
  double scale;              ///< the largest code of the depth format (scene.h, depth_scale); 0: float
  double low = 0, high = 1;  ///< as DepthState
};
/// Depths of a primitive's corners. A polygon offset moves a triangle's whole plane; lines and points have no offset.
DepthSetup depth_setup(const WindowTriangle& triangle, const DepthState& state);
/// Plane of depth, in codes of the depth format; in window z where the format is float.
struct DepthPlane {
  Affine<double> code;
  double scale, low, high;  ///< as DepthSetup; low and high in the plane's unit
};
DepthPlane depth_plane(const DepthSetup& depth, const CornerPlanes<double>& planes);
/// Plane whose value at p is the given plane's at p + offset [1/256 pixel].
DepthPlane at_offset(const DepthPlane& depth, glm::ivec2 offset);

/// Code nearest to `scaled`, [0, scale]: half to even; of 8 bits half up, as tinyrenderer's int(z + .5) (note 002).
template <class W>
[[gnu::always_inline]] inline W rounded_code(const W& scaled, double scale) {
  const W code = round_even(scaled);
  return scale == 255.0 ? select(scaled - code == 0.5, code + 1.0, code) : code;
}
/// Code of window z, [0,1].
inline double depth_code(double z, double scale) { return rounded_code(z * scale, scale); }

/// Depth of a fragment, clamped: a code, which a float holds exactly up to 2^24; for z32f, window z.
template <class R>
[[gnu::always_inline]] inline R depth(const DepthPlane& s, const Offset<R>& at) {
  const Wide<R> code = clamped<Wide<R>>(value_at<R>(s.code, at), s.low, s.high);
  return to_float(s.scale == 0.0 ? code : rounded_code(code, s.scale));
}

}  // namespace plumbline::pipeline
