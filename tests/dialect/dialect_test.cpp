// Camera and projection of each dialect, against numbers by hand and against the notes' own product of matrices.
#include <random>

#include <gtest/gtest.h>

#include "dialect/dialect.h"
#include "transforms/look_at.h"
#include "transforms/projection.h"
#include "transforms/viewport.h"

namespace plumbline {
namespace {

constexpr double kPi = 3.14159265358979323846;

void expect_near(const glm::dvec4& a, const glm::dvec4& b) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(a[i], b[i], 1e-14) << i;
}

Scene scene_of(const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  return scene;
}
Scene scene_of(const Projection& projection, double aspect) {
  Scene scene;
  scene.projection = projection;
  scene.frame.width = static_cast<int>(64 * aspect);
  scene.frame.height = 64;
  return scene;
}

TEST(GlDialect, LookAtFromTheSide) {
  const glm::dmat4 view = view_matrix(scene_of(Camera{{5, 1, 0}, {0, 1, 0}, {0, 3, 0}}));
  expect_near(view * glm::dvec4(5, 1, 0, 1), {0, 0, 0, 1});   // the eye
  expect_near(view * glm::dvec4(0, 1, 0, 1), {0, 0, -5, 1});  // the centre, straight ahead
  expect_near(view * glm::dvec4(5, 2, 0, 1), {0, 1, 0, 1});   // up
  expect_near(view * glm::dvec4(5, 1, -1, 1), {1, 0, 0, 1});  // looking down -x, -z is on the right
  expect_near(view * glm::dvec4(0, 0, -1, 0), {1, 0, 0, 0});  // a direction does not move
}

TEST(GlDialect, LookAtStraightensUp) {
  // Up leans forward; what is left of it upright is +y.
  const glm::dmat4 view = view_matrix(scene_of(Camera{{0, 0, 2}, {0, 0, 0}, {0, 7, -4}}));
  expect_near(view * glm::dvec4(0.5, 3, 0, 1), {0.5, 3, -2, 1});
  const glm::dmat4 oblique = view_matrix(scene_of(Camera{{1, 2, 3}, {-2, 0.5, 1}, {0.3, 1, -0.2}}));
  const glm::dmat3 turn(oblique);
  const glm::dmat3 identity = glm::transpose(turn) * turn;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(identity[i][k], i == k ? 1 : 0, 1e-15);
  }
  EXPECT_NEAR(glm::determinant(turn), 1, 1e-15);
  expect_near(oblique * glm::dvec4(-2, 0.5, 1, 1), {0, 0, -std::sqrt(9 + 2.25 + 4), 1});
}

TEST(GlDialect, PerspectiveTakesTheFrustumToTheCube) {
  // 90 degrees high: at distance d, the view is 2 d high and 4 d wide.
  const glm::dmat4 p = projection_matrix(scene_of(Perspective{90, 2, 8}, 2.0));
  expect_near(p * glm::dvec4(4, 2, -2, 1), {2, 2, -2, 2});      // the near corner: (1, 1, -1) after division by w
  expect_near(p * glm::dvec4(-16, -8, -8, 1), {-8, -8, 8, 8});  // the far one: (-1, -1, 1)
  const glm::dmat4 narrow = projection_matrix(scene_of(Perspective{60, 1, 3}, 0.5));
  expect_near(narrow * glm::dvec4(0, std::sqrt(1.0 / 3), -1, 1), {0, 1, -1, 1});
  expect_near(narrow * glm::dvec4(std::sqrt(1.0 / 3) / 2, 0, -1, 1), {1, 0, -1, 1});
}

TEST(GlDialect, FrustumTakesItsCornersToTheCube) {
  const glm::dmat4 p = projection_matrix(scene_of(Frustum{-1, 3, 2, 10, 2, 8}, 7.0));
  expect_near(p * glm::dvec4(-1, 2, -2, 1), {-2, -2, -2, 2});
  expect_near(p * glm::dvec4(3, 10, -2, 1), {2, 2, -2, 2});
  expect_near(p * glm::dvec4(-4, 8, -8, 1), {-8, -8, 8, 8});
  expect_near(p * glm::dvec4(12, 40, -8, 1), {8, 8, 8, 8});
}

