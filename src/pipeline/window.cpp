#include "pipeline/window.h"

#include <cmath>

namespace plumbline::pipeline {

namespace {

WindowVertex<float> window_vertex(const Matrices<float>& m, const ClipVertex<float>& in) {
  WindowVertex<float> out{};
  out.inv_w = 1.0f / in.p_clip.w;
  for (int i = 0; i < 3; ++i) {
    const float p_ndc = in.p_clip[i] * out.inv_w;
    out.p_win[i] =
        in.cut ? p_ndc * m.win_scale[i] + m.win_translate[i] : std::fma(p_ndc, m.win_scale[i], m.win_translate[i]);
  }
  out.color = in.color;
  return out;
}

// Finite, and near enough to be snapped to an int; after clipping all are, unless w is 0.
bool drawable(const WindowVertex<float>& v) {
  constexpr float kFarthest = 1 << 20;
  return std::abs(v.p_win.x) <= kFarthest && std::abs(v.p_win.y) <= kFarthest && std::isfinite(v.p_win.z) &&
         std::isfinite(v.inv_w);
}

}  // namespace

// The sum is exact in double, so that its fraction is; adding 1.5 * 2^52 rounds half to even.
int snap(float win) {
  constexpr double kRound = 6755399441055744.0;
  return static_cast<int>(((static_cast<double>(win) - 0.5) * kSubpixel + kRound) - kRound);
}

std::int64_t snapped_area(const WindowTriangle<float>& t) {
  const glm::i64vec2 a(t.v[0].snapped), b(t.v[1].snapped), c(t.v[2].snapped);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

namespace {

bool culled(Cull cull, bool front) { return cull != Cull::none && front == (cull == Cull::front); }

using Corners = std::span<const WindowVertex<float>>;

void add_line(const Draw& draw, const WindowVertex<float>& a, const WindowVertex<float>& b, std::uint32_t primitive,
              bool front, std::vector<WindowTriangle<float>>& out) {
  out.push_back({{a, b, b}, primitive, front, 2, static_cast<std::uint32_t>(draw.line_width)});
}

void add_point(const Draw& draw, const WindowVertex<float>& p, std::uint32_t primitive, bool front,
               std::vector<WindowTriangle<float>>& out) {
  out.push_back({{p, p, p}, primitive, front, 1, static_cast<std::uint32_t>(draw.point_size)});
}

void add_fan(const Draw& draw, Corners v, std::uint32_t primitive, std::vector<WindowTriangle<float>>& out) {
  for (std::size_t i = 2; i < v.size(); ++i) {
    WindowTriangle<float> triangle{{v[i - 1], v[i], v[0]}, primitive, false};
    const std::int64_t area = snapped_area(triangle);
    triangle.front = area > 0;
    if (area != 0 && !culled(draw.cull, triangle.front)) out.push_back(triangle);
  }
}

void add_polygon(const Draw& draw, Corners v, std::uint32_t primitive, std::vector<WindowTriangle<float>>& out) {
  if (draw.front_mode == PolygonMode::fill && draw.back_mode == PolygonMode::fill) {
    return add_fan(draw, v, primitive, out);
  }
  std::int64_t area = 0;
  for (std::size_t i = 2; i < v.size(); ++i) area += snapped_area({{v[i - 1], v[i], v[0]}, primitive, false});
  const bool front = area > 0;
  if (culled(draw.cull, front)) return;
  switch (front ? draw.front_mode : draw.back_mode) {
    case PolygonMode::fill: return add_fan(draw, v, primitive, out);
    case PolygonMode::line:
      for (std::size_t i = 0; i < v.size(); ++i) {
        add_line(draw, v[i == 0 ? v.size() - 1 : i - 1], v[i], primitive, front, out);
      }
      return;
    case PolygonMode::point:
      for (const WindowVertex<float>& corner : v) add_point(draw, corner, primitive, front, out);
      return;
  }
}

}  // namespace

void to_window(const Matrices<float>& matrices, const Draw& draw, const ClipPolygons<float>& polygons,
               std::span<const ClipPolygon> of_draw, std::vector<WindowTriangle<float>>& out) {
  for (const ClipPolygon& polygon : of_draw) {
    std::array<WindowVertex<float>, 28> v;  // the most that clipping makes (clip.cpp)
    bool drop = false;
    for (std::uint32_t i = 0; i < polygon.count; ++i) {
      v[i] = window_vertex(matrices, polygons.vertices[polygon.first + i]);
      drop |= !drawable(v[i]);
      if (!drop) v[i].snapped = {snap(v[i].p_win.x), snap(v[i].p_win.y)};
    }
    if (drop) continue;
    if (polygon.count == 1) {
      add_point(draw, v[0], polygon.primitive, true, out);
    } else if (polygon.count == 2) {
      add_line(draw, v[0], v[1], polygon.primitive, true, out);
    } else {
      add_polygon(draw, Corners(v.data(), polygon.count), polygon.primitive, out);
    }
  }
}

}  // namespace plumbline::pipeline
