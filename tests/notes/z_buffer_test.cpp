// What notes 002 and 000 get wrong of depth and of light: the wrong number, the right one (the pipeline's), and what
// lies between.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "pipeline/geometry.h"
#include "pipeline/program.h"

namespace plumbline::pipeline {
namespace {

// Note 002, "Z-Buffer": z and w of three corners (before the division), c their barycentric coordinates on the screen.
double z_over_w(glm::dvec3 z, glm::dvec3 w, glm::dvec3 c) { return glm::dot(z, c) / glm::dot(w, c); }

/// Quads over the whole height of the frame, each from (x, z, w) to (x, z, w) in clip space, without the product by w.
struct Quads {
  struct Side {
    float x, z, w;
  };
  struct Quad {
    Side from, to;
    float color;
  };
  struct Varyings {
    float color;
  };
  std::vector<Quad> quads;

  std::size_t triangles() const { return 2 * quads.size(); }
  glm::vec4 vertex(std::size_t triangle, int corner, Varyings& out) const {
    constexpr int kSides[2][3] = {{0, 1, 1}, {0, 1, 0}}, kUps[2][3] = {{-1, -1, 1}, {-1, 1, 1}};
    const Quad& quad = quads[triangle / 2];
    const Side& side = kSides[triangle % 2][corner] == 0 ? quad.from : quad.to;
    out.color = quad.color;
    return {side.x * side.w, static_cast<float>(kUps[triangle % 2][corner]) * side.w, side.z * side.w, side.w};
  }
  bool fragment(const Varyings& in, glm::vec4& color) const {
    color = glm::vec4(in.color);
    return false;
  }
};
float ndc(double z_win) { return static_cast<float>(2 * z_win - 1); }

// Corners with w 1 and 4 and depths 0 and .9. z/w is affine in the window, which is why a z-buffer may hold it; the
// note divides two sums that are affine in clip space by the weights of the screen.
TEST(NotesZBuffer, SumZOverSumWIsNotTheDepthInTheWindow) {
  const glm::dvec3 z(0, 3.6, 0), w(1, 4, 1);
  EXPECT_DOUBLE_EQ(z_over_w(z, w, {0.5, 0.5, 0}), 0.72) << "in the middle of the edge";
  const Quads quad{{{{-1, ndc(0), 1}, {1, ndc(0.9), 4}, 1}}};
  const int width = 301;
  const Frame right = draw_program(quad, quad.triangles(), {width, 1, ColorFormat::rgba8, DepthFormat::z32f, {}, 1});
  EXPECT_NEAR(right.depth_z32f(width / 2, 0), 0.45, 1e-7);
  EXPECT_DOUBLE_EQ(z_over_w(z, w, {0.8, 0.2, 0}), 0.45) << "by the weights in clip space its formula is right";

  // 3.6 t / (1 + 3 t) - .9 t is largest at t = 1/3: .6 for .3.
  double largest = 0, at = 0;
  for (int x = 0; x < width; ++x) {
    const double t = (x + 0.5) / width;
    EXPECT_NEAR(right.depth_z32f(x, 0), 0.9 * t, 1e-7) << x;
    const double apart = z_over_w(z, w, {1 - t, t, 0}) - static_cast<double>(right.depth_z32f(x, 0));
    if (apart > largest) {
      largest = apart;
      at = t;
    }
  }
  EXPECT_NEAR(largest, 0.3, 1e-5);
  EXPECT_NEAR(at, 1 / 3.0, 1.0 / width);
  for (double t : {0.0, 0.25, 0.5, 1.0}) EXPECT_DOUBLE_EQ(z_over_w({0, 1.8, 0}, {2, 2, 2}, {1 - t, t, 0}), 0.9 * t);
}

// The same edge before and behind a wall at depth .5: it should be in front up to t = .5 / .9 = .556, the note's comes
// out behind from .5 / (3.6 - 1.5) = .238 on.
TEST(NotesZBuffer, SumZOverSumWShowsTheWrongSurface) {
  const int width = 300;
  const Quads quads{{{{-1, ndc(0), 1}, {1, ndc(0.9), 4}, 1}, {{-1, ndc(0.5), 1}, {1, ndc(0.5), 1}, 2}}};
  const Frame right =
      draw_program(quads, quads.triangles(), {width, 1, ColorFormat::rgba32f, DepthFormat::z32f, {}, 1});
  int right_shown = 0, notes_shown = 0, wrong = 0;
  for (int x = 0; x < width; ++x) {
    const double t = (x + 0.5) / width;
    const bool edge = right.color_rgba32f(x, 0).r == 1;
    const bool notes_edge = z_over_w({0, 3.6, 0}, {1, 4, 1}, {1 - t, t, 0}) < 0.5;
    right_shown += edge;
    notes_shown += notes_edge;
    wrong += edge != notes_edge;
  }
  EXPECT_EQ(right_shown, 167);
  EXPECT_EQ(notes_shown, 71);
  EXPECT_EQ(wrong, 96) << "of 300 columns";
}

/// Note 002: the depth that the 8-bit buffer holds, greater is nearer.
int frag_depth(double z, double w) { return std::max(0, std::min(255, static_cast<int>(z / w + .5))); }

// A wall and another behind it by a part of a code, both sloping over 240 codes, the far one drawn last. Four columns
// to a code: where both round to one code, the far one shows; so it does in 1 - distance of all places.
TEST(NotesZBuffer, EightBitsLoseFights) {
  const int width = 960;
  const auto lost = [&](double distance, DepthFormat depth) {
    const double from = 8 / 255.0, to = 248 / 255.0, behind = distance / 255;
    const Quads walls{
        {{{-1, ndc(from), 1}, {1, ndc(to), 1}, 1}, {{-1, ndc(from - behind), 1}, {1, ndc(to - behind), 1}, 2}}};
    const Frame frame = draw_program(walls, walls.triangles(), {width, 1, ColorFormat::rgba32f, depth, {}, 0},
                                     {Shading::flat, Cull::none, DepthFunc::greater_equal});
    int shown = 0, by_the_note = 0;
    for (int x = 0; x < width; ++x) {
      const double z = 255 * (from + (to - from) * (x + 0.5) / width);
      shown += frame.color_rgba32f(x, 0).r == 2;
      by_the_note += frag_depth(z - distance, 1) >= frag_depth(z, 1);
    }
    if (depth == DepthFormat::z8) {
      EXPECT_EQ(shown, by_the_note) << "z8 is the note's buffer";
    }
    return shown;
  };
  const DepthFormat z8 = DepthFormat::z8;
  EXPECT_EQ(lost(0.25, z8), 720);
  EXPECT_EQ(lost(0.5, z8), 480);
  EXPECT_EQ(lost(0.75, z8), 240);
  EXPECT_EQ(lost(1, z8), 0);
  for (double distance : {0.25, 0.5, 0.75, 1.0}) {
    EXPECT_EQ(lost(distance, DepthFormat::z16), 0);
    EXPECT_EQ(lost(distance, DepthFormat::z24), 0);
  }
}

// w = 1 - z/c is unbounded above and below; what leaves [0, 255] is clamped, not cut away: all of it has one depth.
TEST(NotesZBuffer, TheClampLosesEveryFightBeyondItsRange) {
  int beyond = 0, before = 0;
  for (int i = 0; i < 1000; ++i) {
    const double z = 255 + i * 0.1, behind = z - 0.05 * (z - 254.5);
    beyond += frag_depth(behind, 1) >= frag_depth(z, 1);
    before += frag_depth(-z - 10, 1) >= frag_depth(-z, 1);
  }
  EXPECT_EQ(beyond, 1000) << "as far apart as 5 codes";
  EXPECT_EQ(before, 1000) << "and 10";
  // Clipped, neither is drawn at all.
  const Quads walls{{{{-1, 1.25f, 1}, {1, 1.25f, 1}, 1}, {{-1, -1.25f, 1}, {1, -1.25f, 1}, 2}}};
  const Frame frame = draw_program(walls, walls.triangles(), {64, 1, ColorFormat::rgba32f, DepthFormat::z8, {}, 1});
  for (const glm::vec4& c : frame.color_rgba32f.values()) EXPECT_EQ(c.r, 0);
}

// Note 002's one-dimensional depth: int y = p0.y*(1.-t) + p1.y*t.
int segment_depth(int y0, int y1, double t) { return static_cast<int>(y0 * (1. - t) + y1 * t); }

// (1 - t, t) are barycentric coordinates, as the note says, of the point that is not yet an int.
TEST(NotesZBuffer, TheOneDimensionalSegmentIsTruncated) {
  const int x0 = 20, y0 = 34, x1 = 744, y1 = 400;
  int apart = 0;
  double truncated = 0, nearest = 0, sum = 0;
  for (int x = x0; x <= x1; ++x) {
    const double t = static_cast<double>(x - x0) / (x1 - x0), y = y0 + (y1 - y0) * t;
    EXPECT_NEAR(x0 * (1 - t) + x1 * t, x, 1e-12) << "the same weights give x";
    const int is = segment_depth(y0, y1, t), rounded = static_cast<int>(y0 * (1. - t) + y1 * t + .5);
    apart += is != rounded;
    truncated = std::max(truncated, y - is);
    nearest = std::max(nearest, std::abs(y - rounded));
    sum += y - is;
  }
  EXPECT_EQ(apart, 362) << "of 725 columns a code too low";
  EXPECT_NEAR(truncated, 1, 0.01);
  EXPECT_NEAR(nearest, 0.5, 1e-12);
  EXPECT_NEAR(sum / (x1 - x0 + 1), 0.5, 0.01) << "on average half a code towards 0, where rounding has no side";
}

// The weights' sum is 1, but not the rounded products': a segment of one depth may lose a code. With a t of float, all
// of it is exact in double; and rounding hides it.
TEST(NotesZBuffer, TheOneDimensionalSegmentOfOneDepthIsNotOfOneDepth) {
  int lower = 0, lower_of_float = 0, rounded_lower = 0, all = 0;
  for (int y = 1; y <= 255; ++y) {
    for (int x = 0; x <= 724; ++x) {
      const double t = x / 724.0;
      ++all;
      lower += segment_depth(y, y, t) < y;
      lower_of_float += segment_depth(y, y, static_cast<float>(t)) < y;
      rounded_lower += static_cast<int>(y * (1. - t) + y * t + .5) < y;
    }
  }
  EXPECT_EQ(all, 184875);
  EXPECT_EQ(lower, 3757);
  EXPECT_EQ(lower_of_float, 0);
  EXPECT_EQ(rounded_lower, 0);
}

// Note 000: Color = Ks sum l_e (R.E)^s + Kd sum l_e (N.L) + Ka l_a, without a clamp. E = +z, one channel.
struct Lamp {
  glm::dvec3 to_light;
  double intensity;
};
double note_color(glm::dvec3 n, const std::vector<Lamp>& lamps, double ks, double kd, double s) {
  double color = 0;
  for (const Lamp& lamp : lamps) {
    const double n_dot_l = glm::dot(n, lamp.to_light);
    const glm::dvec3 r = 2 * n_dot_l * n - lamp.to_light;
    if (ks != 0) color += ks * lamp.intensity * std::pow(r.z, s);
    color += kd * lamp.intensity * n_dot_l;
  }
  return color;
}
/// What stage 2 makes of it: a vertex at the origin, the camera on +z looking at it.
double stage_color(glm::dvec3 n, const std::vector<Lamp>& lamps, double ks, double kd, double s) {
  Scene scene;
  scene.meshes.resize(1);
  for (const Lamp& lamp : lamps) {
    const glm::vec3 light(static_cast<float>(lamp.intensity));
    scene.lights.push_back({Light::Kind::directional, lamp.to_light, glm::vec3(0), light, light});
  }
  Draw draw;
  draw.material = {glm::vec4(0), glm::vec4(static_cast<float>(kd)), glm::vec4(static_cast<float>(ks)), glm::vec4(0),
                   static_cast<float>(s)};
  const Vertex<float> vertex{{0, 0, -5, 1}, {0, 0, 0, 1}, Vec3<float>(n)};
  std::vector<Attributes> lit;
  light({scene, draw, scene.meshes[draw.mesh], light_sources(scene), std::span(&vertex, 1)}, lit);
  return lit[0].color().r;
}

TEST(NotesLight, WithoutAClampALightFromBehindDarkens) {
  const glm::dvec3 n(0, 0, 1);
  const std::vector<Lamp> lamps = {{{0.6, 0, 0.8}, 1}, {{0.8, 0, -0.6}, 1}};
  EXPECT_NEAR(note_color(n, lamps, 0, 1, 1), 0.2, 1e-15) << ".8 from before less .6 from behind";
  EXPECT_NEAR(stage_color(n, lamps, 0, 1, 1), 0.8, 1e-7);
  EXPECT_NEAR(note_color(n, {{{0, 0, -1}, 1}}, 0, 1, 1), -1, 1e-15) << "negative light";
  EXPECT_EQ(stage_color(n, {{{0, 0, -1}, 1}}, 0, 1, 1), 0);
}

TEST(NotesLight, WithoutAClampTheHighlightComesBackOnTheFarSide) {
  const glm::dvec3 n(0, 0, 1);
  const std::vector<Lamp> behind = {{{0, 0, -1}, 1}};  // R.E = -1
  EXPECT_EQ(note_color(n, behind, 1, 0, 2), 1) << "an even power: a full highlight from behind";
  EXPECT_EQ(note_color(n, behind, 1, 0, 3), -1) << "an odd one: as much darkness";
  EXPECT_TRUE(std::isnan(note_color(n, behind, 1, 0, 2.5))) << "any other: no number";
  for (double s : {2.0, 3.0, 2.5}) EXPECT_EQ(stage_color(n, behind, 1, 0, s), 0) << s;
  // A light from before whose mirrored ray leaves away from the eye: R.E = -.352. (Stage 2 mirrors no ray, it has the
  // half vector; the clamped Phong term would be 0.)
  EXPECT_NEAR(note_color({0.96, 0, 0.28}, {{{0.6, 0, 0.8}, 1}}, 1, 0, 2), 0.352 * 0.352, 1e-15) << "for 0";
}

}  // namespace
}  // namespace plumbline::pipeline
