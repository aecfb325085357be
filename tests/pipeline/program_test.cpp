// Programmable stages: discards, varyings of all types, perspective, cuts, the state under which a program draws.
#include "pipeline/program.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/pipeline/programs.h"

namespace plumbline::pipeline {
namespace {

using testing_words::bits_apart;
using testing_words::floats;

constexpr float u = 0x1p-24f;

/// Corners in clip space, one float each.
struct OneFloat {
  struct Varyings {
    float value;
  };
  std::vector<glm::vec4> p_clip;
  std::vector<float> values;
  glm::vec4 vertex(std::size_t triangle, int corner, Varyings& out) const {
    const std::size_t i = 3 * triangle + static_cast<std::size_t>(corner);
    out.value = values[i];
    return p_clip[i];
  }
  bool fragment(const Varyings& in, glm::vec4& color) const {
    color = glm::vec4(in.value);
    return false;
  }
};

/// A quad from x = -1 (w = 1, value 0) to x = 1 (w = 4, value 1) over the whole frame.
OneFloat strip() {
  const glm::vec4 a(-1, -1, 0, 1), b(4, -4, 0, 4), c(4, 4, 0, 4), d(-1, 1, 0, 1);
  return {{a, b, c, a, c, d}, {0, 1, 1, 0, 1, 0}};
}

// The trap of note 002's `varying_intensity * bar`, and of 000: bar is of the screen. With w 1 and 4, 2/3 of the way
// across the screen it gives 2/3; the surface's own point there has t / (4 - 3 t) = 1/3. No place is farther off.
TEST(Program, VaryingsArePerspectiveCorrectWhereTheNotesAreAffine) {
  const int width = 96;
  const Frame frame = draw_program(strip(), 2, floats(width, 4));
  double largest = 0, at = 0;
  for (int x = 0; x < width; ++x) {
    const double t = (x + 0.5) / width;
    const double value = frame.color_rgba32f(x, 1).r;
    // 10 u of a mean whose terms are at most 1 (the ledger's exact.attributes).
    EXPECT_NEAR(value, t / (4 - 3 * t), 10 * u) << x;
    if (t - value > largest) {
      largest = t - value;
      at = t;
    }
  }
  EXPECT_NEAR(largest, 1 / 3.0, 1e-4);
  EXPECT_NEAR(at, 2 / 3.0, 1.0 / width);
  const Frame odd = draw_program(strip(), 2, floats(65, 1));
  EXPECT_NEAR(odd.color_rgba32f(32, 0).r, 0.2, 10 * u) << "in the middle, where affine gives 0.5";
}

TEST(Program, FragmentsSeeValuesWithinTheCornersRange) {
  const int side = 128;
  // Corners on pixel corners: nothing snaps, every fragment lies inside. Roundings: two of the weights' sum, the
  // reciprocal, the product, and the mean's two sums.
  const OneFloat triangle{{{-1, -0.75f, 0, 1}, {2, -1.5f, 1, 2}, {0.25f, 1.75f, -1, 2}}, {0.25f, 1, 0.5f}};
  const Frame frame = draw_program(triangle, 1, floats(side, side, glm::vec4(-1)));
  float least = 1, most = 0;
  for (const glm::vec4& c : frame.color_rgba32f.values()) {
    if (c.r == -1) continue;
    least = std::min(least, c.r);
    most = std::max(most, c.r);
  }
  EXPECT_GE(least, 0.25f * (1 - 6 * u));
  EXPECT_LE(most, 1 + 6 * u);
  EXPECT_LT(least, 0.26f);
  EXPECT_GT(most, 0.97f);
}

/// 14 floats of all shapes, the corners' values all different; `shown`: the one that becomes the colour.
struct ManyVaryings {
  struct Varyings {
    glm::vec2 uv;
    float depth;
    glm::vec4 color;
    glm::mat2 frame;
    glm::vec3 normal;
  };
  static constexpr int kFloats = 14;
  int shown = 0;
  static float value(int corner, int i) { return static_cast<float>((corner * 31 + i * 17) % 23) / 8 - 1; }
  static glm::vec4 p_clip(int corner) {
    constexpr glm::vec4 kCorners[] = {{-3, -2, -1, 2}, {4, -1, 2, 3}, {0.5f, 2, -2, 1}};  // cut by left, right and near
    return kCorners[corner];
  }
  glm::vec4 vertex(std::size_t, int c, Varyings& out) const {
    const auto v = [&](int i) { return value(c, i); };
    out.uv = {v(0), v(1)};
    out.depth = v(2);
    out.color = {v(3), v(4), v(5), v(6)};
    out.frame = {v(7), v(8), v(9), v(10)};
    out.normal = {v(11), v(12), v(13)};
    return p_clip(c);
  }
  bool fragment(const Varyings& in, glm::vec4& color) const {
    const float all[] = {in.uv.x,        in.uv.y,     in.depth,       in.color.x,     in.color.y,
                         in.color.z,     in.color.w,  in.frame[0][0], in.frame[0][1], in.frame[1][0],
                         in.frame[1][1], in.normal.x, in.normal.y,    in.normal.z};
    color = glm::vec4(all[shown]);
    return false;
  }
};

/// One float that is shown, and a second group of four: the weights of more than four floats stay in double.
struct OneOfFive : OneFloat {
  struct Varyings {
    float value;
    glm::vec4 others;
  };
  glm::vec4 vertex(std::size_t triangle, int corner, Varyings& out) const {
    OneFloat::Varyings one;
    const glm::vec4 p = OneFloat::vertex(triangle, corner, one);
    out = {one.value, glm::vec4(0)};
    return p;
  }
  bool fragment(const Varyings& in, glm::vec4& color) const { return OneFloat::fragment({in.value}, color); }
};

TEST(Program, EachOfManyVaryingsIsAsIfItWereAlone) {
  const FrameFormat format = floats(50, 40);
  for (int i = 0; i < ManyVaryings::kFloats; ++i) {
    OneOfFive alone;
    for (int c = 0; c < 3; ++c) {
      alone.p_clip.push_back(ManyVaryings::p_clip(c));
      alone.values.push_back(ManyVaryings::value(c, i));
    }
    const Frame one = draw_program(alone, 1, format);
    EXPECT_EQ(bits_apart(draw_program(ManyVaryings{i}, 1, format), one), 0u) << i;
    EXPECT_GT(bits_apart(one, Frame(format)), 1000u) << i;
  }
}

/// Hands its own clip position on: x / w and y / w are then the pixel's.
struct Position {
  struct Varyings {
    glm::vec4 p_clip;
  };
  std::array<glm::vec4, 3> corners;
  glm::vec4 vertex(std::size_t, int corner, Varyings& out) const {
    return out.p_clip = corners[static_cast<std::size_t>(corner)];
  }
  bool fragment(const Varyings& in, glm::vec4& color) const {
    color = in.p_clip;
    return false;
  }
};

// Error: 10 u of a mean of terms of up to 2.4 times the largest corner (check/bounds/mean_bounds.h, bounds_of_mean), of
// x and of w, over w; and of the corners' window positions 4 u of the frame's 2 NDC.
TEST(Program, CutTrianglesVaryingsAreThoseOfTheirPixels) {
  const Position program{{glm::vec4(-3, -2, -6, -4), {9, -5, 7, 8}, {-2, 6, 3, 4}}};  // the first lies behind the eye
  const FrameFormat format = floats(120, 90, glm::vec4(0));
  const Frame frame = draw_program(program, 1, format);
  int covered = 0;
  for (int y = 0; y < format.height; ++y) {
    for (int x = 0; x < format.width; ++x) {
      const glm::vec4 p = frame.color_rgba32f(x, y);
      if (p.w == 0) continue;
      ++covered;
      const double bound = 10 * u * 2.4 * 9 * 2 / static_cast<double>(p.w) + 8 * u;
      ASSERT_NEAR(p.x / p.w, 2 * (x + 0.5) / format.width - 1, bound) << x << " " << y;
      ASSERT_NEAR(p.y / p.w, 2 * (y + 0.5) / format.height - 1, bound) << x << " " << y;
      ASSERT_GE(p.z, -p.w * (1 + 100 * u)) << "in front of the near plane, where it was cut";
    }
  }
  EXPECT_GT(covered, 1000);
}

/// A near triangle with holes in a checkerboard of its own coordinates, then a far one without.
struct Checkerboard {
  struct Varyings {
    glm::vec2 square;
    float solid;
  };
  bool holes;
  glm::vec4 vertex(std::size_t triangle, int corner, Varyings& out) const {
    constexpr glm::vec2 kCorners[] = {{-1, -1}, {3, -1}, {-1, 3}};  // over the whole frame
    out.square = (kCorners[corner] + 1.0f) * 4.0f;
    out.solid = triangle == 0 ? 0 : 1;
    return {kCorners[corner], triangle == 0 ? -0.5f : 0.5f, 1};
  }
  bool fragment(const Varyings& in, glm::vec4& color) const {
    if (in.solid == 1) {
      color = {0, 0, 1, 1};
      return false;
    }
    color = {1, 0, 0, 1};
    return holes && (static_cast<int>(in.square.x) + static_cast<int>(in.square.y)) % 2 != 0;
  }
};

TEST(Program, DiscardedFragmentsLeaveColourAndDepth) {
  const FrameFormat format{64, 64, ColorFormat::rgba8, DepthFormat::z24, {0, 1, 0, 1}, 1};
  const auto depth_of = [](double z) { return static_cast<std::uint32_t>(std::nearbyint(z * 16777215)); };
  const Frame one = draw_program(Checkerboard{true}, 1, format), two = draw_program(Checkerboard{true}, 2, format);
  const Frame whole = draw_program(Checkerboard{false}, 2, format);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool hole = (x / 8 + y / 8) % 2 != 0;
      ASSERT_EQ(one.color_rgba8(x, y), hole ? glm::u8vec4(0, 255, 0, 255) : glm::u8vec4(255, 0, 0, 255));
      ASSERT_EQ(one.depth_code(x, y), hole ? depth_of(1) : depth_of(0.25));
      ASSERT_EQ(two.color_rgba8(x, y), hole ? glm::u8vec4(0, 0, 255, 255) : glm::u8vec4(255, 0, 0, 255));
      ASSERT_EQ(two.depth_code(x, y), hole ? depth_of(0.75) : depth_of(0.25));
      ASSERT_EQ(whole.color_rgba8(x, y), glm::u8vec4(255, 0, 0, 255));
    }
  }
}

