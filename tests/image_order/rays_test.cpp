// Rays, and where they cross triangles: places and depths as GLM has them, ties as an algorithm of integers has them,
// and no way through a closed mesh.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "image_order/crossing.h"
#include "image_order/hierarchy.h"
#include "notes/raster/triangle_algorithms.h"
#include "scene/mesh/mesh_solids.h"

namespace plumbline::image_order {
namespace {

using SpaceTriangle = std::array<glm::dvec3, 3>;

Scene scene_of(const Projection& projection) {
  Scene scene;
  scene.frame.width = 37;
  scene.frame.height = 23;
  scene.camera.eye = {1, -2, 7};
  scene.camera.center = {0.5, 0.25, -1};
  scene.camera.up = {0.1, 1, 0.2};
  scene.projection = projection;
  return scene;
}

glm::dmat4 projection_by_glm(const Projection& projection, double aspect) {
  if (const auto* p = std::get_if<Perspective>(&projection)) {
    return glm::perspective(glm::radians(p->fov_y_degrees), aspect, p->near, p->far);
  }
  if (const auto* f = std::get_if<Frustum>(&projection)) {
    return glm::frustum(f->left, f->right, f->bottom, f->top, f->near, f->far);
  }
  const auto& o = std::get<Orthographic>(projection);
  return glm::ortho(o.left, o.right, o.bottom, o.top, o.near, o.far);
}

// A point of a ray, taken to the window by GLM's matrices, is at the pixel's centre, at window_z's depth.
TEST(Rays, GoThroughPixelCentresAndKnowTheirDepths) {
  const std::vector<Projection> projections = {Perspective{50, 0.5, 90}, Frustum{-0.3, 0.5, -0.1, 0.4, 0.7, 40},
                                               Orthographic{-2, 3, -1, 4, -5, 30}};
  for (const Projection& projection : projections) {
    const Scene scene = scene_of(projection);
    const View view(scene);
    const glm::dmat4 to_eye = glm::lookAt(scene.camera.eye, scene.camera.center, scene.camera.up);
    const glm::dmat4 to_clip = projection_by_glm(projection, 37.0 / 23.0);
    const glm::dvec4 viewport(0, 0, 37, 23);
    for (const glm::ivec2 pixel : {glm::ivec2(0, 0), glm::ivec2(36, 0), glm::ivec2(11, 22), glm::ivec2(18, 11)}) {
      const Ray ray = view.ray(pixel.x, pixel.y);
      const glm::dvec3 direction =
          glm::cross(ray.column, ray.row) / glm::dot(ray.forward, glm::cross(ray.column, ray.row));
      EXPECT_NEAR(glm::length(ray.forward), 1, 1e-15);
      for (const double part : {0.0, 0.1, 0.5, 1.0}) {
        const double far = view.near() + part * (view.far() - view.near());
        const glm::dvec3 p = ray.origin + far * direction;
        const Seen s = seen(ray, p);
        EXPECT_NEAR(s.x, 0, 1e-12);
        EXPECT_NEAR(s.y, 0, 1e-12);
        EXPECT_NEAR(s.along, far, 1e-12);
        const glm::dvec3 p_win = glm::project(p, to_eye, to_clip, viewport);
        EXPECT_NEAR(p_win.x, pixel.x + 0.5, 1e-11);
        EXPECT_NEAR(p_win.y, pixel.y + 0.5, 1e-11);
        EXPECT_NEAR(p_win.z, view.window_z(far), 1e-11);
      }
      EXPECT_GT(seen(ray, ray.origin + glm::cross(ray.forward, scene.camera.up)).x, 0) << "the right is +x";
      EXPECT_GT(seen(ray, ray.origin + scene.camera.up).y, 0);
    }
    EXPECT_EQ(view.window_z(view.near()), 0);
    EXPECT_EQ(view.window_z(view.far() * 2), 1);
    double before = 0;
    for (double d = view.near(); d < view.far(); d += 1e-3 * (view.far() - view.near())) {
      EXPECT_GE(view.window_z(d), before);
      before = view.window_z(d);
    }
  }
}

constexpr int kRaysAcross = 24, kHeight = 19;
Scene pixels() {
  Scene scene;
  scene.frame.width = kRaysAcross;
  scene.frame.height = kHeight;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{0, kRaysAcross, 0, kHeight, 1, 100};
  return scene;
}

// World units are pixels and corners multiples of 1/256: all is exact, so that every tie is one.
TEST(Crossing, CoversWhatAnAlgorithmOfIntegersCovers) {
  const View view(pixels());
  std::mt19937 random(11);
  const auto coordinate = [&](int side, int grid) {
    return (static_cast<int>(random() % static_cast<unsigned>(side + 8)) - 4) * 256 +
           static_cast<int>(random() % 3) * grid;
  };
  long covered = 0;
  int apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const int grid = i % 2 == 0 ? 0 : 85;
    raster::Corners corners;
    for (glm::ivec2& c : corners) c = {coordinate(kRaysAcross, grid), coordinate(kHeight, grid)};
    SpaceTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = {glm::dvec2(corners[k]) / 256.0 + 0.5, -2.0 - static_cast<double>(k)};
    std::set<std::pair<int, int>> expected, found;
    for (const raster::Span& s : raster::cover_by_lee(corners, kRaysAcross, kHeight)) {
      for (int x = s.begin; x < s.end; ++x) expected.emplace(x, s.y);
    }
    const glm::ivec2 a = corners[1] - corners[0], b = corners[2] - corners[0];
    const bool front = std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x > 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kRaysAcross; ++x) {
        const auto at = crossing(view.ray(x, y), triangle);
        if (!at) continue;
        found.emplace(x, y);
        EXPECT_EQ(at->front, front);
        EXPECT_TRUE(at->along >= 2 && at->along <= 4);
      }
    }
    covered += static_cast<long>(expected.size());
    apart += found == expected ? 0 : 1;
  }
  EXPECT_EQ(apart, 0);
  EXPECT_GT(covered, 20000);
}

