#include "pipeline/attributes.h"

namespace plumbline::pipeline {

AttributeSetup attribute_setup(const WindowTriangle<float>& triangle) {
  const auto& v = triangle.v;
  return {{v[0].inv_w, v[1].inv_w, v[2].inv_w}, v[0].color, v[1].color - v[0].color, v[2].color - v[0].color};
}

}  // namespace plumbline::pipeline
