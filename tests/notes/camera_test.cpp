// What the notes get wrong or leave open about cameras: the number by the notes, the right one, and how far apart.
#include <cmath>

#include <gtest/gtest.h>

#include "transforms/look_at.h"
#include "transforms/projection.h"
#include "transforms/transform.h"
#include "transforms/viewport.h"

namespace plumbline::transforms {
namespace {

constexpr double kQuarterTurn = 1.5707963267948966;

glm::dvec3 seen(const glm::dmat4& m, const glm::dvec3& p) {
  const glm::dvec4 q = m * glm::dvec4(p, 1);
  return glm::dvec3(q) / q.w;
}

void expect_near(const glm::dvec3& is, const glm::dvec3& expected, double bound) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(is[i], expected[i], bound) << "component " << i;
}

// GzRender (000): "v = w x v". Of v on the right the notes say nothing; here it is what up was.
glm::dmat4 m_cam_as_printed(const glm::dvec3& e, const glm::dvec3& g, const glm::dvec3& t, const glm::dvec3& v_before) {
  const glm::dvec3 w = glm::normalize(g), u = glm::normalize(glm::cross(t, w)), v = glm::cross(w, v_before);
  const glm::dmat4 axes(glm::dvec4(u, 0), glm::dvec4(v, 0), glm::dvec4(w, 0), glm::dvec4(0, 0, 0, 1));
  return glm::transpose(axes) * translation(-e);
}

TEST(NotesCamera, VIsWCrossU) {
  const glm::dvec3 e(0, 0, -10), g(0, 0, 1), t(0, 1, 0), p(1, 2, 0);
  EXPECT_EQ(seen(gzrender::m_cam(e, g, t), p), glm::dvec3(1, 2, 10));
  // As printed y is -x: 3 away.
  EXPECT_EQ(seen(m_cam_as_printed(e, g, t, t), p), glm::dvec3(1, -1, 10));
  // At 640 x 480 and 90 degrees: from pixel (349.1, 196.4) to (349.1, 261.8).
  const glm::dmat4 window = gzrender::x_sp(640, 480, 1) * gzrender::x_pi(gzrender::d_of_fov(kQuarterTurn));
  expect_near(seen(window * gzrender::m_cam(e, g, t), p), {320 + 320.0 / 11, 240 - 480.0 / 11, 10.0 / 11}, 1e-12);
  expect_near(seen(window * m_cam_as_printed(e, g, t, t), p), {320 + 320.0 / 11, 240 + 240.0 / 11, 10.0 / 11}, 1e-12);
}

// w x up is -u times a length, whatever the camera: the picture falls onto a line. v = 0 before gives a line too.
TEST(NotesCamera, AsPrintedThePictureIsALine) {
  const glm::dvec3 e(-10, 5, -10), g(10, -5, 10), t(0, 1, 0);  // GzRender's default camera
  EXPECT_NEAR(glm::determinant(glm::dmat3(gzrender::m_cam(e, g, t))), 1, 1e-15);
  EXPECT_NEAR(glm::determinant(glm::dmat3(m_cam_as_printed(e, g, t, t))), 0, 1e-16);
  EXPECT_NEAR(glm::determinant(glm::dmat3(m_cam_as_printed(e, g, t, {0, 0, 0}))), 0, 1e-16);
  const double slope = -std::sqrt(200.0 / 225.0);  // the sine between g and t
  for (const glm::dvec3& p : {glm::dvec3(1, 2, 3), glm::dvec3(-4, 0, 1), glm::dvec3(0, 7, -2)}) {
    const glm::dvec3 q = seen(m_cam_as_printed(e, g, t, t), p);
    EXPECT_NEAR(q.y, slope * q.x, 1e-14);
  }
  // Given u in v's place, it is right.
  EXPECT_EQ(gzrender::m_cam(e, g, t), m_cam_as_printed(e, g, t, glm::normalize(glm::cross(t, glm::normalize(g)))));
}

// TinyRenderer (002): `lookat` puts `center` at the origin, not the eye. With w = 1 - z/c the eye is at c.
constexpr double kSize = 800;  // pixels in width and height
glm::dvec2 tiny_pixel(double c, const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& p) {
  const glm::dmat4 window = tinyrenderer::viewport(0, 0, kSize, kSize, 255);
  return seen(window * tinyrenderer::projection(c) * tinyrenderer::lookat(eye, center, {0, 1, 0}), p);
}
glm::dvec2 gl_pixel(double c, const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& p) {
  const glm::dmat4 view = gl::perspective({2 * std::atan(1 / c), 1}, 0.1, 100) * gl::look_at(eye, center, {0, 1, 0});
  return seen(games101::viewport(kSize, kSize) * view, p);
}

TEST(NotesCamera, TinyRenderersLookatIsGluLookAtWhereCIsTheEyesDistance) {
  const glm::dvec3 eye(0, 0, 4), center(0, 0, 0), p(0.5, 0.25, 2);
  // c = 4: x = 0.5 / (1 - 2/4) = 1.
  EXPECT_LE(glm::distance(tiny_pixel(4, eye, center, p), glm::dvec2(800, 600)), 1e-12);
  EXPECT_LE(glm::distance(gl_pixel(4, eye, center, p), glm::dvec2(800, 600)), 1e-12);
  // Any camera, c its distance: the same pixel.
  const glm::dvec3 oblique(1, 1, 3), aside(0.2, -0.3, 0.1);
  const double c = glm::distance(oblique, aside);
  for (const glm::dvec3& q : {p, glm::dvec3(1, -1, 1), glm::dvec3(-0.3, 0.7, -5)}) {
    EXPECT_LE(glm::distance(tiny_pixel(c, oblique, aside, q), gl_pixel(c, oblique, aside, q)), 1e-11);
  }
}

TEST(NotesCamera, AndNotWhereCIsAnotherNumber) {
  const glm::dvec3 eye(0, 0, 4), center(0, 0, 0), p(0.5, 0.25, 2);
  struct Off {
    double c, tiny, gl;  // x in pixels
  };
  // x_ndc = x c / (c - z) by 002, x c / (4 - z) from the eye: 0.4, 20 and 533 pixels apart.
  for (const Off& off : {Off{4.002, 400 + 400 * 0.5 * 4.002 / 2.002, 400 + 400 * 0.5 * 4.002 / 2},
                         Off{4.1, 400 + 400 * 0.5 * 4.1 / 2.1, 400 + 400 * 0.5 * 4.1 / 2},
                         Off{8, 400 + 400 * 0.5 * 8 / 6, 400 + 400 * 0.5 * 8 / 2}}) {
    EXPECT_NEAR(tiny_pixel(off.c, eye, center, p).x, off.tiny, 1e-12);
    EXPECT_NEAR(gl_pixel(off.c, eye, center, p).x, off.gl, 1e-12);
  }
  EXPECT_NEAR(gl_pixel(4.002, eye, center, p).x - tiny_pixel(4.002, eye, center, p).x, 0.4, 1e-3);
  EXPECT_NEAR(gl_pixel(4.1, eye, center, p).x - tiny_pixel(4.1, eye, center, p).x, 19.52, 5e-3);
  EXPECT_NEAR(gl_pixel(8, eye, center, p).x - tiny_pixel(8, eye, center, p).x, 533.33, 5e-3);
  // Only `center` stays. It is a right picture still, of an eye that is moved along the view to distance c.
  EXPECT_EQ(tiny_pixel(8, eye, center, center), gl_pixel(8, eye, center, center));
  EXPECT_LE(glm::distance(tiny_pixel(8, eye, center, p), gl_pixel(8, {0, 0, 8}, center, p)), 1e-12);
}

// Class notes (004): X_iw puts c at the origin, X_pi's eye is at (0, 0, -d): the eye is d behind "camera position c".
TEST(NotesCamera, TheEyeIsDBehindC) {
  const glm::dvec3 c(0, 0, -5), l(0, 0, 0), up(0, 1, 0), p(0, 1, 0);
  for (const double fov : {kQuarterTurn, 35 * kQuarterTurn / 90}) {
    const double d = gzrender::d_of_fov(fov);
    const glm::dmat4 view = gzrender::x_pi(d) * gzrender::x_iw(c, l, up);
    // What goes to w = 0 and x = y = 0 is the eye.
    const glm::dvec4 eye = gzrender::x_wi(c, l, up) * glm::dvec4(0, 0, -d, 1);
    EXPECT_EQ(glm::dvec3(eye), glm::dvec3(0, 0, -5 - d));
    EXPECT_NEAR((view * eye).w, 0, 1e-15);
    EXPECT_EQ((view * glm::dvec4(c, 1)).w, 1) << "c is on the view plane, not in the eye";
    // So it is GL's camera of the same angle at c - d Z, and not the one at c.
    const glm::dmat4 lens = gl::perspective({fov, 1}, 0.1, 100);
    const double by_notes = seen(view, p).y, from_eye = seen(lens * gl::look_at(eye, l, up), p).y;
    const double from_c = seen(lens * gl::look_at(c, l, up), p).y;
    EXPECT_NEAR(by_notes, from_eye, 1e-15);
    EXPECT_NEAR(by_notes, d / (5 + d), 1e-15);
    EXPECT_NEAR(from_c, d / 5, 1e-15);
  }
  // 90 degrees, 256 pixels high: row 106.67 by the notes, 102.4 from c. At GzRender's 35 degrees 78.32 and 46.81: d
  // is 3.17.
  const auto row = [&](double y) { return 128 - 128 * y; };
  const double d = gzrender::d_of_fov(35 * kQuarterTurn / 90);
  EXPECT_NEAR(row(1.0 / 6) - row(1.0 / 5), 4.27, 5e-3);
  EXPECT_NEAR(row(d / (5 + d)) - row(d / 5), 31.51, 5e-3);
}

}  // namespace
}  // namespace plumbline::transforms
