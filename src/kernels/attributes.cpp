#include "kernels/attributes.h"

namespace plumbline::pipeline {

PerspectiveSetup perspective_setup(const std::array<float, 3>& inv_w, const CornerPlanes<double>& planes) {
  const double w0 = to_wide(inv_w[0]), w1 = to_wide(inv_w[1]), w2 = to_wide(inv_w[2]);
  return {inv_w, scaled(planes.l1, w1), scaled(planes.l2, w2), planes.through(w0, w1 - w0, w2 - w0)};
}
PerspectiveSetup perspective_setup(const WindowTriangle& t, const CornerPlanes<double>& planes) {
  const float w0 = t.v[0].inv_w;
  return perspective_setup({w0, t.v[1].inv_w, t.corners == 3 ? t.v[2].inv_w : w0}, planes);
}

AttributeSetup attribute_setup(const std::array<Vec4<float>, 3>& corners) {
  const Vec4<float> d1 = corners[1] - corners[0], d2 = corners[2] - corners[0];
  return {corners[0], d1, d2, d1 == Vec4<float>(0) && d2 == Vec4<float>(0)};
}

}  // namespace plumbline::pipeline
