#include "reference/exact/frame.h"

#include <algorithm>
#include <cmath>

#include "reference/exact/input.h"
#include "reference/math/depth_format.h"

namespace plumbline::exact {

using math::in_format;
using math::passes;

namespace {

/// Calls visit(index of the fragment, its draw, its primitive) for each fragment in draw order.
template <class Visit>
void for_each_fragment(const Scene& scene, const Records<double>& records, Visit visit) {
  require_size("records.depth", records.depth.size(), records.covered.size());
  const DrawOf draw_of(scene);
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const std::uint32_t primitive = records.triangles[run.triangle].primitive;
    const Draw& draw = draw_of(primitive);
    for (std::size_t i = run.first; i < run.last; ++i) visit(i, draw, static_cast<std::int32_t>(primitive));
  }
}

glm::vec4 kept_color(ColorFormat format, glm::dvec4 color) {
  return glm::vec4(format == ColorFormat::rgba32f ? color : glm::clamp(color, 0.0, 1.0));
}

/// The fragments that made the winners `id`, which passed, as nothing else is known.
std::vector<Drawn> drawn_by_winners(const Scene& scene, const Records<double>& records, const Plane<std::int32_t>& id) {
  const FrameFormat& frame = scene.frame;
  require_size("planes.id", id.size(), static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  std::vector<Drawn> drawn(records.covered.size());
  DepthBuffer buffer(frame);
  Plane<std::uint8_t> written(frame.width, frame.height, 0);
  for_each_fragment(scene, records, [&](std::size_t i, const Draw& draw, std::int32_t primitive) {
    const Covered& c = records.covered[i];
    if (id(c.x, c.y) != primitive) return;
    // A cut primitive may have two triangles at a pixel: the later one has to pass the earlier.
    Draw first = {};
    first.depth_func = DepthFunc::always;
    first.merge.depth_mask = draw.merge.depth_mask;
    drawn[i].drawn = buffer.test(c.x, c.y, written(c.x, c.y) == 0 ? first : draw, records.depth[i]);
    written(c.x, c.y) = 1;
  });
  return drawn;
}

}  // namespace

DepthBuffer::DepthBuffer(const FrameFormat& frame)
    : format_(frame.depth), plane_(frame.width, frame.height, in_format(frame.depth, frame.clear_depth)) {}

bool DepthBuffer::test(int x, int y, const Draw& draw, double depth) {
  const double incoming = in_format(format_, depth);  // equal codes are equal numbers
  if (!passes(draw.depth_func, incoming, plane_(x, y))) return false;
  store(x, y, draw, depth);
  return true;
}

void DepthBuffer::store(int x, int y, const Draw& draw, double depth) {
  if (draw.merge.depth_mask) plane_(x, y) = in_format(format_, depth);
}

static_assert(sizeof(math::FrameColor) <= 18 * sizeof(double), "more than plane_bytes() counts");

ColorBuffer::ColorBuffer(const Scene& scene) : format_(scene.frame.color) {
  const FrameFormat& frame = scene.frame;
  if (colors_replace(scene)) {
    replaced_ = {frame.width, frame.height, kept_color(format_, glm::dvec4(frame.clear_color))};
  } else {
    blended_ = {frame.width, frame.height, math::FrameColor(frame)};
  }
}

void ColorBuffer::write(int x, int y, const Merge& state, const glm::dvec4& color) {
  if (blended_.empty()) {
    replaced_(x, y) = kept_color(format_, color);
  } else {
    blended_(x, y).write(state, math::around(color, 0));
  }
}

Plane<glm::vec4> ColorBuffer::take() {
  if (blended_.empty()) return std::move(replaced_);
  Plane<glm::vec4> out(blended_.width(), blended_.height());
  std::transform(blended_.values().begin(), blended_.values().end(), out.values().begin(),
                 [](const math::FrameColor& color) { return glm::vec4(math::middle(color.written())); });
  return out;
}

void ColorBuffer::take_bounds(Legal& out) const {
  if (blended_.empty()) return;
  out.color_lo = out.color_hi = {blended_.width(), blended_.height()};
  for (std::size_t i = 0; i < blended_.size(); ++i) {
    const math::ColorInterval color = blended_.values()[i].written();
    out.color_lo.values()[i] = math::low(color);
    out.color_hi.values()[i] = math::high(color);
  }
}

std::vector<Drawn> drawn_fragments(const Scene& scene, const Records<double>& records) {
  std::vector<Drawn> drawn(records.covered.size());
  DepthBuffer buffer(scene.frame);
  for_each_fragment(scene, records, [&](std::size_t i, const Draw& draw, std::int32_t) {
    const Covered& c = records.covered[i];
    drawn[i].drawn = buffer.test(c.x, c.y, draw, records.depth[i]);
  });
  return drawn;
}

Plane<std::int32_t> visible_primitives(const Scene& scene, const Records<double>& records,
                                       const std::vector<Drawn>& drawn) {
  Plane<std::int32_t> id(scene.frame.width, scene.frame.height, kBackground);
  for_each_fragment(scene, records, [&](std::size_t i, const Draw&, std::int32_t primitive) {
    if (drawn[i].drawn) id(records.covered[i].x, records.covered[i].y) = primitive;
  });
  return id;
}

void merge_fragments(const Scene& scene, const Capture& in, Capture& out) {
  const Records<double>& records = in.records;
  require_size("records.shaded", records.shaded.size(), records.covered.size());
  const std::vector<Drawn> drawn = !records.drawn.empty() ? records.drawn
                                   : in.planes.id.empty() ? drawn_fragments(scene, records)
                                                          : drawn_by_winners(scene, records, in.planes.id);
  require_size("records.drawn", drawn.size(), records.covered.size());
  DepthBuffer depth(scene.frame);
  ColorBuffer color(scene);
  for_each_fragment(scene, records, [&](std::size_t i, const Draw& draw, std::int32_t) {
    const Covered& c = records.covered[i];
    if (!drawn[i].drawn) return;
    depth.store(c.x, c.y, draw, records.depth[i]);
    color.write(c.x, c.y, draw.merge, records.shaded[i].color);
  });
  out.planes.depth = depth.take();
  color.take_bounds(out.legal);
  out.planes.color = color.take();
}

}  // namespace plumbline::exact
