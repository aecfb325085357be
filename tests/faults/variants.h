// A fault's stages: the production stages with one function in another's place; and the bugs that more than one list
// names.
#pragma once

#include <cstdint>

#include "pipeline/render.h"

namespace plumbline::faults {

template <auto member, auto function>
pipeline::Stages with_geometry() {
  pipeline::Stages stages = pipeline::production_stages();
  stages.geometry.*member = function;
  return stages;
}

template <class Fragment>
pipeline::Stages with_fragment() {
  pipeline::Stages stages = pipeline::production_stages();
  stages.fragment = pipeline::fragment_functions<Fragment>();
  return stages;
}

using Geometry = pipeline::GeometryStages;

/// The production edges with another tie rule: `Rule::owns(step_x, step_y)` says whether an edge, into whose triangle
/// these steps lead, has its own pixels in.
template <class Rule>
struct Ties : pipeline::FragmentStages {
  static pipeline::Edges edges(const WindowTriangle<float>& triangle) {
    pipeline::Edges e = pipeline::edges_of(triangle);
    for (int i = 0; i < 3; ++i) {
      const bool owned = e.step_x[i] > 0 || (e.step_x[i] == 0 && e.step_y[i] > 0);
      if (!owned) ++e.at_origin[i];
      if (!Rule::owns(e.step_x[i], e.step_y[i])) --e.at_origin[i];
    }
    return e;
  }
};

struct AllEdgesIn {
  static bool owns(std::int64_t, std::int64_t) { return true; }
};

struct AffineAttributes : pipeline::FragmentStages {
  template <class R>
  static pipeline::Color<R> attributes(const pipeline::AttributeSetup& s, const pipeline::Barycentric<R>& b) {
    pipeline::AttributeSetup affine = s;
    for (float& inv_w : affine.inv_w) inv_w = 1;
    return pipeline::attributes<R>(affine, b);
  }
};

}  // namespace plumbline::faults
