// Stage 4: division, viewport, snapping, fans, facing, culling.
#include "pipeline/geometry.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace plumbline::pipeline {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(PipelineSnap, PixelCentresAreMultiplesOf256) {
  for (int i : {-16384, -3, -1, 0, 1, 2, 1000, 16383}) {
    EXPECT_EQ(snap(static_cast<float>(i) + 0.5f), 256 * i);
    EXPECT_EQ(snap(static_cast<float>(i)), 256 * i - 128);
  }
}

TEST(PipelineSnap, HalvesGoToTheEven) {
  for (int k : {-4194304, -257, -129, -128, -127, -3, -2, -1, 0, 1, 2, 3, 126, 127, 128, 1000001, 2097151}) {
    const double half = (k + 0.5) / 256 + 0.5;
    const auto win = static_cast<float>(half);
    if (static_cast<double>(win) != half) continue;  // too fine for a float so far out
    EXPECT_EQ(snap(win), k % 2 == 0 ? k : k + 1) << "half way from " << k;
    EXPECT_EQ(snap(std::nextafter(win, kInfinity)), k + 1) << "just above " << k << " and a half";
    EXPECT_EQ(snap(std::nextafter(win, -kInfinity)), k) << "just below " << k << " and a half";
  }
}

TEST(PipelineSnap, IsNotRoundedInFloatOnTheWay) {
  // 1/512 + 2^-32 is above the half; in float, less 1/2 it is on it, and would go down to -128.
  const float win = 1.0f / 512 + std::ldexp(1.0f, -32);
  ASSERT_EQ((win - 0.5f) * 256, -127.5f);
  EXPECT_EQ(snap(win), -127);
  EXPECT_EQ(snap(-win), -129);
}

TEST(PipelineSnap, AsFarAsCornersMayBe) {
  EXPECT_EQ(snap(1048576.0f), 268435456 - 128);
  EXPECT_EQ(snap(-1048576.0f), -268435456 - 128);
  EXPECT_EQ(snap(1e-30f), -128);
  EXPECT_EQ(snap(0.5f), 0);
}

class PipelineWindow : public testing::Test {
 protected:
  PipelineWindow() { scale_to({4, 2}); }
  /// A viewport of that size, its lower left corner at the origin.
  void scale_to(glm::vec2 size) { matrices_.win_scale = matrices_.win_translate = glm::vec3(size / 2.0f, 0.5f); }
  void add(std::vector<glm::vec4> corners, std::uint32_t primitive = 0, bool cut = false) {
    Polygon& polygon = polygons_.emplace_back();
    polygon.primitive = primitive;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      ClipVertex v{corners[i], {}, cut};
      v.attributes.color() = glm::vec4(static_cast<float>(i), 0, 0, 1);
      polygon.corners.push_back(v);
    }
  }
  std::vector<ShadedTriangle> run(Cull cull = Cull::none, bool two_sided = false) const {
    std::vector<ShadedTriangle> out;
    Draw draw;
    draw.cull = cull;
    for (const Polygon& polygon : polygons_) {
      to_window({&draw, Topology::triangles, false, two_sided, matrices_}, polygon, out);
    }
    return out;
  }
  static float red(const ShadedTriangle& t, std::size_t corner) { return t.attributes[corner].color().r; }
  Matrices<float> matrices_{Mat4<float>(1), Mat4<float>(1), Mat3<float>(1), Vec3<float>(1), Vec3<float>(0)};
  std::vector<Polygon> polygons_;
};

TEST_F(PipelineWindow, DividesAndMovesToTheWindow) {
  matrices_.win_scale = {2, 1, 0.5f};
  matrices_.win_translate = {3, 5, 0.25f};
  add({{-1, -1, -1, 1}, {2, -2, 0, 2}, {0, 4, 4, 4}}, 7);
  const auto out = run();
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].primitive, 7u);
  EXPECT_TRUE(out[0].front);
  const auto& [b, c, a] = out[0].v;  // corners 1, 2, 0
  EXPECT_EQ(a.p_win, glm::vec3(1, 4, -0.25f));
  EXPECT_EQ(b.p_win, glm::vec3(5, 4, 0.25f));
  EXPECT_EQ(c.p_win, glm::vec3(3, 6, 0.75f));
  EXPECT_EQ(a.inv_w, 1);
  EXPECT_EQ(b.inv_w, 0.5f);
  EXPECT_EQ(c.inv_w, 0.25f);
  EXPECT_EQ(red(out[0], 2), 0);
  EXPECT_EQ(red(out[0], 0), 1);
  EXPECT_EQ(red(out[0], 1), 2);
  EXPECT_EQ(a.snapped, glm::ivec2(128, 7 * 128));
  EXPECT_EQ(b.snapped, glm::ivec2(9 * 128, 7 * 128));
  EXPECT_EQ(c.snapped, glm::ivec2(5 * 128, 11 * 128));
}

