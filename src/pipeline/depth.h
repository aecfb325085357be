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
Barycentric<R> barycentric(const BarycentricPlanes& planes, const Pixels<R>& p) {
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
W depth_code(const W& z, double scale) {
  const W scaled = z * scale, code = round_even(scaled);
  return scale == 255.0 ? select(scaled - code == 0.5, code + 1.0, code) : code;
}

/// In the depth format: a code, which a float holds exactly up to 2^24, or window z itself for z32f.
template <class R>
R depth(const DepthSetup& s, const Barycentric<R>& b) {
  const Wide<R> z = clamped<Wide<R>>(s.z0 + b.l1 * s.dz1 + b.l2 * s.dz2, s.low, s.high);
  return to_float(s.scale == 0.0 ? z : depth_code(z, s.scale));
}

}  // namespace plumbline::pipeline
