// Stages 5 to 7 of one window triangle, called alone: what the properties compare.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "faults/pixel_barycentrics.h"
#include "kernels/attributes.h"
#include "kernels/coverage.h"
#include "kernels/depth.h"
#include "pipeline/stages.h"

namespace plumbline::test {

struct Fragment {
  int x, y;
  float z;  ///< in the depth format
  glm::vec4 color;
  double spread;  ///< sum |b_i / w_i| over |sum b_i / w_i|, the weights' divisor: 1, or more off the triangle

  bool operator==(const Fragment&) const = default;
};

/// Calls visit(pixel) at each covered pixel, by y, then x.
template <class Visit>
void for_each_covered(const pipeline::WindowTriangle& triangle, Visit visit) {
  const pipeline::Edges edges = pipeline::edges_of(triangle);
  const pipeline::PixelBounds b = pipeline::pixel_bounds(triangle);
  for (int y = b.y0; y < b.y1; ++y) {
    for (int x = b.x0; x < b.x1; ++x) {
      const pipeline::Pixels<float> p{x, y, x + 0.5, y + 0.5};
      if (pipeline::coverage<float>(edges, p)) visit(p);
    }
  }
}

/// The fragments, by y, then x. `scale`: the largest depth code, 0 for float (scene.h, depth_scale); `anchor`: the
/// pixel from which planes are evaluated (kernels/depth.h, planes_of).
inline std::vector<Fragment> fragments(const pipeline::ShadedTriangle& triangle, double scale, glm::ivec2 anchor) {
  const pipeline::BarycentricPlanes planes = pipeline::planes_of(triangle, anchor.x, anchor.y);
  pipeline::DepthSetup depth = pipeline::depth_setup(triangle, {DepthFormat::z32f});
  depth.scale = scale;
  const pipeline::DepthPlane plane = pipeline::depth_plane(depth, planes);
  const pipeline::AttributeSetup attributes = pipeline::attribute_setup(
      {triangle.attributes[0].color(), triangle.attributes[1].color(), triangle.attributes[2].color()});
  const pipeline::PerspectiveSetup perspective = pipeline::perspective_setup(triangle, planes, true);
  std::vector<Fragment> out;
  for_each_covered(triangle, [&](const pipeline::Pixels<float>& p) {
    const pipeline::Barycentric b = pipeline::barycentric(planes, p);
    const pipeline::Offset<float> at = pipeline::from_anchor<float>(planes, p);
    const pipeline::Color<float> c = pipeline::mean<float>(attributes, pipeline::weights<float>(perspective, at));
    const auto& v = triangle.v;
    const double q0 = b.l0 * v[0].inv_w, q1 = b.l1 * v[1].inv_w, q2 = b.l2 * v[2].inv_w;
    out.push_back({static_cast<int>(p.x),
                   static_cast<int>(p.y),
                   pipeline::depth<float>(plane, at),
                   {c.r, c.g, c.b, c.a},
                   (std::abs(q0) + std::abs(q1) + std::abs(q2)) / std::abs(q0 + q1 + q2)});
  });
  return out;
}

/// First mismatch, or nothing. Fragments must be of the same pixels, depths within `z_apart`, colours within what float
/// rounding in another order explains.
inline std::string apart(const std::vector<Fragment>& a, const std::vector<Fragment>& b, double z_apart) {
  if (a.size() != b.size()) return fmt::format("{} fragments and {}", a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::string at = fmt::format("at {},{}: ", a[i].x, a[i].y);
    if (a[i].x != b[i].x || a[i].y != b[i].y) return at + "covered by one alone";
    if (!(std::abs(double{a[i].z} - b[i].z) <= z_apart)) return at + fmt::format("depths {}, {}", a[i].z, b[i].z);
    const double spread = std::max(a[i].spread, b[i].spread), bound = 32 * 0x1p-24 * spread * spread;
    for (int k = 0; k < 4; ++k) {
      const double c = a[i].color[k], d = b[i].color[k];
      if (!(std::abs(c - d) <= bound)) return at + fmt::format("colours {}, {}, bound {}", c, d, bound);
    }
  }
  return {};
}

}  // namespace plumbline::test
