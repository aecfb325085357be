#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

using exact::facing;
using exact::snap;

TEST(ExactWindow, SnappingRoundsHalfToEven) {
  const auto snapped = [](double steps) { return snap({0.5 + steps / 256, 0.5 - steps / 256}); };
  EXPECT_EQ(snapped(0), glm::ivec2(0, 0));
  EXPECT_EQ(snapped(0.5), glm::ivec2(0, 0));
  EXPECT_EQ(snapped(1.5), glm::ivec2(2, -2));
  EXPECT_EQ(snapped(2.5), glm::ivec2(2, -2));
  EXPECT_EQ(snapped(2.5 + 1e-9), glm::ivec2(3, -3));
  EXPECT_EQ(snapped(3.49), glm::ivec2(3, -3));
  EXPECT_EQ(snapped(-0.5), glm::ivec2(0, 0));
  EXPECT_EQ(snapped(-1.5), glm::ivec2(-2, 2));
  EXPECT_EQ(snap({3.5, 16384}), glm::ivec2(768, 16384 * 256 - 128)) << "centres are at half-integers";
}

TEST(ExactWindow, CounterClockwiseIsFront) {
  EXPECT_EQ(facing({{{0, 0}, {1, 0}, {0, 1}}}), 1);
  EXPECT_EQ(facing({{{0, 0}, {0, 1}, {1, 0}}}), -1);
  EXPECT_EQ(facing({{{0, 0}, {2, 1}, {4, 2}}}), 0);
  constexpr int kMin = std::numeric_limits<int>::min(), kMax = std::numeric_limits<int>::max();
  EXPECT_EQ(facing({{{kMin, kMin}, {kMax, kMin}, {kMin, kMax}}}), 1) << "beyond 64 bits";
  // The area is 1, the products are near 2^46.
  EXPECT_EQ(facing({{{0, 0}, {8388608, 8388607}, {8388607, 8388606}}}), -1);
}

// One polygon of one primitive under an 8 x 4 window.
struct Window : testing::Test {
  Window() {
    records.matrices.resize(1);
    records.matrices[0].win_scale = {4, 2, 0.5};
    records.matrices[0].win_translate = {4, 2, 0.5};
  }
  void polygon(std::initializer_list<glm::dvec4> p_clip) {
    records.polygons = {};
    for (const glm::dvec4& p : p_clip)
      records.polygons.vertices.push_back(
          {p, glm::dvec4(static_cast<double>(records.polygons.vertices.size())), false});
    records.polygons.polygons = {{0, 0, static_cast<std::uint32_t>(p_clip.size())}};
  }
  std::vector<WindowTriangle<double>> triangles() { return run(scene, Stage::window, records).records.triangles; }
  Scene scene = scene_of(8, 4);
  Records<double> records;
};

TEST_F(Window, DividesAndMovesToTheWindow) {
  polygon({{0, 0, 0, 1}, {2, 1, -4, 4}, {-1, 2, 2, 2}});
  const auto t = triangles();
  ASSERT_EQ(t.size(), 1u);
  // Corners (1, 2, 0) of the polygon.
  EXPECT_EQ(t[0].v[2].p_win, glm::dvec3(4, 2, 0.5));
  EXPECT_EQ(t[0].v[0].p_win, glm::dvec3(6, 2.5, 0));
  EXPECT_EQ(t[0].v[1].p_win, glm::dvec3(2, 4, 1));
  EXPECT_EQ(t[0].v[0].inv_w, 0.25);
  EXPECT_EQ(t[0].v[0].snapped, glm::ivec2(5 * 256 + 128, 512));
  EXPECT_EQ(t[0].v[0].color, glm::dvec4(1));
  EXPECT_EQ(t[0].v[2].color, glm::dvec4(0));
  EXPECT_TRUE(t[0].front);
}

TEST_F(Window, APolygonIsAFanFromItsFirstVertex) {
  polygon({{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}});
  const auto t = triangles();
  ASSERT_EQ(t.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(t[i].v[0].color.r, static_cast<double>(i + 1));
    EXPECT_EQ(t[i].v[1].color.r, static_cast<double>(i + 2));
    EXPECT_EQ(t[i].v[2].color.r, 0.0);
  }
}

TEST_F(Window, TrianglesOfTheFanAreDroppedAlone) {
  // The first of the fan has no area.
  polygon({{-1, -1, 0, 1}, {0, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}});
  const auto t = triangles();
  ASSERT_EQ(t.size(), 1u);
  EXPECT_EQ(t[0].v[0].color.r, 2.0);
  // Less than half a step apart: no snapped area.
  polygon({{0, 0, 0, 1}, {1e-5, 0, 0, 1}, {0, 1e-5, 0, 1}});
  EXPECT_TRUE(triangles().empty());
}

TEST_F(Window, Culls) {
  const auto drawn = [&](Cull cull, bool clockwise) {
    scene.draws[0].cull = cull;
    if (clockwise)
      polygon({{0, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}});
    else
      polygon({{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}});
    const auto t = triangles();
    EXPECT_TRUE(t.empty() || t[0].front == !clockwise);
    return !t.empty();
  };
  EXPECT_TRUE(drawn(Cull::none, false));
  EXPECT_TRUE(drawn(Cull::none, true));
  EXPECT_TRUE(drawn(Cull::back, false));
  EXPECT_FALSE(drawn(Cull::back, true));
  EXPECT_FALSE(drawn(Cull::front, false));
  EXPECT_TRUE(drawn(Cull::front, true));
}

TEST_F(Window, DropsWhatHasNoPlaceInTheWindow) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const glm::dvec4& bad :
       {glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 0, 0), glm::dvec4(1, 0, 0, -1), glm::dvec4(1, 0, 0, 1e-310),
        glm::dvec4(0, 0, 0, 1e-310), glm::dvec4(inf, 0, 0, 1), glm::dvec4(1, 0, inf, 1),
        glm::dvec4(1, 0, 0, std::nan("")), glm::dvec4(1e10, 0, 0, 1)}) {
    polygon({{0, 0, 0, 1}, bad, {1, 0, 0, 1}, {0, 1, 0, 1}});
    EXPECT_TRUE(triangles().empty()) << bad.x << " " << bad.y << " " << bad.z << " " << bad.w;
  }
}

TEST_F(Window, RefusesRecordsThatDoNotFit) {
  polygon({{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}});
  records.polygons.polygons[0].count = 4;
  EXPECT_THROW(triangles(), std::invalid_argument);
  records.polygons.polygons[0] = {1, 0, 3};
  EXPECT_THROW(triangles(), std::invalid_argument) << "the scene has one primitive";
  records.polygons.polygons[0] = {0, 0, 3};
  EXPECT_EQ(triangles().size(), 1u);
  records.matrices.clear();
  EXPECT_THROW(triangles(), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
