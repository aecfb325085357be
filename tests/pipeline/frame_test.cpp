// The frame: formats, clears, and stages 5 to 11 against brute force.
#include "pipeline/frame.h"

#include <map>
#include <random>

#include <gtest/gtest.h>

#include "kernels/merge.h"
#include "kernels/visibility.h"
#include "tests/notes/ascii_coverage.h"
#include "tests/pipeline/window_frame.h"
#include "tests/pipeline/window_triangles.h"

namespace plumbline::pipeline {
namespace {

using testing_words::color_setup;
using testing_words::picture_of;
using testing_words::same_picture;
using testing_words::window_triangle;
using testing_words::window_vertex;
using Triangle = ShadedTriangle;

FrameFormat format(int width, int height, ColorFormat color = ColorFormat::rgba32f,
                   DepthFormat depth = DepthFormat::z32f) {
  FrameFormat f;
  f.width = width;
  f.height = height;
  f.color = color;
  f.depth = depth;
  return f;
}

std::vector<Triangle> random_triangles(int count, float lo, float hi, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(lo, hi), unit(0, 1), size(-40, 40);
  std::vector<Triangle> triangles;
  while (triangles.size() < static_cast<std::size_t>(count)) {
    const glm::vec2 a(place(random), place(random));
    const auto vertex = [&](glm::vec2 p) {
      return window_vertex({p, unit(random)}, 0.5f + unit(random), {unit(random), unit(random), unit(random), 1});
    };
    const glm::vec2 b = a + glm::vec2{size(random), size(random)}, c = a + glm::vec2{size(random), size(random)};
    const Triangle t = window_triangle(vertex(a), vertex(b), vertex(c), static_cast<std::uint32_t>(triangles.size()));
    if (snapped_area(t) != 0) triangles.push_back(t);
  }
  return triangles;
}

struct BruteSetup {
  Edges edges;
  BarycentricPlanes planes;
  DepthPlane depth;
  PerspectiveSetup perspective;
  AttributeSetup color;
};

/// The frame without bins or bounding boxes: at each pixel every triangle, in draw order.
Frame brute_force(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& first,
                  const std::vector<Draw>& draws, const FrameFormat& f) {
  const Formats formats = formats_of(f);
  // The one rule of tiles (stages.h, kTile): planes are anchored at the lower left pixel of the pixel's tile.
  std::map<std::pair<int, int>, std::vector<BruteSetup>> setups_of_tile;
  for (int y = 0; y < f.height; y += 64) {
    for (int x = 0; x < f.width; x += 64) {
      for (const Triangle& t : triangles) {
        const BarycentricPlanes planes = planes_of(t, x, y);
        setups_of_tile[{x / 64, y / 64}].push_back({edges_of(t), planes, depth_plane(depth_setup(t, {f.depth}), planes),
                                                    perspective_setup(t, planes, true), color_setup(t)});
      }
    }
  }
  Frame frame(f);
  for (int y = 0; y < f.height; ++y) {
    for (int x = 0; x < f.width; ++x) {
      float z = formats.depth_scale == 0 ? static_cast<float>(f.clear_depth)
                                         : static_cast<float>(depth_code(f.clear_depth, formats.depth_scale));
      Color<float> color =
          merge<float>({f.clear_color.r, f.clear_color.g, f.clear_color.b, f.clear_color.a}, formats.color_scale);
      const Pixels<float> p{x, y, x + 0.5, y + 0.5};
      const std::vector<BruteSetup>& setups = setups_of_tile[{x / 64, y / 64}];
      for (std::size_t d = 0; d < draws.size(); ++d) {
        for (std::uint32_t n = first[d]; n < first[d + 1]; ++n) {
          if (!coverage<float>(setups[n].edges, p)) continue;
          const Offset<float> at = from_anchor<float>(setups[n].planes, p);
          const float incoming = depth<float>(setups[n].depth, at);
          if (!compares<float>(draws[d].depth_func, incoming, z)) continue;
          z = incoming;
          color = merge<float>(mean<float>(setups[n].color, weights<float>(setups[n].perspective, at)),
                               formats.color_scale);
        }
      }
      if (f.color == ColorFormat::rgba8) {
        frame.color_rgba8(x, y) = glm::u8vec4(color.r, color.g, color.b, color.a);
      } else {
        frame.color_rgba32f(x, y) = {color.r, color.g, color.b, color.a};
      }
      if (f.depth == DepthFormat::z32f) {
        frame.depth_z32f(x, y) = z;
      } else {
        frame.depth_code(x, y) = static_cast<std::uint32_t>(z);
      }
    }
  }
  return frame;
}

void expect_same(const Frame& is, const Frame& expected) {
  EXPECT_EQ(is.color_rgba8.values(), expected.color_rgba8.values());
  EXPECT_EQ(is.color_rgba16.values(), expected.color_rgba16.values());
  EXPECT_EQ(is.color_rgba32f.values(), expected.color_rgba32f.values());
  EXPECT_EQ(is.depth_code.values(), expected.depth_code.values());
  EXPECT_EQ(is.depth_z32f.values(), expected.depth_z32f.values());
}

Draw draw_with(DepthFunc func) {
  Draw draw;
  draw.depth_func = func;
  return draw;
}

const std::pair<int, int> kSizes[] = {{1, 1}, {3, 2}, {64, 64}, {65, 63}, {70, 130}, {130, 5}, {128, 1}};

TEST(PipelineFrame, FramesHoldThePlanesOfTheirFormats) {
  const Frame small(format(5, 3, ColorFormat::rgba8, DepthFormat::z16)), large(format(5, 3));
  EXPECT_EQ(small.color_rgba8.size(), 15u);
  EXPECT_EQ(small.depth_code.size(), 15u);
  EXPECT_TRUE(small.color_rgba32f.empty() && small.depth_z32f.empty());
  EXPECT_EQ(large.color_rgba32f.width(), 5);
  EXPECT_EQ(large.depth_z32f.height(), 3);
  EXPECT_TRUE(large.color_rgba8.empty() && large.depth_code.empty());
  const Frame gz(format(5, 3, ColorFormat::rgba12, DepthFormat::z8));
  EXPECT_EQ(gz.color_rgba16.size(), 15u);
  EXPECT_EQ(gz.depth_code.size(), 15u);
  EXPECT_TRUE(gz.color_rgba8.empty() && gz.color_rgba32f.empty() && small.color_rgba16.empty());
}

TEST(PipelineFrame, FormatsScaleToTheirLargestCodes) {
  EXPECT_EQ(formats_of(format(1, 1, ColorFormat::rgba8, DepthFormat::z16)).depth_scale, 65535);
  EXPECT_EQ(formats_of(format(1, 1, ColorFormat::rgba8, DepthFormat::z24)).depth_scale, 16777215);
  EXPECT_EQ(formats_of(format(1, 1, ColorFormat::rgba8, DepthFormat::z32f)).depth_scale, 0);
  EXPECT_EQ(formats_of(format(1, 1, ColorFormat::rgba8, DepthFormat::z8)).depth_scale, 255);
  EXPECT_EQ(formats_of(format(1, 1, ColorFormat::rgba8)).color_scale, 255);
  EXPECT_EQ(formats_of(format(1, 1, ColorFormat::rgba12)).color_scale, 4095);
  EXPECT_EQ(formats_of(format(1, 1, ColorFormat::rgba32f)).color_scale, 0);
}

TEST(PipelineFrame, ClearValuesInEachFormat) {
  for (DepthFormat depth : {DepthFormat::z8, DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f}) {
    for (ColorFormat color : {ColorFormat::rgba8, ColorFormat::rgba12, ColorFormat::rgba32f}) {
      FrameFormat f = format(66, 2, color, depth);
      f.clear_color = {0.25f, 0.6f, 1.25f, -0.5f};
      f.clear_depth = 0.3;
      const Frame frame = test::frame_of({}, std::vector<std::uint32_t>{0}, {}, f);
      for (const int x : {0, 65}) {
        if (color == ColorFormat::rgba8) {
          EXPECT_EQ(frame.color_rgba8(x, 1), glm::u8vec4(64, 153, 255, 0)) << "63.75, 153";
        } else if (color == ColorFormat::rgba12) {
          EXPECT_EQ(frame.color_rgba16(x, 1), glm::u16vec4(1024, 2457, 4095, 0)) << "1023.75, 2457";
        } else {
          EXPECT_EQ(frame.color_rgba32f(x, 1), f.clear_color);
        }
        switch (depth) {
          case DepthFormat::z8: EXPECT_EQ(frame.depth_code(x, 1), 77u) << "76.5, half up"; break;
          case DepthFormat::z16: EXPECT_EQ(frame.depth_code(x, 1), 19660u); break;
          case DepthFormat::z24: EXPECT_EQ(frame.depth_code(x, 1), 5033164u); break;
          case DepthFormat::z32f: EXPECT_EQ(frame.depth_z32f(x, 1), 0.3f); break;
        }
      }
    }
  }
}

TEST(PipelineFrame, TheLastDrawnIsOnTopAcrossTiles) {
  // Two rectangles' halves over four tiles, drawn whatever the depth.
  const auto wedge = [](float x, float y, float reach, float red) {
    const glm::vec4 color(red, 0, 0, 1);
    return window_triangle(window_vertex({x, y, 0.5f}, 1, color), window_vertex({x + reach, y, 0.5f}, 1, color),
                           window_vertex({x, y + reach, 0.5f}, 1, color));
  };
  const std::vector<Triangle> triangles = {wedge(10, 10, 100, 1), wedge(50, 50, 30, 2), wedge(61, 61, 7, 3)};
  const Frame frame = test::frame_of(triangles, std::vector<std::uint32_t>{0, 3},
                                     std::vector<Draw>{draw_with(DepthFunc::always)}, format(90, 90));
  const auto expected = [&](int x, int y) {
    const auto in = [&](int corner, int reach) { return x >= corner && y >= corner && x + y + 1 < 2 * corner + reach; };
    return in(61, 7) ? 3.0f : in(50, 30) ? 2.0f : in(10, 100) ? 1.0f : 0.0f;
  };
  for (float red : {1.0f, 2.0f, 3.0f}) {
    EXPECT_TRUE(same_picture(picture_of(90, 90, [&](int x, int y) { return frame.color_rgba32f(x, y).r == red; }),
                             picture_of(90, 90, [&](int x, int y) { return expected(x, y) == red; })));
  }
}

TEST(PipelineFrame, SeveralDrawsEachWithItsDepthFunction) {
  const DepthFunc funcs[] = {DepthFunc::less,          DepthFunc::never,     DepthFunc::greater,
                             DepthFunc::less_equal,    DepthFunc::not_equal, DepthFunc::equal,
                             DepthFunc::greater_equal, DepthFunc::always,    DepthFunc::less};
  std::vector<Draw> draws;
  for (DepthFunc func : funcs) draws.push_back(draw_with(func));
  for (unsigned seed = 0; seed < 4; ++seed) {
    auto triangles = random_triangles(120, -20, 150, seed);
    for (std::size_t i = 40; i < 60; ++i) {  // the same depths again, in other colours
      triangles[i] = triangles[i - 20];
      for (Attributes& a : triangles[i].attributes) a.color() = glm::vec4(1) - a.color();
    }
    const std::vector<std::uint32_t> first = {0, 20, 30, 40, 40, 60, 60, 90, 119, 120};  // two draws are empty
    FrameFormat f = seed % 2 == 0 ? format(131, 70) : format(70, 131, ColorFormat::rgba8, DepthFormat::z16);
    f.clear_depth = 0.75;
    f.clear_color = {0.25f, 0.5f, 0, 1};
    expect_same(test::frame_of(triangles, first, draws, f), brute_force(triangles, first, draws, f));
    // Each function alone, so that none is mistaken for another: over random depths, and over the same again.
    const std::vector<Triangle> some(triangles.begin(), triangles.begin() + 60);
    for (DepthFunc func : funcs) {
      const std::vector<Draw> pair = {draw_with(DepthFunc::always), draw_with(func)};
      expect_same(test::frame_of(some, std::vector<std::uint32_t>{0, 40, 60}, pair, f),
                  brute_force(some, {0, 40, 60}, pair, f));
    }
  }
}

TEST(PipelineFrame, FramesOfEverySize) {
  for (const auto& [width, height] : kSizes) {
    const FrameFormat f = format(width, height, ColorFormat::rgba8, DepthFormat::z24);
    const auto triangles = random_triangles(60, -20, 140, 9);
    const std::vector<Draw> draws = {draw_with(DepthFunc::less)};
    expect_same(test::frame_of(triangles, std::vector<std::uint32_t>{0, 60}, draws, f),
                brute_force(triangles, {0, 60}, draws, f));
  }
}

}  // namespace
}  // namespace plumbline::pipeline
