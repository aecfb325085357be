#include "reference/arithmetic/error_in_float.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "capture/float_depth.h"
#include "reference/arithmetic/bounded.h"
#include "reference/arithmetic/widths.h"

namespace plumbline::math {

namespace {

WindowCorners window_corners(const Projected& scene, const Triangle& t) {
  WindowCorners out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& corner = scene.corners[t.corner[i]];
    const double z_view = 0.5 + 0.5 * corner.z / corner.v.z;
    out[i] = {glm::dvec2(corner.v) / corner.v.z + 0.5 * glm::dvec2(scene.width, scene.height), to_window(t, z_view)};
  }
  return out;
}

// Choice of pieces near a ray d: any three corners of an outline, within twice their displacement plus `margin`
// [pixels] of d.
struct Near {
  glm::dvec3 d;
  double margin;
  double without_area;  // error of a piece that may have no area
};

// Largest error(corners) of the pieces near a ray; infinite where no piece is near. Displacing the corners by `reach`
// changes terms and area by 4 reach / altitude.
template <class Error>
double error_near(const Projected& scene, const Triangle& t, std::span<const glm::dvec2> outline, const Near& near,
                  Error error) {
  double out = -1;
  each_piece(outline, [&](const std::array<glm::dvec2, 3>& piece) {
    if (distance_to_triangle(glm::dvec2(near.d), piece) > 2 * t.reach + near.margin) return;
    const double height = altitude(piece[0], piece[1], piece[2]) - 2 * (t.reach - t.snap);
    WindowCorners corners;
    for (std::size_t i = 0; i < 3; ++i) {
      double z_view = 0.5 + glm::dot(t.z_plane, glm::dvec3(piece[i], 1));
      if (!scene.depth_clamp) z_view = std::clamp(z_view, 0.0, 1.0);  // the near and the far plane cut it
      corners[i] = {piece[i] + 0.5 * glm::dvec2(scene.width, scene.height), to_window(t, z_view)};
    }
    const double off = 1 + 4 * t.reach / height;
    out = std::max(out, height > 0 ? off * off * error(corners) : near.without_area);
  });
  return out < 0 ? kInfinity : out;
}

// Window z where the number that is interpolated for depths is 0 (depth_error()); nullopt: it is window z.
std::optional<double> z_of_zero(const Projected& scene, const Triangle& t) {
  return scene.z_view_of_zero ? std::optional(to_window(t, *scene.z_view_of_zero)) : std::nullopt;
}

glm::dvec2 frame_of(const Projected& scene) { return {scene.width, scene.height}; }

// Bounds of any piece of a cut triangle: the largest slope of its values [1 / pixel], z_of_zero() that they are counted
// from, and its altitudes.
struct AnyPiece {
  double slope;
  std::optional<double> z_of_zero;
  const PieceAltitudes& altitudes;
};

// Error of a plane in the pieces of a cut triangle, the smaller of two bounds: error_near(), and, where the near and
// the far plane cut, depth_error_of_pieces() of values of at most 1.
template <class Error>
double error_of_pieces(const Projected& scene, const Triangle& t, const Near& near, const AnyPiece& any, Error error) {
  const Conventions::DepthArithmetic arithmetic = scene.conventions.depth_arithmetic;
  // A plane through corners displaced by `reach` is steeper than the triangle by 4 reach / altitude of its slope.
  const auto of_pieces = [&](const std::vector<glm::dvec2>& outline, double altitude, glm::dvec2 extent) {
    if (scene.depth_clamp) return error_near(scene, t, outline, near, error);
    const double of_near = error_near(scene, t, outline, {near.d, near.margin, kInfinity}, error);
    const double steeper = any.slope * (1 + 4 * t.reach / altitude);
    return std::min(of_near,
                    depth_error_of_pieces(arithmetic, altitude, steeper, extent, frame_of(scene), any.z_of_zero));
  };
  const double framed = of_pieces(t.outline, any.altitudes.framed, {scene.width, scene.height});
  if (t.guarded.extent == glm::dvec2(0)) return framed;
  return std::max(framed, of_pieces(t.guarded.outline, any.altitudes.guarded, t.guarded.extent));
}

}  // namespace

double error_in_float(const Projected& scene, const Triangle& t, glm::dvec3 d, const PieceAltitudes& altitudes) {
  const Conventions::DepthArithmetic arithmetic = scene.conventions.depth_arithmetic;
  if (arithmetic == Conventions::DepthArithmetic::in_double && !scene.z_view_of_zero) return 0;
  const glm::dvec2 p = glm::dvec2(d) + 0.5 * glm::dvec2(scene.width, scene.height);
  const double slope = range_scale(t) * glm::length(glm::dvec2(t.z_plane));
  const std::optional<double> from = z_of_zero(scene, t);
  const auto error = [&](const WindowCorners& corners) {
    return depth_error(arithmetic, corners, p, frame_of(scene), from);
  };
  if (t.cut && !(altitudes.framed > 0)) return kInfinity;
  const double out = t.cut ? error_of_pieces(scene, t, {d, 0, kInfinity}, {slope, from, altitudes}, error) : 0;
  return t.ahead ? std::max(out, error(window_corners(scene, t))) : out;
}

double shares_error_in_float(const Projected& scene, const Triangle& t, glm::dvec3 d, const PieceAltitudes& altitudes,
                             double slope) {
  const Conventions::DepthArithmetic arithmetic = scene.conventions.depth_arithmetic;
  if (arithmetic == Conventions::DepthArithmetic::in_double) return 0;
  const glm::dvec2 p = glm::dvec2(d) + 0.5 * glm::dvec2(scene.width, scene.height);
  const auto error = [&](const WindowCorners& corners) {
    return shares_error(arithmetic, corners, p, frame_of(scene));
  };
  const Near near{d, glm::length(scene.sample), 0};  // d: the pixel's centre, where a sample is covered
  const double of_pieces = t.cut ? error_of_pieces(scene, t, near, {slope, {}, altitudes}, error) : 0,
               out = std::isfinite(of_pieces) ? of_pieces : 0;
  return t.ahead ? std::max(out, error(window_corners(scene, t))) : out;
}

}  // namespace plumbline::math
