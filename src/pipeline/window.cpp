#include "pipeline/geometry.h"

#include <cmath>

namespace plumbline::pipeline {

namespace {

WindowVertex window_vertex(const Matrices<float>& m, const ClipVertex& in) {
  WindowVertex out{};
  out.inv_w = 1.0f / in.p_clip.w;
  for (int i = 0; i < 3; ++i) {
    const float p_ndc = in.p_clip[i] * out.inv_w;
    out.p_win[i] =
        in.cut ? p_ndc * m.win_scale[i] + m.win_translate[i] : std::fma(p_ndc, m.win_scale[i], m.win_translate[i]);
  }
  return out;
}

// Whether z and 1/w are finite, and x and y near enough to be snapped to an int. Clipped vertices may fail: 1/w may
// overflow, and rounding may move a cut at a tiny w far outside of the frame.
bool drawable(const WindowVertex& v) {
  constexpr float kFarthest = 1 << 20;
  return std::abs(v.p_win.x) <= kFarthest && std::abs(v.p_win.y) <= kFarthest && std::isfinite(v.p_win.z) &&
         std::isfinite(v.inv_w);
}

}  // namespace

void to_window(const DrawInput& input, const Polygon& polygon, std::vector<ShadedTriangle>& out) {
  const Draw& draw = *input.draw;
  FixedVector<WindowVertex, Polygon::kMostCorners> v;
  for (const ClipVertex& corner : polygon.corners) {
    v.push_back(window_vertex(input.matrices, corner));
    WindowVertex& made = v[v.size() - 1];
    if (!drawable(made)) return;
    made.snapped = {snap(made.p_win.x), snap(made.p_win.y)};
  }
  const auto add = [&](const std::array<std::size_t, 3>& c, bool front, std::uint32_t corners, int width) {
    ShadedTriangle triangle{
        {{v[c[0]], v[c[1]], v[c[2]]}, polygon.primitive, front, corners, static_cast<std::uint32_t>(width)}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      Attributes& to = triangle.attributes[k] = polygon.corners[c[k]].attributes;
      if (front || !input.two_sided) continue;
      to.color() = to[Varying::back_color];
      to[Varying::secondary] = to[Varying::back_secondary];
    }
    out.push_back(triangle);
  };
  const auto add_line = [&](std::size_t a, std::size_t b, bool front) { add({a, b, b}, front, 2, draw.line_width); };
  const auto add_point = [&](std::size_t p, bool front) { add({p, p, p}, front, 1, draw.point_size); };
  if (v.size() == 1) return add_point(0, true);
  if (v.size() == 2) return add_line(0, 1, true);
  const auto area = [&](std::size_t i) { return snapped_area({{v[i - 1], v[i], v[0]}}); };
  const auto add_triangle = [&](std::size_t i, bool front) { add({i - 1, i, 0}, front, 3, 1); };
  visit_polygon(draw, v.size(), area, add_triangle, add_line, add_point);
}

}  // namespace plumbline::pipeline
