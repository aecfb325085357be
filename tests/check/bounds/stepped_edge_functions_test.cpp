// Edge functions that float adds up from the lower left corner of a triangle's box, from row to row and from pixel to
// pixel, and that are divided by twice the area at each pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "capture/float_depth.h"
#include "tests/check/bounds/sampled_triangles.h"

namespace plumbline {
namespace {

constexpr double kU = 0x1p-24;

Conventions by(Conventions::DepthArithmetic arithmetic) {
  Conventions out;
  out.depth_arithmetic = arithmetic;
  return out;
}

struct EdgeFunction {
  float of_column, of_row, at_first;  // changes of the edge function from pixel to pixel; its value at the box's corner
};

struct SteppedTriangle {
  explicit SteppedTriangle(const WindowCorners& corners) {
    std::array<glm::vec2, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = glm::vec2(corners[i]), z[i] = static_cast<float>(corners[i].z);
    const auto [low_x, high_x] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [low_y, high_y] = std::minmax({v[0].y, v[1].y, v[2].y});
    first = glm::max(glm::floor(glm::vec2(low_x, low_y)), 0.0f) + 0.5f;
    const auto function = [](glm::vec2 a, glm::vec2 b, glm::vec2 p) {
      return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    area = function(v[0], v[1], v[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec2 a = v[(i + 1) % 3], b = v[(i + 2) % 3];
      edges[i] = {a.y - b.y, b.x - a.x, function(a, b, first)};
    }
  }
  std::array<float, 3> at(int x, int y) const {
    std::array<float, 3> out{};
    for (std::size_t i = 0; i < 3; ++i) {
      out[i] = edges[i].at_first;
      for (float row = first.y; row < static_cast<float>(y) + 0.5f; ++row) out[i] += edges[i].of_row;
      for (float column = first.x; column < static_cast<float>(x) + 0.5f; ++column) out[i] += edges[i].of_column;
    }
    return out;
  }
  // Sums of three shares, of two shares of differences, and of two shares and what is left of 1.
  std::array<float, 3> depths(int x, int y) const {
    const std::array<float, 3> e = at(x, y);
    const float b0 = e[0] / area, b1 = e[1] / area;
    return {(e[0] * z[0] + e[1] * z[1] + e[2] * z[2]) / area, z[2] + b0 * (z[0] - z[2]) + b1 * (z[1] - z[2]),
            b0 * z[0] + b1 * z[1] + (1 - b0 - b1) * z[2]};
  }

  std::array<EdgeFunction, 3> edges;
  std::array<float, 3> z;
  glm::vec2 first{0};
  float area = 0;
};

// Largest ratios over random triangles that are at least two pixels thin: of a depth's error to the bounds of the
// arithmetics, and of an edge's displacement to its bound.
struct EdgeRatios {
  double of_bound = 0, of_product = 0, of_displacement = 0;
};
EdgeRatios largest_edge_ratios(double reach) {
  using enum Conventions::DepthArithmetic;
  EdgeRatios out;
  const auto keeps = [](WindowCorners& c, int n) {
    if (n % 2 == 0) {  // a sliver: the third corner lies beside the middle of the other two, or beside one of them
      const glm::vec3 middle(n % 4 == 0 ? 0.5 * (c[0] + c[1]) : c[1]);
      c[2] = glm::dvec3(middle + glm::vec3(1.5f, -1.5f, 0.1f));
    }
    if (n % 3 == 0) c[0].z = 1, c[1].z = c[2].z = 0;
    const double longest = std::max(glm::length(glm::dvec2(c[1] - c[0])), glm::length(glm::dvec2(c[2] - c[0])));
    return test::twice_area(c) >= std::max(4.0, longest);
  };
  test::each_sample(7, reach, keeps, [&](const test::TriangleSample& at) {
    const SteppedTriangle stepped(at.corners);
    double off = 0;
    for (const float z : stepped.depths(at.x, at.y)) off = std::max(off, std::abs(static_cast<double>(z) - at.z));
    out.of_bound = std::max(out.of_bound, off / depth_error(in_float_stepped_edges, at.corners, at.p, at.frame));
    out.of_product = std::max(out.of_product, off / depth_error(in_float, at.corners, at.p, at.frame));
    // The edge opposite corner 2: its function is b2 times the area.
    WindowBox box{glm::dvec2(at.corners[0])};
    for (const glm::dvec3& corner : at.corners) box.add(glm::dvec2(corner));
    const double length = glm::length(glm::dvec2(at.corners[1] - at.corners[0])), function = at.b2 * at.area,
                 moved = std::abs(static_cast<double>(stepped.at(at.x, at.y)[2]) - function) / length,
                 bound = edge_displacement(by(in_float_stepped_edges), box, at.frame).x;
    if (std::abs(function) <= length * glm::length(at.frame))  // the edge's line passes through the frame
      out.of_displacement = std::max(out.of_displacement, moved / bound);
  });
  std::printf("%.3f of the bound, %.3f of that of in_float; edges: %.3f\n", out.of_bound, out.of_product,
              out.of_displacement);
  return out;
}

TEST(SteppedEdgeFunctions, AreWithinTheirBoundAndBeyondThatOfDirectOnes) {
  const EdgeRatios of = largest_edge_ratios(1);
  EXPECT_LE(of.of_bound, 1);
  EXPECT_GE(of.of_bound, 0.02) << "loose";
  EXPECT_GT(of.of_product, 10);
  EXPECT_LE(of.of_displacement, 1);
  EXPECT_GE(of.of_displacement, 0.05) << "loose";
}

TEST(SteppedEdgeFunctions, AreWithinTheirBoundWhereCornersLieBeyondTheFrame) {
  for (const double reach : {4, 40}) {
    const EdgeRatios of = largest_edge_ratios(reach);
    EXPECT_LE(of.of_bound, 1);
    EXPECT_GT(of.of_product, 1);
    EXPECT_LE(of.of_displacement, 1);
  }
}

TEST(SteppedEdgeFunctions, StepInTheFrameAlone) {
  using enum Conventions::DepthArithmetic;
  const WindowCorners corners = {{{0, -4000, 0}, {100, -4000, 0}, {50, 100, 1}}};
  const glm::dvec2 p(50.5, 50.5), frame(100, 100);
  EXPECT_LT(10 * error_by_stepped_edges(corners, p, frame), error_by_stepped_edges(corners, p, kNoSides));
  WindowBox box(glm::dvec2(0));
  box.add({100, 100});
  EXPECT_EQ(edge_displacement(by(in_float), box, frame), glm::dvec2(0));
  const glm::dvec2 moved = edge_displacement(by(in_float_stepped_edges), box, frame);
  EXPECT_EQ(moved.x, moved.y);
  EXPECT_GE(moved.x, kU * 200 * std::hypot(100.0, 100.0));
  EXPECT_EQ(depth_error_of_pieces(in_float_stepped_edges, 0, 1, {4000, 4000}, frame),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace plumbline
