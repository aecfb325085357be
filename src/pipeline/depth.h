// Stage 6: the depth of each fragment, and the depth test.
//
// Barycentric coordinates are affine in the window; two planes in double serve depth here and attributes in stage 7.
// They go through the *unsnapped* positions: the snapped ones only decide coverage (through them, the colours of tiny
// triangles would move visibly). Double, because for a sliver in float even the third bit of a depth may be wrong.
#pragma once

#include "pipeline/lanes.h"
#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::pipeline {

/// A triangle's barycentric planes, anchored at a pixel centre nearby: l1 = l1_0 + dx * l1_x + dy * l1_y, l2 likewise,
/// l0 = 1 - l1 - l2.
struct BarycentricPlanes {
  double x0, y0;  ///< the anchor, window
  double l1_0, l1_x, l1_y;
  double l2_0, l2_x, l2_y;
};

/// a b - c d to within two roundings of the result, however close the products are (Kahan).
template <class W>
W difference_of_products(W a, W b, W c, W d) {
  const W cd = c * d;
  const W error = fused(-c, d, cd);
  return fused(a, b, -cd) + error;
}

/// What a triangle's planes go through: corner 0, and the others' places from it.
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
/// Where the unsnapped area is zero or of the other sign than the snapped, the snapped corners. `facing`: 1 of a front
/// face, -1 of a back one.
template <class R>
PlaneCorners<Wide<R>> plane_corners(const R (&x_win)[3], const R (&y_win)[3], const Int<R> (&snapped_x)[3],
                                    const Int<R> (&snapped_y)[3], const Wide<R>& facing) {
  using W = Wide<R>;
  const W x[3] = {to_wide(x_win[0]), to_wide(x_win[1]), to_wide(x_win[2])};
  const W y[3] = {to_wide(y_win[0]), to_wide(y_win[1]), to_wide(y_win[2])};
  PlaneCorners<W> out = plane_corners<W>(x, y);
  const auto usable = out.twice_area * facing > W(0);
  if (all(usable)) return out;
  const auto place = [](const Int<R>& snapped) { return to_wide(snapped) * W(1.0 / 256.0) + W(0.5); };
  const W snapped_corner_x[3] = {place(snapped_x[0]), place(snapped_x[1]), place(snapped_x[2])};
  const W snapped_corner_y[3] = {place(snapped_y[0]), place(snapped_y[1]), place(snapped_y[2])};
  const PlaneCorners<W> other = plane_corners<W>(snapped_corner_x, snapped_corner_y);
  const auto of = [&](W PlaneCorners<W>::*member) { out.*member = select(usable, out.*member, other.*member); };
  of(&PlaneCorners<W>::p0_x), of(&PlaneCorners<W>::p0_y);
  of(&PlaneCorners<W>::d1_x), of(&PlaneCorners<W>::d1_y);
  of(&PlaneCorners<W>::d2_x), of(&PlaneCorners<W>::d2_y);
  of(&PlaneCorners<W>::twice_area);
  return out;
}

/// The planes, anchored at a point of the window.
template <class W>
struct AffinePlanes {
  W l1_0, l1_x, l1_y;
  W l2_0, l2_x, l2_y;
};
template <class W>
AffinePlanes<W> planes_through(const PlaneCorners<W>& c, double anchor_x, double anchor_y) {
  const W d_x = W(anchor_x) - c.p0_x, d_y = W(anchor_y) - c.p0_y;
  return {
      difference_of_products(d_x, c.d2_y, d_y, c.d2_x) / c.twice_area, c.d2_y / c.twice_area,  -c.d2_x / c.twice_area,
      difference_of_products(c.d1_x, d_y, c.d1_y, d_x) / c.twice_area, -c.d1_y / c.twice_area, c.d1_x / c.twice_area};
}

/// Along a line, l1 = (p - p0).(p1 - p0) / |p1 - p0|^2 and l2 = 0 (OpenGL 2.1, equation 3.5); of a point both are 0.
/// Where the unsnapped area is zero or of the other sign than the snapped, the planes go through the snapped corners.
/// (x0, y0): a pixel at most a tile away from those that are wanted. From a far anchor, the terms of a sliver's sum
/// would be so large that double itself is too coarse.
BarycentricPlanes planes_of(const WindowTriangle<float>& triangle, int x0, int y0);

/// The same for the points `place` (in 1/256 pixel) from those that they are asked for.
BarycentricPlanes moved(const BarycentricPlanes& planes, glm::ivec2 place);

template <class R>
struct Barycentric {
  Wide<R> l0, l1, l2;
};
template <class R>
[[gnu::always_inline]] inline Barycentric<R> barycentric(const BarycentricPlanes& planes, const Pixels<R>& p) {
  const Wide<R> dx = p.x_win - planes.x0, dy = p.y_win - planes.y0;
  const Wide<R> l1 = planes.l1_0 + (dx * planes.l1_x + dy * planes.l1_y);
  const Wide<R> l2 = planes.l2_0 + (dx * planes.l2_x + dy * planes.l2_y);
  return {1.0 - l1 - l2, l1, l2};
}

/// What a draw says of its fragments' depth.
struct DepthState {
  DepthFormat format;
  double low = 0, high = 1;  ///< depths beyond are clamped
  PolygonOffset offset = {};
};
DepthState depth_state(const Draw& draw, DepthFormat format, bool depth_clamp);

/// A triangle's window depths, as corner 0's and the differences from it.
struct DepthSetup {
  double z0, dz1, dz2;
  double scale;              ///< the largest code of the depth format (scene.h, depth_scale); 0: float
  double low = 0, high = 1;  ///< as DepthState
};
/// With the polygon offset, which moves the whole plane.
DepthSetup depth_setup(const WindowTriangle<float>& triangle, const DepthState& state);
/// The same for the points `place` (in 1/256 pixel) from those that the barycentrics are of.
DepthSetup moved(const DepthSetup& depth, const BarycentricPlanes& planes, glm::ivec2 place);

/// The code of z in [0,1], `scale` the largest: the nearest, half to even; of 8 bits half up, as tinyrenderer's
/// int(z + .5) (note 002).
template <class W>
[[gnu::always_inline]] inline W depth_code(const W& z, double scale) {
  const W scaled = z * scale, code = round_even(scaled);
  return scale == 255.0 ? select(scaled - code == 0.5, code + 1.0, code) : code;
}

/// The same, its format and limits known when it is compiled.
struct Z24Setup {
  double z0, dz1, dz2;
  static constexpr double scale = 16777215.0, low = 0, high = 1;
};

/// `s`: either of them. In the depth format: a code, which a float holds exactly up to 2^24, or window z itself for
/// z32f.
template <class R, class Setup = DepthSetup>
[[gnu::always_inline]] inline R depth(const Setup& s, const Barycentric<R>& b) {
  const Wide<R> z = clamped<Wide<R>>(s.z0 + b.l1 * s.dz1 + b.l2 * s.dz2, s.low, s.high);
  return to_float(s.scale == 0.0 ? z : depth_code(z, s.scale));
}

}  // namespace plumbline::pipeline