TEST(GlDialect, OrthographicTakesTheBoxToTheCube) {
  const glm::dmat4 p = projection_matrix(scene_of(Orthographic{-1, 3, 2, 10, 0.5, 4.5}, 7.0));
  expect_near(p * glm::dvec4(-1, 2, -0.5, 1), {-1, -1, -1, 1});
  expect_near(p * glm::dvec4(3, 10, -4.5, 1), {1, 1, 1, 1});
  expect_near(p * glm::dvec4(0, 4, -1.5, 1), {-0.5, -0.5, -0.5, 1});
}

// The dialects.

Scene spoken(Dialect dialect, const Projection& projection) {
  Scene scene;
  scene.dialect = dialect;
  scene.projection = projection;
  scene.camera = {{1, 2, 5}, {0.5, 0.25, -1}, {0.2, 1, 0.1}};
  scene.frame.width = 160;
  scene.frame.height = 90;
  return scene;
}

/// As the pipeline goes: p_win, and w.
glm::dvec4 in_window(const Scene& scene, const glm::dvec3& p_world) {
  const glm::dvec4 p_clip = projection_matrix(scene) * view_matrix(scene) * glm::dvec4(p_world, 1);
  const glm::dvec3 p_ndc = glm::dvec3(p_clip) / p_clip.w, half(scene.frame.width / 2.0, scene.frame.height / 2.0, 0.5);
  return {p_ndc * half + half, p_clip.w};
}

glm::dvec3 divided(const glm::dvec4& p) { return glm::dvec3(p) / p.w; }

/// The largest difference between the window's positions, in pixels and window z, and `notes`, over random points.
template <class Notes>
double largest_difference(const Scene& scene, Notes notes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> in(-0.9, 0.9);
  double largest = 0;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p(in(random), in(random), in(random));
    const glm::dvec4 at = in_window(scene, p);
    EXPECT_GT(at.w, 0) << "before the eye";
    const glm::dvec3 apart = glm::abs(glm::dvec3(at) - notes(glm::dvec4(p, 1)));
    largest = std::max({largest, apart.x, apart.y, apart.z});
  }
  return largest;
}

TEST(Dialects, GzRenderIsItsOwnProductOfMatricesHalfAPixelOn) {
  const Scene scene = spoken(Dialect::gzrender, ViewPlane{50});
  const auto& c = scene.camera;
  namespace gz = transforms::gzrender;
  constexpr double kMaxInt = 2147483647;
  const glm::dmat4 all =
      gz::x_sp(160, 90, kMaxInt) * gz::x_pi(gz::d_of_fov(50 * kPi / 180)) * gz::x_iw(c.eye, c.center, c.up);
  const auto notes = [&](const glm::dvec4& p) {
    const glm::dvec3 p_screen = divided(all * p);  // centres are whole numbers, z up to MAXINT
    return glm::dvec3(p_screen.x + 0.5, p_screen.y + 0.5, p_screen.z / kMaxInt);
  };
  EXPECT_LT(largest_difference(scene, notes), 1e-12);
  const auto not_shifted = [&](const glm::dvec4& p) { return notes(p) - glm::dvec3(0.5, 0.5, 0); };
  EXPECT_NEAR(largest_difference(scene, not_shifted), 0.5, 1e-12);
}

TEST(Dialects, GzRenderByHand) {
  Scene scene = spoken(Dialect::gzrender, ViewPlane{90});  // d = 1
  scene.camera = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}};        // camera space is the world
  scene.frame.width = scene.frame.height = 8;
  expect_near(in_window(scene, {0.5, 0.25, 0}), {6.5, 3.5, 0, 1});          // on the view plane; rows from the top
  expect_near(in_window(scene, {0.5, 0.25, 1}), {5.5, 4, 0.5, 2});          // d further on: half the size
  expect_near(view_matrix(scene) * glm::dvec4(0, 0, -1, 1), {0, 0, 0, 1});  // the eye is d behind c
  EXPECT_EQ(glm::determinant(glm::dmat3(view_matrix(scene))), -1);          // a left-handed world
}