TEST(Crossing, ByHand) {
  const Ray ray{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  const auto at = crossing(ray, {{{-1, -1, -3}, {2, -1, -3}, {-1, 2, -3}}});
  ASSERT_TRUE(at);
  EXPECT_EQ(at->along, 3);
  EXPECT_TRUE(at->front);
  EXPECT_FALSE(crossing(ray, {{{-1, -1, -3}, {-1, 2, -3}, {2, -1, -3}}})->front);
  EXPECT_EQ(crossing(ray, {{{-1, -1, 3}, {2, -1, 3}, {-1, 2, 3}}})->along, -3) << "behind the eye";
  EXPECT_FALSE(crossing(ray, {{{1, 1, -3}, {2, 1, -3}, {1, 2, -3}}}));
  EXPECT_FALSE(crossing(ray, {{{0, 0, -3}, {0, 1, -3}, {0, -1, -9}}})) << "edge-on, through the ray";
  EXPECT_FALSE(crossing(ray, {{{0, 0, -3}, {0, 0, -3}, {0, 0, -3}}}));
  // In the plane x + z = -2, with a corner behind the eye.
  const auto across = crossing(ray, {{{-4, -1, 2}, {4, -1, -6}, {0, 3, -2}}});
  ASSERT_TRUE(across);
  EXPECT_EQ(across->along, 2);
}

// The ray is 1 on the inner side of an edge, of products of 2^54, which their rounded difference shows as 0.
TEST(Crossing, TheSignOfAnAreaIsExact) {
  const Ray ray{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  constexpr double kLarge = 1 << 27;
  const glm::dvec3 a(kLarge + 1, kLarge, -3), b(-kLarge - 2, -kLarge - 1, -3), c(-kLarge, kLarge, -3),
      d(kLarge, -kLarge, -3);
  EXPECT_EQ((kLarge + 1) * (kLarge + 1) - kLarge * (kLarge + 2), 0) << "rounded";
  EXPECT_TRUE(crossing(ray, {b, a, c}));
  EXPECT_FALSE(crossing(ray, {a, b, d}));
}

// Else a box could be left out for a triangle in it that is nearer.
TEST(Crossing, IsNeverNearerOrFartherThanAllCorners) {
  std::mt19937 random(6);
  const auto in = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const Ray ray{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  int crossings = 0;
  for (int i = 0; i < 3000; ++i) {
    const double z = in(1, 90);
    SpaceTriangle t;
    for (glm::dvec3& p : t) p = {in(-1, 1), in(-1, 1), -z};
    const auto at = crossing(ray, t);
    if (!at) continue;
    ++crossings;
    EXPECT_EQ(at->along, z);
  }
  EXPECT_GT(crossings, 500);
}

/// The ray from the eye to a point.
Ray ray_to(glm::dvec3 eye, glm::dvec3 p) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0.01, 0.02, 0) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, {0, 1, 0})), up = glm::cross(right, forward);
  const glm::dvec3 d = p - eye;
  const double s = glm::dot(right, d) / glm::dot(forward, d), t = glm::dot(up, d) / glm::dot(forward, d);
  return {eye, right - s * forward, up - t * forward, forward};
}

