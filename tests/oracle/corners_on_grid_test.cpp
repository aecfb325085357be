// Triangles whose corners every renderer of the declared conventions snaps to the same places: nothing is open by the
// grid's step, however coarse.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/oracle/window_answers.h"

namespace plumbline::math {
namespace {

using C = Conventions;

// Corners of three colours, and depths from 1/4 to 3/4, on whole pixels after rounding.
const std::array<glm::vec3, 3> kCorners = {
    glm::vec3(3.23f, 2.11f, 0.25f), {29.77f, 5.36f, 0.5f}, {9.96f, 27.83f, 0.75f}};
const std::array<glm::vec4, 3> kColors = {glm::vec4(1, 0, 0, 1), {0, 1, 0, 1}, {0, 0, 1, 1}};

Scene colored_scene() {
  Scene scene = window_scene({kCorners});
  scene.meshes[0].colors.assign(kColors.begin(), kColors.end());
  return scene;
}

C whole_pixels(C::Rounding rounding, double sample) {
  C out;
  out.subpixel_bits = 0, out.subpixel_rounding = rounding, out.sample = glm::dvec2(sample);
  out.tie_rule = C::TieRule::left_bottom;
  out.attribute_corners = C::Corners::snapped, out.depth_corners = C::DepthCorners::snapped;
  return out;
}

// The renderer's own y points down: H - y is rounded.
double snapped_y(const C& c, double y) {
  if (c.window_y == C::WindowY::up) return rounded(c.subpixel_rounding, y);
  return kSize - rounded(c.subpixel_rounding, kSize - y);
}

// Barycentric coordinates of a pixel's sample between the snapped corners.
glm::dvec3 shares(const C& c, int x, int y) {
  std::array<glm::dvec2, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = {rounded(c.subpixel_rounding, static_cast<double>(kCorners[i].x)),
            snapped_y(c, static_cast<double>(kCorners[i].y))};
  }
  const glm::dvec2 at = glm::dvec2(x, y) + c.sample, e1 = p[1] - p[0], e2 = p[2] - p[0], d = at - p[0];
  const double area = e1.x * e2.y - e1.y * e2.x, b1 = (d.x * e2.y - d.y * e2.x) / area,
               b2 = (e1.x * d.y - e1.y * d.x) / area;
  return {1 - b1 - b2, b1, b2};
}

TEST(CornersOnGrid, LeaveCoverageColorAndDepthOneAnswer) {
  const Scene scene = colored_scene();
  for (const auto& [rounding, window_y] :
       {std::pair(C::Rounding::nearest, C::WindowY::up), std::pair(C::Rounding::down, C::WindowY::up),
        std::pair(C::Rounding::up, C::WindowY::up), std::pair(C::Rounding::down, C::WindowY::down)}) {
    for (const double sample : {0.5, 0.0, 0.25}) {
      C c = whole_pixels(rounding, sample);
      c.window_y = window_y;
      const Legal by = legal(scene, c);
      int inside = 0;
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
          const glm::dvec3 b = shares(c, x, y);
          const double least = std::min({b.x, b.y, b.z});
          if (std::abs(least) < 1e-9) continue;  // on an edge
          ASSERT_EQ(by.certain(x, y), least > 0 ? 1u : 0u) << x << "," << y << " " << name_of(rounding) << sample;
          ASSERT_EQ(by.possible(x, y), by.certain(x, y)) << x << "," << y << " " << name_of(rounding) << sample;
          if (least < 0) continue;
          const LegalAnswer& answer = by.at(x, y).front();
          for (int k = 0; k < 3; ++k) EXPECT_NEAR(answer.color[k], b[k], 1e-4) << x << "," << y;
          EXPECT_LT(answer.color_bound, 1e-4);
          const double z = b.x * 0.25 + b.y * 0.5 + b.z * 0.75;
          EXPECT_NEAR(answer.z_lo, z, 1e-4);
          EXPECT_NEAR(answer.z_hi, z, 1e-4);
          ++inside;
        }
      }
      EXPECT_GT(inside, 200);
    }
  }
}