TEST_F(PipelineWindow, APolygonIsAFanAboutItsFirstVertex) {
  add({{-1, -1, 0, 1}, {0, -1, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {-1, 0.5f, 0, 1}}, 3);
  const auto out = run();
  ASSERT_EQ(out.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<float>(i);  // the colours number the corners: (i-1, i, 0) for i = 2, 3, 4
    EXPECT_EQ(red(out[i], 0), k + 1);
    EXPECT_EQ(red(out[i], 1), k + 2);
    EXPECT_EQ(red(out[i], 2), 0);
    EXPECT_EQ(out[i].primitive, 3u);
  }
}

TEST_F(PipelineWindow, BackFacesOfTwoSidedDrawsHaveTheBacksColours) {
  add({{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}, 0);  // counter-clockwise
  add({{0, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}}, 1);  // clockwise
  for (Polygon& polygon : polygons_) {
    for (ClipVertex& v : polygon.corners) {
      v.attributes[Varying::secondary] = glm::vec4(2);
      v.attributes[Varying::back_color] = glm::vec4(7);
      v.attributes[Varying::back_secondary] = glm::vec4(8);
    }
  }
  for (const bool two_sided : {false, true}) {
    const auto out = run(Cull::none, two_sided);
    ASSERT_EQ(out.size(), 2u);
    EXPECT_EQ(red(out[0], 2), 0) << "a front face";
    EXPECT_EQ(out[0].attributes[2][Varying::secondary], glm::vec4(2));
    EXPECT_EQ(red(out[1], 2), two_sided ? 7 : 0);
    EXPECT_EQ(out[1].attributes[2][Varying::secondary], glm::vec4(two_sided ? 8.0f : 2.0f));
  }
}

TEST_F(PipelineWindow, Culls) {
  add({{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}, 0);  // counter-clockwise
  add({{0, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}}, 1);  // clockwise
  const auto all = run(Cull::none), front = run(Cull::back), back = run(Cull::front);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(all[0].front);
  EXPECT_FALSE(all[1].front);
  ASSERT_EQ(front.size(), 1u);
  EXPECT_EQ(front[0].primitive, 0u);
  EXPECT_TRUE(front[0].front);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].primitive, 1u);
  EXPECT_FALSE(back[0].front);
}

TEST_F(PipelineWindow, FacingIsOfTheSnappedCornersEachTriangleOfTheFanItsOwn) {
  // The second triangle of the fan has no area, the third's is of the other sign.
  add({{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {0, 0, 0, 1}, {0.5f, -0.5f, 0, 1}});
  const auto out = run();
  ASSERT_EQ(out.size(), 2u);
  EXPECT_TRUE(out[0].front);
  EXPECT_FALSE(out[1].front);
  EXPECT_EQ(red(out[1], 0), 3);
  EXPECT_EQ(run(Cull::back).size(), 1u);
  EXPECT_EQ(run(Cull::front).size(), 1u);
}

TEST_F(PipelineWindow, WithoutSnappedAreaIsGone) {
  scale_to({2, 2});
  const float fine = 1.0f / 2048;  // an eighth of a step
  add({{0, 0, 0, 1}, {0.5f, 0.5f, 0, 1}, {-0.5f, -0.5f, 0, 1}});
  add({{0, 0, 0, 1}, {0.5f, 0, 0, 1}, {0.25f, fine, 0, 1}});  // has an unsnapped area
  EXPECT_TRUE(run().empty());
  add({{0, 0, 0, 1}, {0.5f, 0, 0, 1}, {0.25f, 8 * fine, 0, 1}});
  EXPECT_EQ(run().size(), 1u) << "one step high";
}

TEST_F(PipelineWindow, TheAreaDoesNotOverflowInTheFarthestCorners) {
  matrices_.win_scale = {1, 1, 1};
  matrices_.win_translate = {0, 0, 0};
  const float far = 1048576;
  add({{-far, -far, 0, 1}, {far, -far, 0, 1}, {-far, far, 0, 1}});
  const auto out = run();
  ASSERT_EQ(out.size(), 1u);
  EXPECT_TRUE(out[0].front);
  EXPECT_EQ(snapped_area(out[0]), std::int64_t{1} << 58);
}

TEST_F(PipelineWindow, CornersOutOfReachDropTheWholePolygon) {
  matrices_.win_scale = {1, 1, 1};
  matrices_.win_translate = {0, 0, 0};
  const float far = 1048576, farther = std::nextafter(far, kInfinity);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<glm::vec4> good = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}};
  const glm::vec4 reaches[] = {{far, 2, 0, 1}, {-far, 2, 0, 1}, {0, far, 0, 1}, {-2, -far, 0, 1}};
  for (const glm::vec4& corner : reaches) {
    polygons_.clear();
    add({good[0], good[1], good[2], corner});
    EXPECT_EQ(run().size(), 2u) << corner.x << " " << corner.y;
  }
  const glm::vec4 out_of_reach[] = {{farther, 2, 0, 1}, {-farther, 2, 0, 1}, {0, farther, 0, 1},   {-2, -farther, 0, 1},
                                    {0, 1, 0, 0},       {0, 0, 0, 0},        {0, 1, 0, -0.0f},     {0, 1, 0, 1e-42f},
                                    {nan, 1, 0, 1},     {0, nan, 0, 1},      {0, 1, kInfinity, 1}, {0, 1, nan, 1},
                                    {0, 1, 0, nan},     {kInfinity, 1, 0, 1}};
  for (const glm::vec4& corner : out_of_reach) {
    for (std::size_t place = 0; place < 4; ++place) {
      polygons_.clear();
      std::vector<glm::vec4> corners = good;
      corners.insert(corners.begin() + static_cast<std::ptrdiff_t>(place), corner);
      add(corners);
      EXPECT_TRUE(run().empty()) << "corner " << place << ": " << corner.x << " " << corner.y << " " << corner.w;
    }
  }
  add(good);
  EXPECT_EQ(run().size(), 1u) << "the next polygon is drawn";
}

