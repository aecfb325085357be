// One triangle at one pixel's centre: what double arithmetic says, and what a legal renderer may make of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture/legal.h"
#include "reference/arithmetic/project.h"

namespace plumbline::math {

/// A surface's depth at a pixel's centre.
struct PixelDepth {
  double z = 0;
  double half = 0;      ///< how far a legal renderer's may be from it; infinite where no plane can be relied on
  glm::dvec2 slope{0};  ///< of its plane, per pixel
};

/// A triangle that certainly or possibly covers a pixel.
struct PixelHit {
  Hit hit;  ///< as fold_hits takes it
  /// In double the pixel is inside (ties by TieRule::small_sides_in; where it is known, `covers`), in depth range, not
  /// culled.
  bool inside = false;
  bool whole = false;    ///< neither the near nor the far plane may cut it here, and it is not culled
  PixelDepth view;       ///< between the near plane, 0, and the far, 1; not clamped
  PixelDepth win;        ///< window z, clamped where the near and far plane do not cut
  bool drawn = false;    ///< inside, and double's own picture has it pass all tests (oracle.h)
  double delta = 0;      ///< pixels: how far its outline may be moved here
  bool colored = false;  ///< its colour is known
  /// Whether every renderer of the declared grid and tie rule covers the pixel with it, or none does; else open.
  std::optional<bool> covers;
};

/// Whether a hit's colour is computed with the hit, or where it is asked for (color_hit()): most hits are hidden.
enum class Colors { now, asked };

/// The triangle `primitive` at the pixel (px, py), or nothing where no legal renderer covers it. A hit whose alpha is
/// tested has its colour in any case.
std::optional<PixelHit> pixel_hit(const Scene& scene, const Projected& projected, std::uint32_t primitive, int px,
                                  int py, Colors colors = Colors::now);

/// Colour and its bound of a hit at its pixel, unless they are known.
void color_hit(const Scene& scene, const Projected& projected, int px, int py, PixelHit& hit);

/// Outcomes of the alpha test, and stencil state, of a hit whose colour is known.
void set_tests(const Draw& draw, const Triangle& t, const FrameFormat& frame, const Conventions& conventions,
               PixelHit& out);

/// Whether a sample on a triangle's edge is the triangle's, which lies in the direction `inward` from that edge.
bool owns_ties(Conventions::TieRule rule, glm::dvec2 inward);
/// PixelHit::covers of a triangle that comes near to the pixel.
std::optional<bool> known_coverage(const Projected& projected, const Triangle& t, int px, int py);
/// Makes hits whose coverage is known certain, or removes them, and sets the others' groups (form_groups()) by it.
void settle_coverage(Conventions::TieRule tie_rule, std::vector<PixelHit>& hits);

/// The distance of the window point d from the edge from corner j to corner k of the triangle, as far as the edge is
/// before the eye; infinite where it is not. `d_nearest` is the point of it nearest to d, `w` the depth there.
struct EdgeDistance {
  double pixels;
  glm::dvec3 d_nearest;
  double w;
};
EdgeDistance edge_distance(const glm::dvec3& n, const glm::dvec3& v_j, const glm::dvec3& v_k, glm::dvec3 d);

/// Finds possible hits that together certainly cover the pixel, and gives each such set a number (Hit::group).
/// Returns how many sets there are. `hits` are those of one pixel.
int form_groups(const Projected& projected, std::span<PixelHit> hits, int px, int py);

}  // namespace plumbline::math