TEST(Dialects, Games101IsItsOwnProductOfMatrices) {
  const Scene scene = spoken(Dialect::games101, Perspective{50, -2, -20});
  const auto& c = scene.camera;
  namespace g = transforms::games101;
  const glm::dmat4 all = g::viewport(160, 90) * g::perspective({50 * kPi / 180, 160.0 / 90}, -2, -20) *
                         transforms::gl::look_at(c.eye, c.center, c.up);
  const auto notes = [&](const glm::dvec4& p) {
    const glm::dvec3 p_screen = divided(all * p);  // z in [-1, 1], 1 near
    return glm::dvec3(p_screen.x, p_screen.y, 0.5 + 0.5 * p_screen.z);
  };
  EXPECT_LT(largest_difference(scene, notes), 1e-12);
  const auto nearer = in_window(scene, {0.9, 1.8, 4}), farther = in_window(scene, {0.5, 0.25, -1});
  EXPECT_GT(nearer.z, farther.z);
}

TEST(Dialects, Games101OrthographicHasItsCoordinates) {
  Scene scene = spoken(Dialect::games101, Orthographic{-1, 3, 2, 10, -0.5, -4.5});
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  const glm::dmat4 p = projection_matrix(scene);
  expect_near(p * glm::dvec4(-1, 2, -0.5, 1), {-1, -1, 1, 1});
  expect_near(p * glm::dvec4(3, 10, -4.5, 1), {1, 1, -1, 1});
}

TEST(Dialects, TinyRendererIsItsOwnProductOfMatricesHalfAPixelOn) {
  const Camera camera = spoken(Dialect::tinyrenderer, Pinhole{1}).camera;
  namespace tiny = transforms::tinyrenderer;
  for (const double c : {glm::distance(camera.eye, camera.center), 3.5}) {
    const Scene scene = spoken(Dialect::tinyrenderer, Pinhole{c});
    const glm::dmat4 all =
        tiny::viewport(0, 0, 160, 90, 255) * tiny::projection(c) * tiny::lookat(camera.eye, camera.center, camera.up);
    const auto notes = [&](const glm::dvec4& p) {
      const glm::dvec3 p_screen = divided(all * p);  // centres are whole numbers, z up to the depth
      return glm::dvec3(p_screen.x + 0.5, p_screen.y + 0.5, p_screen.z / 255);
    };
    EXPECT_LT(largest_difference(scene, notes), 1e-12) << c;
  }
}

TEST(Dialects, EyeSpaceHasTheEyeAtItsOrigin) {
  const Scene tiny = spoken(Dialect::tinyrenderer, Pinhole{2});
  const glm::dvec3 towards = glm::normalize(tiny.camera.eye - tiny.camera.center);
  expect_near(view_matrix(tiny) * glm::dvec4(tiny.camera.center + 2.0 * towards, 1), {0, 0, 0, 1});
  const Scene games = spoken(Dialect::games101, Perspective{50, -2, -20});
  expect_near(view_matrix(games) * glm::dvec4(games.camera.eye, 1), {0, 0, 0, 1});
}

TEST(Dialects, AProjectionOfAnotherDialectIsRefused) {
  for (const Dialect dialect : {Dialect::gl, Dialect::games101, Dialect::tinyrenderer}) {
    EXPECT_THROW(projection_matrix(spoken(dialect, ViewPlane{90})), std::invalid_argument);
  }
  EXPECT_THROW(projection_matrix(spoken(Dialect::gzrender, Pinhole{2})), std::invalid_argument);
  EXPECT_THROW(view_matrix(spoken(Dialect::gzrender, Perspective{45, 1, 2})), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline
