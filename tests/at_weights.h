// Stages 6 and 7 at given barycentric coordinates: positions in a triangle of corners (0, 0), (1, 0) and (0, 1) are
// their own weights.
#pragma once

#include "kernels/attributes.h"
#include "kernels/depth.h"

namespace plumbline::test {

inline pipeline::CornerPlanes<double> planes_of_weights() {
  return pipeline::corner_planes<double>({0, 0, 1, 0, 0, 1, 1}, 0, 0);
}
inline float depth_at(const pipeline::DepthSetup& depth, double l1, double l2) {
  return pipeline::depth<float>(pipeline::depth_plane(depth, planes_of_weights()), {l1, l2});
}
inline pipeline::Color<float> attributes_at(const pipeline::WindowTriangle& triangle,
                                            const pipeline::AttributeSetup& setup, double l1, double l2) {
  const pipeline::PerspectiveSetup perspective = pipeline::perspective_setup(triangle, planes_of_weights(), false);
  return pipeline::mean<float>(setup, pipeline::weights<float>(perspective, {l1, l2}));
}

}  // namespace plumbline::test
