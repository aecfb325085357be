#include "image_order/rays.h"

#include <algorithm>
#include <cmath>

namespace plumbline::image_order {

View::View(const Scene& scene)
    : eye_(scene.camera.eye), parallel_(false), frame_(scene.frame.width, scene.frame.height) {
  forward_ = glm::normalize(scene.camera.center - eye_);
  right_ = glm::normalize(glm::cross(forward_, scene.camera.up));
  up_ = glm::cross(right_, forward_);
  const auto set_window = [&](const auto& p, double distance) {
    left_ = p.left / distance;
    bottom_ = p.bottom / distance;
    width_ = (p.right - p.left) / distance;
    height_ = (p.top - p.bottom) / distance;
    near_ = p.near;
    far_ = p.far;
  };
  if (const auto* p = std::get_if<Perspective>(&scene.projection)) {
    const double top = p->near * std::tan(glm::radians(p->fov_y_degrees) / 2), right = top * frame_.x / frame_.y;
    set_window(Frustum{-right, right, -top, top, p->near, p->far}, p->near);
  } else if (const auto* f = std::get_if<Frustum>(&scene.projection)) {
    set_window(*f, f->near);
  } else {
    set_window(std::get<Orthographic>(scene.projection), 1);
    parallel_ = true;
  }
}

Ray View::ray(int x, int y) const {
  const double s = left_ + (x + 0.5) * width_ / frame_.x, t = bottom_ + (y + 0.5) * height_ / frame_.y;
  if (parallel_) return {eye_ + s * right_ + t * up_, right_, up_, forward_};
  // forward + s right + t up is on both planes.
  return {eye_, right_ - s * forward_, up_ - t * forward_, forward_};
}

double View::window_z(double along) const {
  const double z = parallel_ ? (along - near_) / (far_ - near_) : far_ / (far_ - near_) * (1 - near_ / along);
  return std::clamp(z, 0.0, 1.0);
}

}  // namespace plumbline::image_order
