// Wide lines, large points, and triangles that are not filled: stages 4 and 5, by hand and by definition.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "kernels/coverage.h"
#include "kernels/line_diamond.h"
#include "pipeline/geometry.h"

namespace plumbline::pipeline {
namespace {

using Pixel = std::pair<int, int>;
using PixelSet = std::set<Pixel>;

WindowTriangle line_or_point(glm::ivec2 a, glm::ivec2 b, std::uint32_t corners, std::uint32_t width) {
  WindowTriangle t;
  t.v[0].snapped = a;
  t.v[1].snapped = t.v[2].snapped = b;
  t.corners = corners;
  t.width = width;
  return t;
}

/// Those in [0, 128) x [0, 128), tile by tile; none twice.
PixelSet covered(const WindowTriangle& t) {
  PixelSet out;
  for (const glm::ivec2 origin : {glm::ivec2(0, 0), glm::ivec2(64, 0), glm::ivec2(0, 64), glm::ivec2(64, 64)}) {
    for (const glm::ivec2 p : covered_pixels(t, {origin.x, origin.y, origin.x + 64, origin.y + 64}))
      EXPECT_TRUE(out.emplace(p.x, p.y).second) << p.x << " " << p.y;
  }
  const PixelBounds b = pixel_bounds(t);
  for (const auto& [x, y] : out) EXPECT_TRUE(x >= b.x0 && x < b.x1 && y >= b.y0 && y < b.y1) << x << ", " << y;
  return out;
}

/// OpenGL 2.1, section 3.3: centres in a square about the nearest centre (odd) or corner (even) of pixels.
PixelSet square(glm::ivec2 snapped, int size) {
  const glm::dvec2 p_win = glm::dvec2(snapped) / 256.0 + 0.5;
  const glm::dvec2 middle = size % 2 == 1 ? glm::floor(p_win) + 0.5 : glm::floor(p_win + 0.5);
  PixelSet out;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      if (std::abs(x + 0.5 - middle.x) < size / 2.0 && std::abs(y + 0.5 - middle.y) < size / 2.0) out.emplace(x, y);
  return out;
}

TEST(PipelineWide, PointsAreSquares) {
  for (const int size : {1, 2, 3, 4, 5, 8, 63, 64}) {
    for (const int x : {0, 1, 127, 128, 129, 255, 256, 257, 64 * 256 - 128, 100 * 256 + 77}) {
      for (const int y : {-128, -1, 383, 384, 385, 127 * 256, 128 * 256 - 129}) {
        EXPECT_EQ(covered(line_or_point({x, y}, {x, y}, 1, static_cast<std::uint32_t>(size))), square({x, y}, size))
            << size << " at " << x << ", " << y;
      }
    }
  }
}

TEST(PipelineWide, PointsOfBothParitiesByHand) {
  // At the centre of pixel (5, 7); a hair to the left of the border between columns 5 and 6.
  EXPECT_EQ(covered(line_or_point({5 * 256, 7 * 256}, {}, 1, 3)).size(), 9u);
  EXPECT_EQ(*covered(line_or_point({5 * 256, 7 * 256}, {}, 1, 3)).begin(), Pixel(4, 6));
  EXPECT_EQ(*covered(line_or_point({5 * 256, 7 * 256}, {}, 1, 2)).begin(), Pixel(5, 7)) << "floor(5.5 + 1/2) - 1";
  EXPECT_EQ(*covered(line_or_point({5 * 256 - 1, 7 * 256}, {}, 1, 2)).begin(), Pixel(4, 7));
  EXPECT_EQ(*covered(line_or_point({5 * 256 + 127, 7 * 256}, {}, 1, 3)).begin(), Pixel(4, 6));
  EXPECT_EQ(*covered(line_or_point({5 * 256 + 128, 7 * 256}, {}, 1, 3)).begin(), Pixel(5, 6));
}

TEST(PipelineWide, ALevelLineOfThreeIsThreeLines) {
  const PixelSet is = covered(line_or_point({10 * 256, 20 * 256}, {15 * 256, 20 * 256}, 2, 3));
  PixelSet expected;
  for (int x = 10; x < 15; ++x)
    for (const int y : {19, 20, 21}) expected.emplace(x, y);
  EXPECT_EQ(is, expected);
  // Two wide, half a pixel down: ends on the border of rows 19 and 20 count for the lower, and of columns for the left.
  const PixelSet two = covered(line_or_point({10 * 256, 20 * 256}, {15 * 256, 20 * 256}, 2, 2));
  EXPECT_EQ(two.size(), 10u);
  for (const auto& [x, y] : two) EXPECT_TRUE(y == 19 || y == 20) << y;
}

TEST(PipelineWide, LinesAreTheMovedLineReplicated) {
  std::mt19937 engine(7);
  std::uniform_int_distribution<int> place(-20 * 256, 148 * 256), widths(1, 16), kind(0, 2);
  const glm::ivec2 far(400);
  for (int i = 0; i < 3000; ++i) {
    const int unit = std::array{1, 128, 256}[static_cast<std::size_t>(kind(engine))], width = widths(engine);
    const auto at = [&] { return place(engine) / unit * unit; };
    const glm::ivec2 a(at(), at()), b(at(), at());
    const bool x_major = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
    const glm::i64vec2 minor = x_major ? glm::i64vec2(0, 1) : glm::i64vec2(1, 0);
    PixelSet expected;
    const glm::i64vec2 aside(200 * 256);  // the library's frame begins at 0
    const glm::i64vec2 moved = aside - minor * std::int64_t{128 * (width - 1)};
    for (const glm::ivec2 p : raster::diamond_exit_line(glm::i64vec2(a) + moved, glm::i64vec2(b) + moved, far)) {
      for (int k = 0; k < width; ++k) {
        const glm::ivec2 q = p - 200 + glm::ivec2(minor) * k;
        if (q.x >= 0 && q.y >= 0 && q.x < 128 && q.y < 128) expected.emplace(q.x, q.y);
      }
    }
    ASSERT_EQ(covered(line_or_point(a, b, 2, static_cast<std::uint32_t>(width))), expected) << width;
  }
}

/// Five corners about the middle of a 16 x 16 viewport, the first the rightmost, counter-clockwise; each red by number.
std::vector<ShadedTriangle> polygon(Draw draw, bool clockwise = false) {
  Matrices<float> m{};
  m.win_scale = m.win_translate = {8, 8, 0.5f};
  Polygon polygon{9, {}};
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 5 * (clockwise ? -1 : 1);
    ClipVertex v{{0.5 * std::cos(angle), 0.5 * std::sin(angle), 0, 1}, {}, i % 2 == 1};
    v.attributes.color().r = static_cast<float>(i);
    polygon.corners.push_back(v);
  }
  draw.line_width = 3;
  draw.point_size = 5;
  std::vector<ShadedTriangle> out;
  to_window({&draw, Topology::triangles, false, false, m}, polygon, out);
  return out;
}

Draw with_modes(PolygonMode front, PolygonMode back, Cull cull = Cull::none) {
  Draw draw;
  draw.front_mode = front;
  draw.back_mode = back;
  draw.cull = cull;
  return draw;
}

TEST(PipelineOutline, EdgesAreThePolygonsAndNotTheFans) {
  for (const bool clockwise : {false, true}) {
    const auto edges = polygon(with_modes(PolygonMode::line, PolygonMode::line), clockwise);
    ASSERT_EQ(edges.size(), 5u) << "clipping's own edges are boundary edges, the fan's diagonals are none";
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(edges[i].corners, 2u);
      EXPECT_EQ(edges[i].width, 3u);
      EXPECT_EQ(edges[i].primitive, 9u);
      EXPECT_EQ(edges[i].front, !clockwise);
      EXPECT_EQ(edges[i].attributes[0].color().r, static_cast<float>((i + 4) % 5));
      EXPECT_EQ(edges[i].attributes[1].color().r, static_cast<float>(i));
      EXPECT_EQ(edges[i].attributes[2].color().r, static_cast<float>(i));
    }
  }
}