// Depths between the corners as they are lie on another plane, up to a step of the grid away: 0.25 + 0.5 / 26 y.
TEST(CornersOnGrid, LeaveDepthsBetweenCornersAsTheyAre) {
  const Scene scene = colored_scene();
  C c = whole_pixels(C::Rounding::down, 0.5);
  const auto depths_at = [&](C::DepthCorners corners) {
    c.depth_corners = corners;
    const LegalAnswer answer = legal(scene, c).at(12, 10).front();
    return std::pair(answer.z_lo, answer.z_hi);
  };
  const auto [snapped_lo, snapped_hi] = depths_at(C::DepthCorners::snapped);
  const auto [own_lo, own_hi] = depths_at(C::DepthCorners::as_they_are);
  const auto [lo, hi] = depths_at(C::DepthCorners::either);
  EXPECT_LT(own_hi - own_lo, 1e-4);
  EXPECT_GT(std::abs(own_lo - snapped_lo), 1e-3) << "the planes differ";
  EXPECT_LE(lo, std::min(own_lo, snapped_lo));
  EXPECT_GE(hi, std::max(own_hi, snapped_hi));
}

// The corners of a neighbour may have several places; the edge that it shares has one. No background shows through it.
TEST(CornersOnGrid, LeaveNoCrackBesideAnOpenNeighbour) {
  const glm::vec3 a(4.3f, 3.7f, 0.5f), shared(16.2f, 15.1f, 0.5f), b(6.4f, 28.6f, 0.5f);
  for (const float far : {27.4f, 27.5f}) {
    C c = whole_pixels(C::Rounding::nearest, 0.5);
    c.tie_rule = C::TieRule::any;
    const std::vector<std::array<glm::vec3, 3>> both = {{a, shared, b}, {shared, glm::vec3(far, 20.3f, 0.5f), b}};
    const Legal by = legal(window_scene(both), c);
    std::size_t near_edge = 0;
    for (int y = 17; y < 26; ++y) {
      for (int x = 9; x < 16; ++x) {
        const double from_edge = 14 * (x + 0.5 - 16) + 10 * (y + 0.5 - 15);  // from (16, 15) to (6, 29)
        if (std::abs(from_edge) > 24) continue;
        ++near_edge;
        const auto answers = by.at(x, y);
        EXPECT_TRUE(std::ranges::none_of(answers, [](const LegalAnswer& l) { return l.primitive == kBackground; }))
            << x << "," << y << " " << far;
      }
    }
    EXPECT_GT(near_edge, 20u);
  }
}

// Corners on one line but for a rounding of float; on the grid, a triangle of 6.5 square pixels. Either may cull it.
TEST(CornersOnGrid, LeaveOpenWhatFloatMayHaveNoAreaFor) {
  const float above = std::nextafter(8.6f, 9.0f);
  const Scene scene = window_scene({{glm::vec3(3, 2.1f, 0.5f), {29, 15.1f, 0.5f}, {16, above, 0.5f}}});
  const Legal by = legal(scene, whole_pixels(C::Rounding::nearest, 0.5));
  EXPECT_EQ(std::ranges::count(by.certain.values(), 0u), kSize * kSize);
  EXPECT_GT(open_pixels(by), 3u);
}

// Open corners: one half way between two places, and those of a grid that is not known.
TEST(CornersOnGrid, AreNoneWhereTheirPlacesAreOpen) {
  const auto open = [](const Scene& scene, const C& c) { return open_pixels(legal(scene, c)); };
  const C c = whole_pixels(C::Rounding::nearest, 0.5);
  Scene half = colored_scene();
  EXPECT_EQ(open(half, c), 0u);
  half.meshes[0].positions[0].x = 3.5f;
  EXPECT_GT(open(half, c), 10u);
  C unknown = c;
  unknown.open = {"subpixel_bits"};
  EXPECT_GT(open(colored_scene(), unknown), 10u);
}

}  // namespace
}  // namespace plumbline::math
