// Rays: a pixel's place in image space, transformed to world space.
//
// A ray is held as the two planes that meet in it (Kajiya, "Ray tracing parametric patches", SIGGRAPH 1982): the plane
// of its pixel's column and that of its row, both through the ray's origin. A point is on the ray where its distance
// from both is 0; no direction needs to be followed.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline::image_order {

/// World space; lengths are those of the world.
struct Ray {
  glm::dvec3 origin;
  glm::dvec3 column;   ///< the column's plane: dot(column, p - origin) = 0; greater to the right of it
  glm::dvec3 row;      ///< the row's plane likewise; greater above it
  glm::dvec3 forward;  ///< unit length: dot(forward, p - origin) is how far p is along the view
};

/// A point of the world as a ray sees it.
struct Seen {
  double x, y;   ///< to the right of the column's plane, above the row's
  double along;  ///< the view
};

/// n . (p - origin), summed in one order everywhere: rounding is monotone, so that what holds for the corners of a box
/// holds, to the bit, for the points in it.
inline double along(const glm::dvec3& n, const glm::dvec3& from_origin) {
  return (n.x * from_origin.x + n.y * from_origin.y) + n.z * from_origin.z;
}
inline Seen seen(const Ray& ray, const glm::dvec3& p) {
  const glm::dvec3 d = p - ray.origin;
  return {along(ray.column, d), along(ray.row, d), along(ray.forward, d)};
}

/// A scene's camera and projection, in the terms of its dialect: turns pixels into rays and distances along the view
/// into depths.
class View {
 public:
  explicit View(const Scene& scene);

  /// The ray of pixel (x, y)'s centre, in the dialect's order of rows, or where the frame's pass looks instead.
  Ray ray(int x, int y) const;

  double near() const { return near_; }
  double far() const { return far_; }

  /// Window z in the range [0,1] of what is `along` far along the view (GL 2.1 specification, 2.11.1 and 2.11.2, in one
  /// formula). Where `along` grows it never falls (in games101 and tinyrenderer: never rises), not by a rounding
  /// either.
  double window_z(double along) const;

 private:
  glm::dvec3 eye_, right_, up_, forward_;
  bool parallel_;  ///< orthographic: rays have one direction; else one origin, the eye
  /// The window, in the plane one unit before the eye (orthographic: in any).
  double left_, bottom_, width_, height_;
  glm::dvec2 frame_;  ///< pixels
  glm::dvec2 place_;  ///< in a pixel
  double near_, far_;
  enum class Depth { rises, falls, of_pinhole } depth_ = Depth::rises;
  double c_ = 0;  ///< the pinhole's

  void set_opengl(const Scene& scene, double sign);
  void set_gzrender(const ViewPlane& plane);
  void set_tinyrenderer(const Camera& camera, const Pinhole& pinhole);
  void set_whole_centres(double half);
  double from_near(double along) const;
};

}  // namespace plumbline::image_order