TEST(PipelineOutline, CornersArePoints) {
  const auto points = polygon(with_modes(PolygonMode::point, PolygonMode::fill));
  ASSERT_EQ(points.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(points[i].corners, 1u);
    EXPECT_EQ(points[i].width, 5u);
    for (const Attributes& a : points[i].attributes) EXPECT_EQ(a.color().r, static_cast<float>(i));
  }
}

TEST(PipelineOutline, FacingChoosesTheMode) {
  const Draw draw = with_modes(PolygonMode::line, PolygonMode::fill);
  EXPECT_EQ(polygon(draw, false).front().corners, 2u);
  EXPECT_EQ(polygon(draw, true).front().corners, 3u);
  EXPECT_EQ(polygon(draw, true).size(), 3u);
  EXPECT_EQ(polygon(with_modes(PolygonMode::fill, PolygonMode::point), true).front().corners, 1u);
}

TEST(PipelineOutline, CullingComesFirst) {
  for (const PolygonMode mode : {PolygonMode::line, PolygonMode::point}) {
    EXPECT_TRUE(polygon(with_modes(mode, mode, Cull::front), false).empty());
    EXPECT_TRUE(polygon(with_modes(mode, mode, Cull::back), true).empty());
    EXPECT_EQ(polygon(with_modes(mode, mode, Cull::back), false).size(), 5u);
    EXPECT_EQ(polygon(with_modes(mode, mode, Cull::front), true).size(), 5u);
  }
}

TEST(PipelineOutline, NoAreaIsTheBack) {
  Matrices<float> m{};
  m.win_scale = m.win_translate = {8, 8, 0.5f};
  Polygon polygon{0, {}};
  for (const float x : {-0.5f, 0.0f, 0.5f}) polygon.corners.push_back({{x, 0, 0, 1}, {}, false});
  const auto run = [&](const Draw& draw) {
    std::vector<ShadedTriangle> out;
    to_window({&draw, Topology::triangles, false, false, m}, polygon, out);
    return out.size();
  };
  EXPECT_EQ(run(with_modes(PolygonMode::fill, PolygonMode::line)), 3u) << "edge on, its edges are seen";
  EXPECT_EQ(run(with_modes(PolygonMode::line, PolygonMode::fill)), 0u);
  EXPECT_EQ(run(with_modes(PolygonMode::line, PolygonMode::line, Cull::back)), 0u);
}

}  // namespace
}  // namespace plumbline::pipeline
