#include "pipeline/attributes.h"

namespace plumbline::pipeline {

AttributeSetup attribute_setup(const WindowTriangle<float>& triangle) {
  const auto& v = triangle.v;
  const Vec4<float> d1 = v[1].color - v[0].color, d2 = v[2].color - v[0].color;
  return {{v[0].inv_w, v[1].inv_w, v[2].inv_w}, v[0].color, d1, d2, d1 == Vec4<float>(0) && d2 == Vec4<float>(0)};
}

}  // namespace plumbline::pipeline
