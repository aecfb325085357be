// Barycentric coordinates of a pixel. Of no use to a renderer, which interpolates over w.
#pragma once

#include "kernels/depth.h"

namespace plumbline::pipeline {

struct Barycentric {
  double l0, l1, l2;
};
inline Barycentric barycentric(const BarycentricPlanes& planes, const Pixels<float>& p) {
  const Offset<float> at = from_anchor<float>(planes, p);
  const double l1 = value_at<float>(planes.l1, at), l2 = value_at<float>(planes.l2, at);
  return {1.0 - l1 - l2, l1, l2};
}

}  // namespace plumbline::pipeline