// Aimed at corners and at points of edges, where each triangle alone could say that the ray passes by on the other's
// side.
TEST(Crossing, NoRaySlipsThroughAClosedMesh) {
  const Mesh mesh = make_icosphere(4);
  std::vector<SpaceTriangle> triangles;
  for (const glm::uvec3& t : mesh.triangles) {
    triangles.push_back(
        {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])});
  }
  const Hierarchy hierarchy(triangles);
  std::mt19937 random(2);
  long rays = 0, wrong = 0;
  for (int eye = 0; eye < 20; ++eye) {
    const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    const glm::dvec3 from = 3.0 * glm::normalize(glm::dvec3(unit(), unit(), unit()));
    const auto aim = [&](glm::dvec3 p) {
      if (glm::dot(glm::normalize(p), from) < 1.5) return;  // the silhouette is at 1
      int front = 0, back = 0;
      const Ray ray = ray_to(from, p);
      hierarchy.walk(
          ray, 0, [](double) { return false; },
          [&](std::uint32_t i) {
            if (const auto at = crossing(ray, triangles[i])) ++(at->front ? front : back);
          });
      ++rays;
      wrong += front == 1 && back == 1 ? 0 : 1;
    };
    for (const glm::vec3& p : mesh.positions) aim(p);
    for (const SpaceTriangle& t : triangles) {
      aim((t[0] + t[1]) / 2.0);
      aim(t[1] + (t[2] - t[1]) / 3.0);
    }
  }
  EXPECT_GT(rays, 50000);
  EXPECT_EQ(wrong, 0);
}

TEST(Hierarchy, LeavesOutNothingThatARayCrosses) {
  std::mt19937 random(4);
  const auto in = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  std::vector<SpaceTriangle> triangles(300);
  for (SpaceTriangle& t : triangles) {
    const glm::dvec3 at(in(0, kRaysAcross), in(0, kHeight), in(-90, -5));
    const double size = in(0.1, 12);
    for (glm::dvec3& p : t) p = at + size * glm::dvec3(in(-1, 1), in(-1, 1), in(-1, 1));
  }
  const Hierarchy hierarchy(triangles);
  Scene scene = pixels();
  long crossings = 0, visits = 0;
  for (const Projection& projection : {scene.projection, Projection(Frustum{0, 1, 0, 0.8, 1, 100})}) {
    scene.projection = projection;
    const View view(scene);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kRaysAcross; ++x) {
        const Ray ray = view.ray(x, y);
        std::set<std::uint32_t> all, found, near_all, near_found;
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
          const auto at = crossing(ray, triangles[i]);
          if (at && at->along >= 1) all.insert(i);
          if (at && at->along >= 10 && at->along <= 40) near_all.insert(i);
        }
        const auto note = [&](std::set<std::uint32_t>& into, double low, double high) {
          return [&into, &ray, &triangles, low, high](std::uint32_t i) {
            const auto at = crossing(ray, triangles[i]);
            const bool within = at && at->along >= low && at->along <= high;
            EXPECT_TRUE(!within || into.insert(i).second) << "visited twice";
          };
        };
        hierarchy.walk(
            ray, 1, [](double) { return false; },
            [&](std::uint32_t i) {
              ++visits;
              note(found, 1, 1e9)(i);
            });
        const auto beyond = [](double along) { return along > 40; };
        hierarchy.walk(ray, 10, beyond, note(near_found, 10, 40));
        EXPECT_EQ(found, all);
        EXPECT_EQ(near_found, near_all);
        crossings += static_cast<long>(all.size());
      }
    }
  }
  EXPECT_GT(crossings, 1000);
  EXPECT_LT(visits, 2L * kRaysAcross * kHeight * 300 / 3);  // else it is no help
  const auto never = [](double) { return false; };
  Hierarchy({}).walk(View(scene).ray(0, 0), 1, never, [](std::uint32_t) { FAIL(); });
}

}  // namespace
}  // namespace plumbline::image_order
