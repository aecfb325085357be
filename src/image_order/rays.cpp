#include "image_order/rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "capture/stages.h"
#include "scene/antialias.h"

namespace plumbline::image_order {

View::View(const Scene& scene)
    : eye_(scene.camera.eye),
      parallel_(false),
      frame_(scene.frame.width, scene.frame.height),
      place_(0.5 + glm::dvec2(sample_offset(scene.frame)) / static_cast<double>(kSubpixel) - scene.frame.pass.shift) {
  forward_ = glm::normalize(scene.camera.center - eye_);
  right_ = glm::normalize(glm::cross(forward_, scene.camera.up));
  up_ = glm::cross(right_, forward_);
  switch (scene.dialect) {
    case Dialect::gl: set_opengl(scene, 1); break;
    case Dialect::games101:
      set_opengl(scene, -1);
      depth_ = Depth::falls;
      break;
    case Dialect::gzrender: set_gzrender(std::get<ViewPlane>(scene.projection)); break;
    case Dialect::tinyrenderer: set_tinyrenderer(scene.camera, std::get<Pinhole>(scene.projection)); break;
  }
}

// Projections of gl and games101. `sign`: 1 where near and far are distances, -1 where they are coordinates.
void View::set_opengl(const Scene& scene, double sign) {
  const auto set = [&](const auto& p, double distance) {
    left_ = p.left / distance;
    bottom_ = p.bottom / distance;
    width_ = (p.right - p.left) / distance;
    height_ = (p.top - p.bottom) / distance;
    near_ = sign * p.near;
    far_ = sign * p.far;
  };
  if (const auto* p = std::get_if<Perspective>(&scene.projection)) {
    const double top = std::tan(glm::radians(p->fov_y_degrees) / 2), right = top * frame_.x / frame_.y;
    set(Frustum{-right, right, -top, top, p->near, p->far}, 1);
  } else if (const auto* f = std::get_if<Frustum>(&scene.projection)) {
    set(*f, f->near);
  } else {
    set(std::get<Orthographic>(scene.projection), 1);
    parallel_ = true;
  }
}

// The view plane goes through the camera's `eye` and is two units wide and high; rays start d behind it. The world is
// left-handed: right is the negative of the constructor's cross product. Rows grow downwards.
void View::set_gzrender(const ViewPlane& plane) {
  const double half = std::tan(glm::radians(plane.fov_degrees) / 2);
  near_ = 1 / half;
  far_ = std::numeric_limits<double>::infinity();
  eye_ -= near_ * forward_;
  right_ = -right_;
  up_ = -up_;
  set_whole_centres(half);
}

// The window is [-1, 1] in x and y on the plane at distance c from the eye, where w is 1.
void View::set_tinyrenderer(const Camera& camera, const Pinhole& pinhole) {
  eye_ = camera.center - pinhole.c * forward_;
  // Planes through the eye are seen edge on. Rounding puts their crossings at distances of a few 2^-53 c: below `near`.
  near_ = 1e-12 * pinhole.c;
  far_ = std::numeric_limits<double>::infinity();
  depth_ = Depth::of_pinhole;
  c_ = pinhole.c;
  set_whole_centres(1 / pinhole.c);
}

// Window [-half, half] in x and y, on the plane one unit before the eye, whose borders at column 0 and row 0 run
// through pixel centres: the frame's window is moved by half a pixel.
void View::set_whole_centres(double half) {
  width_ = height_ = 2 * half;
  left_ = -half - half / frame_.x;
  bottom_ = -half - half / frame_.y;
}

Ray View::ray(int x, int y) const {
  const double s = left_ + (x + place_.x) * width_ / frame_.x, t = bottom_ + (y + place_.y) * height_ / frame_.y;
  if (parallel_) return {eye_ + s * right_ + t * up_, right_, up_, forward_};
  // The ray's direction, forward + s right + t up, lies in both planes.
  return {eye_, right_ - s * forward_, up_ - t * forward_, forward_};
}

double View::window_z(double along) const {
  switch (depth_) {
    case Depth::rises: return std::clamp(from_near(along), 0.0, 1.0);
    case Depth::falls: return std::clamp(1 - from_near(along), 0.0, 1.0);
    // z/(1 - z/c) with z = c - along, from [-1, 1].
    case Depth::of_pinhole: return std::clamp(0.5 + 0.5 * c_ * (c_ / along - 1), 0.0, 1.0);
  }
  return 0;
}

double View::from_near(double along) const {
  if (parallel_) return (along - near_) / (far_ - near_);
  if (std::isinf(far_)) return 1 - near_ / along;
  return far_ / (far_ - near_) * (1 - near_ / along);
}

}  // namespace plumbline::image_order
