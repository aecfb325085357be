#include "reference/exact/frame.h"

#include <algorithm>
#include <cmath>

#include "reference/exact/input.h"
#include "reference/math/depth_format.h"

namespace plumbline::exact {

using math::in_format;
using math::passes;

namespace {

/// Calls visit(index of the fragment, its depth function, its primitive) for each fragment in draw order.
template <class Visit>
void for_each_fragment(const Scene& scene, const Records<double>& records, Visit visit) {
  require_size("records.depth", records.depth.size(), records.covered.size());
  const DrawOf draw_of(scene);
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const std::uint32_t primitive = records.triangles[run.triangle].primitive;
    const DepthFunc func = draw_of(primitive).depth_func;
    for (std::size_t i = run.first; i < run.last; ++i) visit(i, func, static_cast<std::int32_t>(primitive));
  }
}

}  // namespace

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
  return glm::vec4(format == ColorFormat::rgba32f ? color : glm::clamp(color, 0.0, 1.0));
}

Plane<std::int32_t> visible_primitives(const Scene& scene, const Records<double>& records) {
  Plane<std::int32_t> id(scene.frame.width, scene.frame.height, kBackground);
  DepthBuffer buffer(scene.frame);
  for_each_fragment(scene, records, [&](std::size_t i, DepthFunc func, std::int32_t primitive) {
    const Covered& c = records.covered[i];
    if (buffer.test(c.x, c.y, func, records.depth[i])) id(c.x, c.y) = primitive;
  });
  return id;
}

void merge_fragments(const Scene& scene, const Records<double>& records, const Plane<std::int32_t>& id, Planes& out) {
  require_size("records.shaded", records.shaded.size(), records.covered.size());
  const FrameFormat& frame = scene.frame;
  require_size("planes.id", id.size(), static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  out.color = Plane<glm::vec4>(frame.width, frame.height, kept_color(frame.color, glm::dvec4(frame.clear_color)));
  out.depth = Plane<double>(frame.width, frame.height, in_format(frame.depth, frame.clear_depth));
  Plane<std::uint8_t> written(frame.width, frame.height, 0);
  for_each_fragment(scene, records, [&](std::size_t i, DepthFunc func, std::int32_t primitive) {
    const Covered& c = records.covered[i];
    if (id(c.x, c.y) != primitive) return;
    const double incoming = in_format(frame.depth, records.depth[i]);
    // A cut primitive may have two triangles at a pixel: the later one has to pass the earlier.
    if (written(c.x, c.y) != 0 && !passes(func, incoming, out.depth(c.x, c.y))) return;
    written(c.x, c.y) = 1;
    out.depth(c.x, c.y) = incoming;
    out.color(c.x, c.y) = kept_color(frame.color, records.shaded[i].color);
  });
}

}  // namespace plumbline::exact
