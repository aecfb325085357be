// Pixel hit: one triangle at one pixel, with coverage, depth and colour in double and bounds for legal renderers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture/legal.h"
#include "reference/arithmetic/project.h"

namespace plumbline::math {

/// A surface's depth at a pixel.
struct PixelDepth {
  double z = 0;
  double half = 0;      ///< bound on |z of a legal renderer - z|; infinite without a reliable plane
  glm::dvec2 slope{0};  ///< dz/dx, dz/dy [1 / pixel]
};

/// A triangle that certainly or possibly covers a pixel.
struct PixelHit {
  Hit hit;  ///< input of fold_hits()
  /// Whether, in double, the triangle covers the pixel (by `covers` where that is known, else with ties by rule
  /// left_bottom), is in depth range, and is not culled.
  bool inside = false;
  bool at_diagonal = false;  ///< inclusive or exclusive tie rule: the sample may lie on a diagonal of the cut triangle
  bool at_cut = false;       ///< coverage is open by an edge that a cut makes alone, not by one of the triangle
  bool covered_inside = false;  ///< every legal renderer covers the pixel with the triangle's inside
  bool may_join_group = false;  ///< not culled, not cut in depth here; side cuts round alike
  PixelDepth view;              ///< z_view: 0 on the near plane, 1 on the far one; not clamped. half: includes snapping
  PixelDepth win;               ///< window z; clamped to the depth range under depth clamp
  bool drawn = false;           ///< inside, and passed all tests in double (oracle.h)
  double delta = 0;             ///< largest displacement of the triangle's outline here [pixels]
  bool colored = false;         ///< the colour and its bound are set
  double alpha_bound = 0;       ///< of hit.color.a alone
  /// Coverage by the declared grid and tie rule. true: in every legal renderer; false: in none; nullopt: open.
  std::optional<bool> covers;
};

/// When a hit's colour is computed: with the hit, or by color_hit() on demand, as most hits are hidden.
enum class Colors { now, asked };

/// The triangle `primitive` at the pixel (px, py); nullopt where no legal renderer covers it. A hit whose alpha is
/// tested has its colour in any case.
std::optional<PixelHit> pixel_hit(const Scene& scene, const Projected& projected, std::uint32_t primitive, int px,
                                  int py, Colors colors = Colors::now);

class PixelSite;
/// Sets the hit's colour, and the colour's bound, at its site.
void set_color(const Scene& scene, const PixelSite& site, PixelHit& hit);
/// Computes the colour of a hit at its pixel, and the colour's bound, unless PixelHit::colored.
void color_hit(const Scene& scene, const Projected& projected, int px, int py, PixelHit& hit);

/// Sets the possible outcomes of the alpha test, and the stencil state. A hit whose alpha is tested must have its
/// colour.
void set_tests(const Draw& draw, const Triangle& t, const FrameFormat& frame, const Conventions& conventions,
               PixelHit& out);

/// PixelHit::covers of a triangle that comes near the pixel.
std::optional<bool> known_coverage(const Projected& projected, const Triangle& t, int px, int py);
/// Applies PixelHit::covers to the hits of one pixel, after form_groups(): makes hits that cover certain, removes those
/// that do not, and dissolves groups of which a member covers, or, by an exclusive rule, all groups.
void settle_coverage(Conventions::TieRule tie_rule, std::vector<PixelHit>& hits);

/// Finds sets of possible hits of one pixel that together certainly cover it, and numbers them (Hit::group).
/// Result: the number of sets.
int form_groups(const Projected& projected, std::span<PixelHit> hits, int px, int py);

}  // namespace plumbline::math
