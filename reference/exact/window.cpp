#include "reference/exact/window.h"

#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "reference/exact/input.h"
#include "reference/exact/wide.h"

namespace plumbline::exact {
namespace {

std::optional<WindowVertex<double>> to_window(const ClipVertex<double>& v, const Matrices<double>& m) {
  if (!(v.p_clip.w > 0)) return std::nullopt;
  WindowVertex<double> out;
  out.p_win = glm::dvec3(v.p_clip) / v.p_clip.w * m.win_scale + m.win_translate;
  out.inv_w = 1 / v.p_clip.w;
  out.color = v.color;
  constexpr double kFarthest = 2147483000.0 / kSubpixel;
  const bool snaps = std::abs(out.p_win.x) < kFarthest && std::abs(out.p_win.y) < kFarthest;
  if (!snaps || !std::isfinite(out.p_win.z) || !std::isfinite(out.inv_w)) return std::nullopt;
  out.snapped = snap(glm::dvec2(out.p_win));
  return out;
}

bool culled(Cull cull, bool front) { return cull == Cull::back ? !front : cull == Cull::front && front; }

}  // namespace

glm::ivec2 snap(glm::dvec2 p_win) {
  // std::remainder rounds half to even in every rounding mode.
  const auto round = [](double v) { return static_cast<int>(v - std::remainder(v, 1.0)); };
  return {round((p_win.x - 0.5) * kSubpixel), round((p_win.y - 0.5) * kSubpixel)};
}

namespace {

/// Appends the records of an unfilled polygon (OpenGL 2.1, section 3.5.4): its boundary edges as lines, from each
/// corner to the next, or its corners as points. `front`: facing by the whole polygon's area, equation 3.6.
void append_outline(const Draw& draw, const std::vector<WindowVertex<double>>& corners, std::uint32_t primitive,
                    bool front, PolygonMode mode, std::vector<WindowTriangle<double>>& out) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const WindowVertex<double>&before = corners[(i + n - 1) % n], &corner = corners[i];
    if (mode == PolygonMode::line)
      out.push_back({{before, corner, corner}, primitive, front, 2, static_cast<std::uint32_t>(draw.line_width)});
    else
      out.push_back({{corner, corner, corner}, primitive, front, 1, static_cast<std::uint32_t>(draw.point_size)});
  }
}

/// Front facing: the snapped corners' area (shoelace formula) is positive.
bool faces_front(const std::vector<WindowVertex<double>>& corners) {
  Int128 area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::ivec2 a = corners[i].snapped, b = corners[(i + 1) % corners.size()].snapped;
    area += Int128{a.x} * b.y - Int128{b.x} * a.y;
  }
  return area > 0;
}

}  // namespace

int facing(const std::array<glm::ivec2, 3>& snapped) {
  const auto [a, b, c] = snapped;
  const Int128 bx = Int128{b.x} - a.x, by = Int128{b.y} - a.y, cx = Int128{c.x} - a.x, cy = Int128{c.y} - a.y;
  const Int128 area = bx * cy - by * cx;
  return (area > 0) - (area < 0);
}

std::array<glm::ivec2, 3> snapped_corners(const WindowTriangle<double>& triangle) {
  return {triangle.v[0].snapped, triangle.v[1].snapped, triangle.v[2].snapped};
}

std::vector<WindowTriangle<double>> window_triangles(const Scene& scene, const ClipPolygons<double>& polygons,
                                                     const std::vector<Matrices<double>>& matrices) {
  require_size("records.matrices", matrices.size(), scene.draws.size());
  const DrawOf draw_of(scene);
  std::vector<WindowTriangle<double>> triangles;
  std::vector<WindowVertex<double>> corners;
  for (const ClipPolygon& polygon : polygons.polygons) {
    require_index("a polygon's end", std::size_t{polygon.first} + polygon.count, polygons.vertices.size() + 1);
    const std::size_t draw = draw_of.index(polygon.primitive);
    const std::uint32_t corners_of_mesh = corner_count(scene.meshes[scene.draws[draw].mesh].topology);
    if (polygon.count < corners_of_mesh || (corners_of_mesh < 3 && polygon.count > corners_of_mesh))
      throw std::invalid_argument(
          fmt::format("exact: a polygon of {} vertices, of a primitive of {} corners", polygon.count, corners_of_mesh));
    corners.clear();
    for (std::uint32_t i = 0; i < polygon.count; ++i)
      if (const auto v = to_window(polygons.vertices[polygon.first + i], matrices[draw])) corners.push_back(*v);
    if (corners.size() != polygon.count) continue;
    const Draw& state = scene.draws[draw];
    if (polygon.count < 3) {
      const int width = polygon.count == 2 ? state.line_width : state.point_size;
      triangles.push_back({{corners.front(), corners.back(), corners.back()},
                           polygon.primitive,
                           true,
                           polygon.count,
                           static_cast<std::uint32_t>(width)});
      continue;
    }
    const bool front = faces_front(corners);
    const bool filled = is_filled(state);
    if (!filled && culled(state.cull, front)) continue;  // by the whole polygon's facing, which selects the mode
    if (const PolygonMode mode = front ? state.front_mode : state.back_mode; mode != PolygonMode::fill) {
      append_outline(state, corners, polygon.primitive, front, mode, triangles);
      continue;
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      WindowTriangle<double> triangle{{corners[i - 1], corners[i], corners[0]}, polygon.primitive, false};
      const int sign = facing(snapped_corners(triangle));
      triangle.front = sign > 0;
      if (sign != 0 && !culled(state.cull, triangle.front)) triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace plumbline::exact
