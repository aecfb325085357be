#include "reference/arithmetic/error_in_float.h"

#include <algorithm>

#include "capture/float_depth.h"

namespace plumbline::math {

double error_in_float(const Projected& scene, const Triangle& t, glm::dvec3 d, double altitude) {
  const Conventions::DepthArithmetic arithmetic = scene.conventions.depth_arithmetic;
  if (arithmetic == Conventions::DepthArithmetic::in_double) return 0;
  const glm::dvec2 size(scene.width, scene.height);
  double out = 0;
  if (t.cut) out = depth_error_of_pieces(arithmetic, altitude, size);
  if (!t.ahead) return out;
  WindowCorners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& corner = scene.corners[t.corner[i]];
    const double z_view = 0.5 + 0.5 * corner.z / corner.v.z;
    corners[i] = {glm::dvec2(corner.v) / corner.v.z + 0.5 * size, to_window(t, z_view)};
  }
  return std::max(out, depth_error(arithmetic, corners, glm::dvec2(d) + 0.5 * size));
}

}  // namespace plumbline::math
