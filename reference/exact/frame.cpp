#include "reference/exact/frame.h"

#include <algorithm>
#include <cmath>

#include "reference/exact/input.h"

namespace plumbline::exact {
namespace {

/// Calls winner(index of the fragment) for each fragment that passes, in draw order; returns the depths that remain.
template <class Winner>
Plane<double> fold(const Scene& scene, const Records<double>& records, Winner winner) {
  require_size("records.depth", records.depth.size(), records.covered.size());
  const DrawOf draw_of(scene);
  DepthBuffer buffer(scene.frame);
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const DepthFunc func = draw_of(records.triangles[run.triangle].primitive).depth_func;
    for (std::size_t i = run.first; i < run.last; ++i)
      if (buffer.test(records.covered[i].x, records.covered[i].y, func, records.depth[i])) winner(i);
  }
  return buffer.take();
}

}  // namespace

double in_format(DepthFormat format, double z_win) {
  const double z = std::clamp(z_win, 0.0, 1.0), scale = depth_scale(format);
  return scale > 0 ? std::round(z * scale) / scale : static_cast<double>(static_cast<float>(z));
}

bool passes(DepthFunc func, double incoming, double stored) {
  switch (func) {
    case DepthFunc::never: return false;
    case DepthFunc::less: return incoming < stored;
    case DepthFunc::equal: return incoming == stored;
    case DepthFunc::less_equal: return incoming <= stored;
    case DepthFunc::greater: return incoming > stored;
    case DepthFunc::not_equal: return incoming != stored;
    case DepthFunc::greater_equal: return incoming >= stored;
    case DepthFunc::always: return true;
  }
  return false;
}

DepthBuffer::DepthBuffer(const FrameFormat& frame)
    : format_(frame.depth), plane_(frame.width, frame.height, in_format(frame.depth, frame.clear_depth)) {}

bool DepthBuffer::test(int x, int y, DepthFunc func, double depth) {
  const double incoming = in_format(format_, depth);  // equal codes are equal numbers
  double& stored = plane_(x, y);
  if (!passes(func, incoming, stored)) return false;
  stored = incoming;
  return true;
}

glm::vec4 kept_color(ColorFormat format, glm::dvec4 color) {
  return glm::vec4(format == ColorFormat::rgba8 ? glm::clamp(color, 0.0, 1.0) : color);
}

Plane<std::int32_t> visible_primitives(const Scene& scene, const Records<double>& records) {
  Plane<std::int32_t> id(scene.frame.width, scene.frame.height, kBackground);
  fold(scene, records, [&](std::size_t i) {
    const Covered& c = records.covered[i];
    id(c.x, c.y) = static_cast<std::int32_t>(records.triangles[c.triangle].primitive);
  });
  return id;
}

void merge_fragments(const Scene& scene, const Records<double>& records, Planes& out) {
  require_size("records.shaded", records.shaded.size(), records.covered.size());
  const FrameFormat& frame = scene.frame;
  out.color = Plane<glm::vec4>(frame.width, frame.height, kept_color(frame.color, glm::dvec4(frame.clear_color)));
  out.depth = fold(scene, records, [&](std::size_t i) {
    const Covered& c = records.covered[i];
    out.color(c.x, c.y) = kept_color(frame.color, records.shaded[i].color);
  });
}

}  // namespace plumbline::exact