TEST(Program, FlatShadingTakesTheLastCorner) {
  OneFloat program = strip();
  program.values = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
  const Frame frame = draw_program(program, 2, floats(32, 32), {Shading::flat, Cull::none, DepthFunc::less});
  int first = 0, second = 0;
  for (const glm::vec4& c : frame.color_rgba32f.values()) {
    first += c.r == 0.3f;
    second += c.r == 0.6f;
  }
  EXPECT_EQ(first + second, 32 * 32);
  EXPECT_GT(first, 300);
  EXPECT_GT(second, 300);
}

TEST(Program, ObeysCullingAndTheDepthFunction) {
  const OneFloat program = strip();  // counter-clockwise
  const FrameFormat format = floats(8, 8, glm::vec4(-1));
  const auto drawn = [&](Cull cull, DepthFunc func) {
    return draw_program(program, 2, format, {Shading::gouraud, cull, func}).color_rgba32f(4, 4).r != -1;
  };
  EXPECT_TRUE(drawn(Cull::none, DepthFunc::less));
  EXPECT_TRUE(drawn(Cull::back, DepthFunc::less));
  EXPECT_FALSE(drawn(Cull::front, DepthFunc::less));
  EXPECT_FALSE(drawn(Cull::none, DepthFunc::greater));
  EXPECT_TRUE(drawn(Cull::none, DepthFunc::always));
  EXPECT_FALSE(drawn(Cull::none, DepthFunc::never));
}

