#include "reference/exact/frame.h"

#include <algorithm>
#include <cmath>

#include "reference/arithmetic/depth_format.h"
#include "reference/exact/input.h"

namespace plumbline::exact {

using math::in_format;

namespace {

/// Comparison `a func b`. The values of CompareFunc, in OpenGL's order, are sets of bits: the relations that pass are
/// less (1), equal (2) and greater (4). NaN passes `always` only.
bool passes(CompareFunc func, double a, double b) {
  const int relation = a < b ? 1 : a == b ? 2 : a > b ? 4 : 0;
  return func == CompareFunc::always || (static_cast<int>(func) & relation) != 0;
}

/// OpenGL 4.5, compatibility profile, section 17.3.4: both values in the frame's format.
bool alpha_passes(const AlphaTest& test, ColorFormat format, double alpha) {
  double codes = 0;
  switch (format) {
    case ColorFormat::rgba8: codes = 0xff; break;
    case ColorFormat::rgba12: codes = 0xfff; break;
    case ColorFormat::rgba16: codes = 0xffff; break;
    case ColorFormat::rgba32f: return passes(test.func, alpha, test.reference);
  }
  const auto code = [&](double value) { return std::nearbyint(codes * std::min(std::max(value, 0.0), 1.0)); };
  return passes(test.func, code(alpha), code(test.reference));
}

/// OpenGL 4.5, section 17.3.5.
bool stencil_passes(const StencilFace& face, unsigned held) {
  return passes(face.func, static_cast<unsigned>(face.reference) & face.mask, held & face.mask);
}

std::uint8_t stencil_value(const StencilFace& face, StencilOp op, unsigned held) {
  unsigned value = held;
  switch (op) {
    case StencilOp::keep: break;
    case StencilOp::zero: value = 0; break;
    case StencilOp::replace: value = face.reference; break;
    case StencilOp::increment: value = held == 255 ? 255 : held + 1; break;
    case StencilOp::increment_wrap: value = held == 255 ? 0 : held + 1; break;
    case StencilOp::decrement: value = held == 0 ? 0 : held - 1; break;
    case StencilOp::decrement_wrap: value = held == 0 ? 255 : held - 1; break;
    case StencilOp::invert: value = 255 - held; break;
  }
  const unsigned changed = (held ^ value) & face.write_mask;
  return static_cast<std::uint8_t>(held ^ changed);
}

/// Calls visit(index of the fragment, the fragment, its primitive) for each fragment in draw order.
template <class Visit>
void for_each_fragment(const Scene& scene, const Records<double>& records, Visit visit) {
  require_size("records.depth", records.depth.size(), records.covered.size());
  const DrawOf draw_of(scene);
  for (const FragmentRun& run : runs_by_triangle(scene, records)) {
    const WindowTriangle<double>& triangle = records.triangles[run.triangle];
    const Draw& draw = draw_of(triangle.primitive);
    if (draw.alpha_test) require_size("records.shaded", records.shaded.size(), records.covered.size());
    for (std::size_t i = run.first; i < run.last; ++i) {
      const Covered& c = records.covered[i];
      const double alpha = draw.alpha_test ? records.shaded[i].color.a : 0;
      visit(i, Fragment{c.x, c.y, draw, triangle.front, records.depth[i], alpha},
            static_cast<std::int32_t>(triangle.primitive));
    }
  }
}

glm::vec4 kept_color(ColorFormat format, glm::dvec4 color) {
  return glm::vec4(format == ColorFormat::rgba32f ? color : glm::clamp(color, 0.0, 1.0));
}

/// Whether each pixel's winner alone leaves its colour and depth.
bool shows_winners_alone(const Scene& scene) { return colors_replace(scene) && depths_replace(scene); }

/// Drawn fragments by the winners `id`: at each pixel those of the winning primitive that pass in turn.
std::vector<Drawn> drawn_by_winners(const Scene& scene, const Records<double>& records, const Plane<std::int32_t>& id) {
  const FrameFormat& frame = scene.frame;
  require_size("planes.id", id.size(), static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  std::vector<Drawn> drawn(records.covered.size());
  TestedFrame buffer(frame);
  Plane<std::uint8_t> written(frame.width, frame.height, 0);
  for_each_fragment(scene, records, [&](std::size_t i, const Fragment& f, std::int32_t primitive) {
    if (id(f.x, f.y) != primitive) return;
    // Of a cut primitive's two triangles at a pixel, the later must pass the earlier's depth.
    Draw known = f.draw;
    known.stencil.reset();  // the stored stencil value is not known
    if (written(f.x, f.y) == 0) known.depth_func = DepthFunc::always;
    drawn[i].drawn = buffer.test({f.x, f.y, known, f.front, f.depth, f.alpha});
    written(f.x, f.y) = 1;
  });
  return drawn;
}

}  // namespace

TestedFrame::TestedFrame(const FrameFormat& frame)
    : format_(frame.depth),
      color_(frame.color),
      depth_(frame.width, frame.height, in_format(frame.depth, frame.clear_depth)) {
  if (frame.stencil != StencilFormat::none) stencil_ = {frame.width, frame.height, frame.clear_stencil};
}

bool TestedFrame::test(const Fragment& f) {
  const Draw& draw = f.draw;
  if (draw.alpha_test && !alpha_passes(*draw.alpha_test, color_, f.alpha)) return false;
  const double incoming = in_format(format_, f.depth);  // equal codes are equal numbers
  const bool passes_depth = passes(draw.depth_func, incoming, depth_(f.x, f.y));
  if (draw.stencil) {
    const StencilFace& face = f.front ? draw.stencil->front : draw.stencil->back;
    std::uint8_t& held = stencil_(f.x, f.y);
    const bool passed = stencil_passes(face, held);
    held = stencil_value(face, !passed ? face.fail : passes_depth ? face.pass : face.depth_fail, held);
    if (!passed) return false;
  }
  if (passes_depth) store(f);
  return passes_depth;
}

void TestedFrame::store(const Fragment& f) {
  if (f.draw.merge.depth_mask) depth_(f.x, f.y) = in_format(format_, f.depth);
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

std::vector<Drawn> drawn_fragments(const Scene& scene, const Records<double>& records, Plane<std::uint8_t>& stencil) {
  std::vector<Drawn> drawn(records.covered.size());
  TestedFrame buffer(scene.frame);
  for_each_fragment(scene, records,
                    [&](std::size_t i, const Fragment& f, std::int32_t) { drawn[i].drawn = buffer.test(f); });
  stencil = buffer.take_stencil();
  return drawn;
}

Plane<std::int32_t> visible_primitives(const Scene& scene, const Records<double>& records,
                                       const std::vector<Drawn>& drawn) {
  Plane<std::int32_t> id(scene.frame.width, scene.frame.height, kBackground);
  for_each_fragment(scene, records, [&](std::size_t i, const Fragment& f, std::int32_t primitive) {
    if (drawn[i].drawn) id(f.x, f.y) = primitive;
  });
  return id;
}

void merge_fragments(const Scene& scene, const Capture& in, Capture& out) {
  const Records<double>& records = in.records;
  require_size("records.shaded", records.shaded.size(), records.covered.size());
  Plane<std::uint8_t> stencil;  // stage 10's result, not needed here
  const bool by_winners = !in.planes.id.empty() && shows_winners_alone(scene);
  const std::vector<Drawn> drawn = !records.drawn.empty() ? records.drawn
                                   : by_winners           ? drawn_by_winners(scene, records, in.planes.id)
                                                          : drawn_fragments(scene, records, stencil);
  require_size("records.drawn", drawn.size(), records.covered.size());
  TestedFrame tested(scene.frame);
  ColorBuffer color(scene);
  for_each_fragment(scene, records, [&](std::size_t i, const Fragment& f, std::int32_t) {
    if (!drawn[i].drawn) return;
    tested.store(f);
    color.write(f.x, f.y, f.draw.merge, records.shaded[i].color);
  });
  out.planes.depth = tested.take_depth();
  color.take_bounds(out.legal);
  out.planes.color = color.take();
}

}  // namespace plumbline::exact
