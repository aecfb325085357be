// Pixel site: a triangle at one pixel's ray, with the quantities that its coverage, depth and colour are computed from.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "reference/arithmetic/bounded.h"
#include "reference/arithmetic/error_in_float.h"
#include "reference/arithmetic/project.h"

namespace plumbline::math {

/// Tie rule: true where the triangle on the side `inward` of an edge owns the samples on the edge.
bool owns_ties(Conventions::TieRule rule, glm::dvec2 inward);

/// Distance of a window point d from the part of a triangle's edge, corner j to corner k, in front of the eye; infinite
/// without such a part.
struct EdgeDistance {
  double pixels;
  glm::dvec3 d_nearest;  ///< the point of the edge nearest to d
  double w;              ///< clip w there
};
/// `n`: v_j x v_k.
EdgeDistance edge_distance(const glm::dvec3& n, const glm::dvec3& v_j, const glm::dvec3& v_k, glm::dvec3 d);

/// A triangle at one pixel's ray. Parameter `certain`: true where every legal renderer covers the pixel with the
/// triangle's inside.
class PixelSite {
 public:
  PixelSite(const Projected& scene, const Triangle& triangle, int px, int py);

  const Projected& scene;
  const Triangle& t;
  glm::ivec2 pixel;
  glm::dvec3 d;              ///< the ray of the pixel's sample
  bool inside = false;       ///< in the closed triangle, in double
  bool by_ties = false;      ///< inside, with edges by the tie rule
  double border = 0;         ///< distance to the triangle's border [pixels]
  glm::dvec3 nearest{0};     ///< the point of the triangle nearest to d
  double w = 0;              ///< clip w at `nearest`, within that of the triangle's visible part
  bool in_reach = false;     ///< a legal renderer may cover the pixel; else the next three are not set
  glm::dvec4 clip_error{0};  ///< clip_error() at `nearest`
  PieceAltitudes pieces{};   ///< of the pieces that may cover the pixel, less their error
  glm::dvec2 moved{0};       ///< largest displacement of the triangle by float arithmetic at `nearest` [pixels]

  /// Largest sum of |barycentrics| at the pixel: factor on errors of the plane's corners; infinite: no bound.
  double snap_weight(bool certain) const;
  /// True if snapping may reverse the facing of the triangle or of the covering piece.
  bool may_show_either_face(bool certain) const;
  /// True if snapping may reverse the covering piece's facing. The piece's plane then goes through snapped corners.
  bool may_turn_over(bool certain) const { return !certain && (t.cut || t.thin); }
  /// Edge functions that weight the corners' attributes.
  std::array<glm::dvec3, 3> weight_planes(Conventions::Interpolation how) const;
  /// True if weight_planes() interpolate texture coordinates. Without perspective, each piece of a cut triangle has
  /// its own plane.
  bool has_one_plane() const {
    return scene.conventions.interpolation == Conventions::Interpolation::perspective || !t.cut;
  }
  /// An attribute at the pixel's centre, with its bound; extrapolated beyond the triangle's border, as renderers do.
  /// `corners`: the attribute at the corners.
  BoundedFour attribute(const std::array<BoundedFour, 3>& corners, bool certain, Conventions::Interpolation how) const;
  /// Relative error of a renderer's slopes of attributes: corners displaced by float arithmetic or snapping tilt a
  /// plane by the displacement over its altitude; w adds its own error, the evaluation 16 u.
  double slopes_off() const;

 private:
  void place();
  void find_pieces();
  double centre_weight(bool certain) const;
};

}  // namespace plumbline::math
