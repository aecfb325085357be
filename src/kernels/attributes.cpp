#include "kernels/attributes.h"

namespace plumbline::pipeline {

PerspectiveSetup perspective_setup(const std::array<float, 3>& inv_w, const CornerPlanes<double>& planes,
                                   bool may_go_in_blocks) {
  const double w[3] = {to_wide(inv_w[0]), to_wide(inv_w[1]), to_wide(inv_w[2])};
  const Affine<double> q1 = scaled(planes.l1, w[1]), q2 = scaled(planes.l2, w[2]);
  const Affine<double> sum = planes.through(w[0], w[1] - w[0], w[2] - w[0]);
  return {inv_w, q1, q2, sum, may_go_in_blocks && changes_little(q1, q2, sum, w)};
}
PerspectiveSetup perspective_setup(const WindowTriangle& t, const CornerPlanes<double>& planes, bool colors_alone) {
  const float w0 = t.v[0].inv_w;
  const bool three = t.corners == 3;
  return perspective_setup({w0, t.v[1].inv_w, three ? t.v[2].inv_w : w0}, planes, colors_alone && three);
}

AttributeSetup attribute_setup(const std::array<Vec4<float>, 3>& corners) {
  const Vec4<float> d1 = corners[1] - corners[0], d2 = corners[2] - corners[0];
  return {corners[0], d1, d2, d1 == Vec4<float>(0) && d2 == Vec4<float>(0)};
}

}  // namespace plumbline::pipeline
