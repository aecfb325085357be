#include "reference/exact/coverage.h"

#include <algorithm>
#include <cmath>

#include "capture/renderer.h"
#include "reference/arithmetic/passes.h"
#include "reference/exact/input.h"
#include "reference/exact/line_coverage.h"
#include "reference/exact/window.h"

namespace plumbline::exact {
namespace {

/// Pixels of a point, by the square's definition: centres less than half the size from its middle along both axes.
std::vector<glm::ivec2> point_pixels(glm::ivec2 snapped, int size, const FrameFormat& frame) {
  const glm::dvec2 p_win = glm::dvec2(snapped) / static_cast<double>(kSubpixel) + 0.5;
  const glm::dvec2 middle = size % 2 == 1 ? glm::floor(p_win) + 0.5 : glm::floor(p_win + 0.5);
  const auto covers = [&](int pixel, int axis) { return std::abs(pixel + 0.5 - middle[axis]) < 0.5 * size; };
  const glm::ivec2 around(glm::clamp(middle, glm::dvec2(-1000), glm::dvec2(frame.width, frame.height) + 1000.0));
  std::vector<glm::ivec2> pixels;
  for (int y = std::max(around.y - size, 0); y < std::min(around.y + size, frame.height); ++y)
    for (int x = std::max(around.x - size, 0); x < std::min(around.x + size, frame.width); ++x)
      if (covers(x, 0) && covers(y, 1)) pixels.emplace_back(x, y);
  return pixels;
}

/// floor(a / b) and ceil(a / b); b > 0.
Int128 floor_div(Int128 a, Int128 b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }
Int128 ceil_div(Int128 a, Int128 b) { return -floor_div(-a, b); }

int clamped(Int128 value, int low, int high) { return static_cast<int>(std::clamp<Int128>(value, low, high)); }

/// Snapped corners, counted from the sample of pixel (0, 0) [1/256 pixel].
std::array<glm::ivec2, 3> from_sample(std::array<glm::ivec2, 3> snapped, const FrameFormat& frame) {
  const glm::ivec2 sample(static_cast<double>(kSubpixel) * math::sample_offset(frame));  // a whole number
  for (glm::ivec2& corner : snapped) corner -= sample;
  return snapped;
}

/// True if the snapped corners' winding is the recorded facing, which decides the edges' inner sides: else no centre is
/// on the inner side of all three. (A wrong facing is stage 4's error.)
bool faces_as_recorded(const WindowTriangle<double>& triangle) {
  return facing(snapped_corners(triangle)) == (triangle.front ? 1 : -1);
}

}  // namespace

bool tie_is_in(std::int64_t de_dx, std::int64_t de_dy) { return de_dx != 0 ? de_dx > 0 : de_dy > 0; }

CoveredRows::CoveredRows(const std::array<glm::ivec2, 3>& snapped, int width, int height) : edges_{}, x_end_(width) {
  const int sign = facing(snapped);
  if (sign == 0) return;
  const auto [y_min, y_max] = std::minmax({snapped[0].y, snapped[1].y, snapped[2].y});
  y_begin_ = clamped(ceil_div(y_min, kSubpixel), 0, height);
  y_end_ = std::max(y_begin_, clamped(floor_div(y_max, kSubpixel) + 1, 0, height));
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::i64vec2 a = snapped[i], b = snapped[(i + 1) % 3];
    const std::int64_t de_dx = (a.y - b.y) * sign, de_dy = (b.x - a.x) * sign;
    const Int128 e = -(Int128{de_dx} * a.x + Int128{de_dy} * a.y);
    edges_[i] = {de_dx, de_dy, tie_is_in(de_dx, de_dy) ? e : e - 1};
  }
}

CoveredRows::CoveredRows(const std::array<glm::ivec2, 3>& snapped, const FrameFormat& frame, const Draw& draw)
    : CoveredRows(from_sample(snapped, frame), frame.width, frame.height) {
  if (!draw.scissor) return;
  const Scissor& box = *draw.scissor;
  x_begin_ = std::min(box.x, frame.width);
  x_end_ = std::min(box.x + box.width, frame.width);
  y_begin_ = std::max(y_begin_, box.y);
  y_end_ = std::max(y_begin_, std::min(y_end_, box.y + box.height));
}