/// Nothing but uniforms; its fragments count themselves.
struct Plain {
  struct Varyings {};
  glm::vec4 last_corner;
  int* fragments;
  glm::vec4 vertex(std::size_t, int corner, Varyings&) const {
    return corner == 0 ? glm::vec4(-1, -1, 0, 1) : corner == 1 ? glm::vec4(3, -1, 0, 1) : last_corner;
  }
  bool fragment(const Varyings&, glm::vec4& color) const {
    ++*fragments;
    color.g = 0.5f;
    return false;
  }
};

TEST(Program, NeedsNoVaryings) {
  int fragments = 0;
  const Frame frame = draw_program(Plain{{-1, 3, 0, 1}, &fragments}, 1, floats(70, 5));
  EXPECT_EQ(frame.color_rgba32f(69, 4), glm::vec4(0, 0.5f, 0, 1)) << "opaque black where it says nothing else";
  EXPECT_EQ(fragments, 350) << "once for each, and not for those that pad the blocks";
}

TEST(Program, HiddenFragmentsAreNotRun) {
  int fragments = 0;
  draw_program(Plain{{-1, 3, 0, 1}, &fragments}, 3, floats(8, 8));  // twice more at the same depth
  EXPECT_EQ(fragments, 64);
}

TEST(Program, WhatHasNoPlaceIsNotDrawn) {
  int fragments = 0;
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  for (const glm::vec4 corner : {glm::vec4(nan, 0, 0, 1), glm::vec4(0, infinite, 0, 1), glm::vec4(0, 0, 0, nan)}) {
    const Frame frame = draw_program(Plain{corner, &fragments}, 1, floats(8, 8));
    EXPECT_EQ(bits_apart(frame, draw_program(Plain{corner, &fragments}, 0, floats(8, 8))), 0u) << "cleared";
  }
  EXPECT_EQ(fragments, 0);
}