TEST_F(PipelineWindow, MeshVerticesAreFusedAndCutOnesAreNot) {
  // In a window 1001 pixels wide the two ways differ by an ULP, up and down.
  struct Case {
    float x, w, separate, fused;
  };
  const Case cases[] = {{0x1.7d4b94p+0f, 0x1.7f7448p+0f, 0x1.f3174cp+9f, 0x1.f3174ap+9f},
                        {0x1.17458cp+1f, 0x1.17cfp+1f, 0x1.f4051p+9f, 0x1.f40512p+9f}};
  scale_to({1001, 1001});
  for (const Case& c : cases) {
    for (bool cut : {false, true}) {
      polygons_.clear();
      add({{0, 0, 0, 1}, {c.x, -c.w, 0, c.w}, {-1, c.x / c.w, 0, 1}}, 0, cut);
      EXPECT_EQ(run().at(0).v[0].p_win.x, cut ? c.separate : c.fused);
    }
  }
}

TEST_F(PipelineWindow, EachVertexOfACutPolygonIsRoundedItsOwnWay) {
  scale_to({1001, 1001});
  add({{0x1.7d4b94p+0f, -1, 0, 0x1.7f7448p+0f}, {0x1.7d4b94p+0f, 1, 0, 0x1.7f7448p+0f}, {-1, 0, 0, 1}});
  polygons_[0].corners[1].cut = true;
  const auto out = run();
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].v[2].p_win.x, 0x1.f3174ap+9f);
  EXPECT_EQ(out[0].v[0].p_win.x, 0x1.f3174cp+9f);
}

TEST_F(PipelineWindow, TheReciprocalIsRoundedBeforeTheProduct) {
  // As the driver divides: x * (1 / w), not x / w.
  matrices_.win_scale = {1, 1, 1};
  matrices_.win_translate = {0, 0, 0};
  std::mt19937 random(4);
  std::uniform_real_distribution<float> number(1, 2);
  int differ = 0;
  for (int i = 0; i < 100; ++i) {
    const float x = number(random), w = number(random);
    polygons_.clear();
    add({{0, 0, 0, 1}, {x, 0, 0, w}, {0, 1, 0, 1}});
    const float reciprocal = 1 / w;
    ASSERT_EQ(run().at(0).v[0].p_win.x, x * reciprocal);
    differ += x / w != x * reciprocal;
  }
  EXPECT_GT(differ, 5);
}

}  // namespace
}  // namespace plumbline::pipeline
