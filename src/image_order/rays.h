// Rays: pixels of image space, transformed to world space.
//
// A ray is held as the two planes that meet in it (Kajiya, "Ray tracing parametric patches", SIGGRAPH 1982): the plane
// of its pixel's column and that of its row, both through the ray's origin. A point is on the ray's line where its
// distance from both is 0; no direction needs to be followed.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline::image_order {

/// Ray in world space. `column` and `row` are normals of planes, not of unit length.
struct Ray {
  glm::dvec3 origin;
  glm::dvec3 column;   ///< the column's plane: dot(column, p - origin) = 0; greater towards greater pixel x
  glm::dvec3 row;      ///< the row's plane: dot(row, p - origin) = 0; greater towards greater y (gzrender: downwards)
  glm::dvec3 forward;  ///< unit length: dot(forward, p - origin) is how far p is along the view
};

/// A point relative to a ray: its dot products with the ray's column, row and forward.
struct Seen {
  double x, y;   ///< towards greater pixel x and y; 0 on the ray
  double along;  ///< distance along the view
};

/// n . from_origin, summed in one order everywhere: rounding is monotone, so that bounds of a box's corners are, to the
/// bit, bounds of the points in the box.
inline double along(const glm::dvec3& n, const glm::dvec3& from_origin) {
  return (n.x * from_origin.x + n.y * from_origin.y) + n.z * from_origin.z;
}
inline Seen seen(const Ray& ray, const glm::dvec3& p) {
  const glm::dvec3 d = p - ray.origin;
  return {along(ray.column, d), along(ray.row, d), along(ray.forward, d)};
}

/// Camera and projection of a scene, from its dialect's own parameters: turns pixels into rays, and distances along the
/// view into depths.
class View {
 public:
  /// `scene`: its projection is one of its dialect's (scene.h).
  explicit View(const Scene& scene);

  /// Ray through the centre of pixel (x, y), rows in the dialect's order; in a pass, through its sample or shifted
  /// centre.
  Ray ray(int x, int y) const;

  /// Range of distances along the view that are seen; far() may be infinite.
  double near() const { return near_; }
  double far() const { return far_; }

  /// Window z, [0,1], before the draw's depth range, at distance `along` (GL 2.1 specification, 2.11.1 and 2.11.2, in
  /// one formula). Monotone, in its rounding, too: it never falls as `along` grows (in games101 and tinyrenderer: never
  /// rises).
  double window_z(double along) const;

 private:
  glm::dvec3 eye_, right_, up_, forward_;
  bool parallel_;  ///< orthographic: rays have one direction; else they have one origin, the eye
  /// The window, in the plane one unit before the eye (orthographic: in any).
  double left_, bottom_, width_, height_;
  glm::dvec2 frame_;  ///< pixels
  glm::dvec2 place_;  ///< where rays go through a pixel [pixels from its corner]
  double near_, far_;
  enum class Depth { rises, falls, of_pinhole } depth_ = Depth::rises;
  double c_ = 0;  ///< Pinhole::c

  void set_opengl(const Scene& scene, double sign);
  void set_gzrender(const ViewPlane& plane);
  void set_tinyrenderer(const Camera& camera, const Pinhole& pinhole);
  void set_whole_centres(double half);
  double from_near(double along) const;
};

}  // namespace plumbline::image_order