Span CoveredRows::row(int y) const {
  Span span{x_begin_, x_end_};
  for (const Edge& edge : edges_) {
    const Int128 e = edge.at_origin + Int128{edge.de_dy} * kSubpixel * y;  // at pixel (0, y)
    const Int128 step = Int128{edge.de_dx} * kSubpixel;                    // from pixel to pixel
    if (step > 0)
      span.begin = std::max(span.begin, clamped(ceil_div(-e, step), x_begin_, x_end_));
    else if (step < 0)
      span.end = std::min(span.end, clamped(floor_div(e, -step) + 1, x_begin_, x_end_));
    else if (e < 0)
      return {0, 0};
  }
  return {span.begin, std::max(span.begin, span.end)};
}

std::size_t covered_count(const CoveredRows& rows) {
  std::size_t count = 0;
  for (int y = rows.y_begin(); y < rows.y_end(); ++y) {
    const Span span = rows.row(y);
    count += static_cast<std::size_t>(span.end - span.begin);
  }
  return count;
}

void append_covered(const CoveredRows& rows, std::uint32_t triangle, std::vector<Covered>& out) {
  for (int y = rows.y_begin(); y < rows.y_end(); ++y) {
    const Span span = rows.row(y);
    for (int x = span.begin; x < span.end; ++x)
      out.push_back({triangle, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
  }
}

void append_covered(const WindowTriangle<double>& primitive, const FrameFormat& frame, const Draw& draw,
                    std::uint32_t triangle, std::vector<Covered>& out) {
  if (primitive.corners == 3) {
    if (!faces_as_recorded(primitive)) return;
    return append_covered(CoveredRows(snapped_corners(primitive), frame, draw), triangle, out);
  }
  const int width = static_cast<int>(primitive.width);
  const std::vector<glm::ivec2> pixels =
      primitive.corners == 2
          ? wide_line_pixels(primitive.v[0].snapped, primitive.v[1].snapped, width, frame.width, frame.height)
          : point_pixels(primitive.v[0].snapped, width, frame);
  for (const glm::ivec2 p : pixels)
    if (!draw.scissor || draw.scissor->holds(p.x, p.y))
      out.push_back({triangle, static_cast<std::uint16_t>(p.x), static_cast<std::uint16_t>(p.y)});
}

namespace {

/// Upper bound of a line's or point's pixels. A line has at most `width` pixels in each column (y-major: row) that it
/// passes, and in one more.
std::size_t most_pixels(const WindowTriangle<double>& line_or_point, int longest) {
  const glm::i64vec2 d = glm::abs(glm::i64vec2(line_or_point.v[1].snapped) - glm::i64vec2(line_or_point.v[0].snapped));
  const std::size_t width = line_or_point.width;
  if (line_or_point.corners == 1) return width * width;
  return width * static_cast<std::size_t>(std::min<std::int64_t>(std::max(d.x, d.y) / kSubpixel + 2, longest));
}

}  // namespace

void cover_triangles(const Scene& scene, const std::vector<WindowTriangle<double>>& triangles, std::size_t budget,
                     Capture& out) {
  const int width = scene.frame.width, height = scene.frame.height;
  const DrawOf draw_of(scene);
  const auto rows_of = [&](const WindowTriangle<double>& t) {
    return CoveredRows(snapped_corners(t), scene.frame, draw_of(t.primitive));
  };
  std::size_t fragments = 0;
  for (const WindowTriangle<double>& t : triangles)
    fragments += t.corners == 3 ? covered_count(rows_of(t)) : most_pixels(t, std::max(width, height));
  require_budget(scene, plane_bytes(scene) + fragments * sizeof(Covered), budget);

  out.planes.count = Plane<std::uint32_t>(width, height);
  out.planes.id_sum = Plane<std::uint64_t>(width, height);
  std::vector<Covered>& covered = out.records.covered;
  covered.reserve(fragments);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const std::size_t first = covered.size();
    append_covered(triangles[i], scene.frame, draw_of(triangles[i].primitive), i, covered);
    const std::uint64_t weight = id_weight(triangles[i].primitive);
    for (std::size_t f = first; f < covered.size(); ++f) add_fragment(out.planes, covered[f].x, covered[f].y, weight);
  }
}

}  // namespace plumbline::exact
