// Repeated triangles, drawn twice at the same positions: every renderer gives both draws the same depth.
#pragma once

#include <span>
#include <vector>

#include "reference/arithmetic/draw_ranges.h"
#include "reference/oracle/pixel_hit.h"

namespace plumbline::math {

/// Finds triangles whose vertices are another's, in order and to the bit, under the same transforms and depth state
/// (OpenGL 2.1 spec, appendix A: repeatability, and invariance under changes of other state).
class Repeated {
 public:
  /// `scene` and `projected` have to outlive it.
  Repeated(const Scene& scene, const Projected& projected)
      : scene_(scene), projected_(projected), ranges_(ranges_of_draws(scene)) {}
  /// Sets Hit::surface of the hits of one pixel, which are in draw order.
  void set_surfaces(std::span<PixelHit> hits) const;

 private:
  bool same(std::uint32_t a, std::uint32_t b) const;

  const Scene& scene_;
  const Projected& projected_;
  std::vector<DrawRange> ranges_;
};

}  // namespace plumbline::math
