#include "reference/arithmetic/error_in_float.h"

#include <algorithm>
#include <cmath>

#include "capture/float_depth.h"

namespace plumbline::math {

namespace {

WindowCorners window_corners(const Projected& scene, const Triangle& t) {
  WindowCorners out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& corner = scene.corners[t.corner[i]];
    const double z_view = 0.5 + 0.5 * corner.z / corner.v.z;
    out[i] = {glm::dvec2(corner.v) / corner.v.z + 0.5 * glm::dvec2(scene.width, scene.height), to_window(t, z_view)};
  }
  return out;
}

// Error of a plane in the pieces of a cut triangle, of values of at most 1; `slope` [1 / pixel].
double error_of_pieces(const Projected& scene, const Triangle& t, double slope, const PieceAltitudes& altitudes) {
  const Conventions::DepthArithmetic arithmetic = scene.conventions.depth_arithmetic;
  // A plane through corners that are off by `reach` is steeper than the triangle by 4 reach / altitude of its slope.
  const auto of_pieces = [&](double altitude, glm::dvec2 extent) {
    return depth_error_of_pieces(arithmetic, altitude, slope * (1 + 4 * t.reach / altitude), extent);
  };
  const double framed = of_pieces(altitudes.framed, {scene.width, scene.height});
  if (t.guarded.extent == glm::dvec2(0)) return framed;
  return std::max(framed, of_pieces(altitudes.guarded, t.guarded.extent));
}

}  // namespace

double error_in_float(const Projected& scene, const Triangle& t, glm::dvec3 d, const PieceAltitudes& altitudes) {
  const Conventions::DepthArithmetic arithmetic = scene.conventions.depth_arithmetic;
  if (arithmetic == Conventions::DepthArithmetic::in_double) return 0;
  const double slope = range_scale(t) * glm::length(glm::dvec2(t.z_plane)),
               out = t.cut ? error_of_pieces(scene, t, slope, altitudes) : 0;
  if (!t.ahead) return out;
  const glm::dvec2 size(scene.width, scene.height);
  return std::max(out, depth_error(arithmetic, window_corners(scene, t), glm::dvec2(d) + 0.5 * size));
}

double shares_error_in_float(const Projected& scene, const Triangle& t, glm::dvec3 d, const PieceAltitudes& altitudes,
                             double slope) {
  const Conventions::DepthArithmetic arithmetic = scene.conventions.depth_arithmetic;
  if (arithmetic == Conventions::DepthArithmetic::in_double) return 0;
  const double of_pieces = t.cut ? error_of_pieces(scene, t, slope, altitudes) : 0,
               out = std::isfinite(of_pieces) ? of_pieces : 0;
  if (!t.ahead) return out;
  const glm::dvec2 size(scene.width, scene.height);
  return std::max(out, shares_error(arithmetic, window_corners(scene, t), glm::dvec2(d) + 0.5 * size));
}

}  // namespace plumbline::math
