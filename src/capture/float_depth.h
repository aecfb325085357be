// Error bounds of depths that a renderer interpolates in float, by its declared arithmetic (conventions.h).
//
// u = 2^-24 is float's unit roundoff. A triangle's corners lie at window positions (x_i, y_i) [pixel] with depths z_i
// in [0,1]; e_i(p) = a_i x + b_i y + c_i is the edge function of the edge opposite corner i; A is twice the area.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include <glm/glm.hpp>

#include "capture/conventions.h"

namespace plumbline {

using WindowCorners = std::array<glm::dvec3, 3>;

/// Size of a frame that has no sides [pixels].
inline constexpr glm::dvec2 kNoSides{std::numeric_limits<double>::infinity()};

/// Error of sum z_i e_i / A at p [u of window z]. An edge function and the area are each the difference of two products
/// of differences: 4 u of |first| + |second|. Quotient, product and sum: 4 u of |z_i e_i / A|. Beside a sliver's long
/// edges nearly all of e_i and of A cancels. Infinite without area.
double error_by_edge_functions(const WindowCorners& corners, glm::dvec2 p);

/// Error of z_0 + dz/dx x + dz/dy y at p [u of window z], z_0 at the window's origin: 4 u of (the largest |z_i|, plus
/// the gradients' terms at p and at the farthest corner, plus the gradients' error times p's distance from the
/// corners).
double error_by_plane(const WindowCorners& corners, glm::dvec2 p);

/// Error of a x + b y + c at p [u of window z], where a = sum z_i a_i / A, likewise b and c, and A = sum c_i; each c_i
/// is x_j y_k - x_k y_j, whose terms are at most t_i = (|x_j| + |x_k|) (|y_j| + |y_k|). Five roundings on each way
/// (difference, product, quotient, two sums), both ways: 10 u of (sum |z_i| (|a_i x| + |b_i y| + t_i) + |z| sum t_i) /
/// |A|. Small triangles far from the origin lose most.
double error_by_edge_equations(const WindowCorners& corners, glm::dvec2 p);

/// Box of a triangle's corners in the window [pixels].
struct WindowBox {
  explicit WindowBox(glm::dvec2 corner) : low(corner), high(corner) {}
  void add(glm::dvec2 corner) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  glm::dvec2 low, high;
};

/// Displacement in x and in y of an edge [pixels], near which a sample lies, of a triangle that has this box.
/// - in_float_stepped: x is added up from row to row of the frame, two roundings a row (slope, sum) of at most the
///   box's largest |x|, two more at each end.
/// - in_float_stepped_edges: the edge function is added up over the box's part in the frame, where it is at most that
///   part's diagonal times the edge's length. Divided by that length, its errors are: for each step a rounding of that
///   size and one of the step itself, and 4 u of the terms at the part's corner, which the box's own diagonal bounds.
///   The displacement may point in any direction.
/// - edge_bits N: x, of N fraction bits, is added up from row to row: 2^-N a row of the box, the error of a slope that
///   is cut off, and two more at each end (largest seen: 0.996 of it, of 20,000 edges in 10 to 16 bits).
/// - Otherwise 0.
/// `box`: of the triangle's part in the frame or, where steps_whole_box(), of all that is drawn of it.
glm::dvec2 edge_displacement(const Conventions& conventions, const WindowBox& box, glm::dvec2 frame);

/// Whether steps begin at a triangle's own corners, in the frame or not.
bool steps_whole_box(const Conventions& conventions);

/// Error that stepping z to p adds to a plane's error [u of window z]: a sum for each row and for each column, of
/// numbers of at most the largest |z_i|; in_float_stepped: and |dz/dx| times the edge's displacement, as its x is
/// stepped, too. `frame`: its size [pixels]. One product, whose error error_by_plane() counts, replaces the steps over
/// rows and columns beyond the frame.
double error_by_steps(Conventions::DepthArithmetic arithmetic, const WindowCorners& corners, glm::dvec2 p,
                      glm::dvec2 frame);

/// Error of sum z_i e_i / A, or of z_k + sum (z_i - z_k) e_i / A over two corners (k the third, whichever it is), at p
/// beyond error_by_edge_functions() [u of window z], where each e_i is added up from a
/// corner of the triangle's box in the frame, from pixel to pixel and from row to row, and is divided by A in the end:
/// one rounding a step, of at most the largest |e_i| in the box; one of a_i or b_i in each step; and 4 u of the terms
/// at the box's corner. Beside a sliver's long edges |e_i| is large there, and A is small.
double error_by_stepped_edges(const WindowCorners& corners, glm::dvec2 p, glm::dvec2 frame);

/// Error of a depth at p [window z], plus u for its code: a product and a sum, each off by half a unit in the last
/// place of a number below 1. in_double: 0. in_float: the larger of error_by_edge_functions() and error_by_plane().
/// in_float_stepped: the same, plus error_by_steps(). in_float_stepped_edges: the same, plus error_by_stepped_edges().
/// in_float_from_origin: the largest of the two and of error_by_edge_equations(). in_float_from_origin_stepped: the
/// same, plus the part of error_by_steps() without edges, which are not stepped.
///
/// `z_of_zero`: c, the window z where 1/w is 0, of a renderer that interpolates 1/w and computes window z as c - k / w
/// (without perspective: c + k d, d the distance before the eye); nullopt: it interpolates window z. Its errors, the
/// larger of those of window z and these: in place of z_i, |z_i - c| counts, and error_of_inv_w() is added.
double depth_error(Conventions::DepthArithmetic arithmetic, const WindowCorners& corners, glm::dvec2 p,
                   glm::dvec2 frame, std::optional<double> z_of_zero = {});

/// Error that a buffer of 1/w or w in float, and window z that is made of it, add to a depth [window z], whatever the
/// arithmetic: a corner's 1/w, k, their product and the reciprocal of w add a rounding each, 4 u of the largest
/// |z_i - c|; c adds u of |c|. nullopt: 0.
double error_of_inv_w(const WindowCorners& corners, std::optional<double> z_of_zero);

/// Sum of the errors of the three window barycentrics at p: each barycentric is bounded as a depth that is 1 at one
/// corner and 0 at the others.
double shares_error(Conventions::DepthArithmetic arithmetic, const WindowCorners& corners, glm::dvec2 p,
                    glm::dvec2 frame);

/// Error of an attribute whose numerator and denominator are planes of their own. `most`: largest absolute value at the
/// corners. `shares`: shares_error() times the corners' largest 1/w over the pixel's 1/w. Infinite if `shares` is 1 or
/// more.
double attribute_error(double shares, double most);

/// Bound of depth_error() over all triangles within a window [pixels] whose altitudes are at least `altitude` [pixels]
/// and whose depth gradients are at most `slope` [window z per pixel]. A `slope` above 2 / altitude counts as 2 /
/// altitude: no such triangle is steeper.
double depth_error_of_pieces(Conventions::DepthArithmetic arithmetic, double altitude, double slope, glm::dvec2 window,
                             glm::dvec2 frame, std::optional<double> z_of_zero = {});

}  // namespace plumbline