TEST(Program, RefusesWhatNoFrameAndNoSceneMayBe) {
  int fragments = 0;
  const Plain program{{-1, 3, 0, 1}, &fragments};
  const auto refused = [&](std::size_t triangles, const FrameFormat& format, const std::string& text) {
    try {
      draw_program(program, triangles, format);
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& e) {
      EXPECT_EQ(e.what(), text);
    }
  };
  refused((1u << 24) + 1, floats(8, 8), "a program of 16777217 triangles: expected at most 16777216");
  refused(1, floats(0, 8), "a program's frame of 0 x 8 pixels: expected 1 to 16384 a side");
  refused(1, floats(8, 16385), "a program's frame of 8 x 16385 pixels: expected 1 to 16384 a side");
  refused(1, floats(-3, 8), "a program's frame of -3 x 8 pixels: expected 1 to 16384 a side");
  FrameFormat smoothed = floats(8, 8);
  smoothed.antialias = {Antialias::Kind::multisample, 1};
  refused(1, smoothed, "a program's frame: expected one sample a pixel");
  EXPECT_EQ(fragments, 0);
}

struct Doubles : Plain {
  struct Varyings {
    double value;
  };
};
struct NoFragment {
  using Varyings = Plain::Varyings;
  glm::vec4 vertex(std::size_t, int, Varyings&) const { return glm::vec4(0); }
};
static_assert(Program<Plain> && Program<ManyVaryings>);
static_assert(!Program<Doubles> && !Program<NoFragment>);

}  // namespace
}  // namespace plumbline::pipeline
