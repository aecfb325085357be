// Properties of the notes' transforms on random numbers. Bounds follow from how far an entry is off: in a million
// inputs to the table of the same formulas (transforms_table_test.cpp) it was never more than 4.8 ULP of the largest
// term, and an ULP of x is at most 2^-52 |x|.
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/property/random_scene.h"
#include "transforms/look_at.h"
#include "transforms/normal.h"
#include "transforms/projection.h"
#include "transforms/transform.h"
#include "transforms/viewport.h"

namespace plumbline {
namespace {

namespace tf = transforms;

constexpr double kUlp = 0x1p-52, kEntry = 5 * kUlp;

double number(double least, double most) {
  return least + (most - least) * *test::evenly(0, 4097) / 4096;  // its ends and middle among them
}
glm::dvec3 point(double reach) {
  const double x = number(-reach, reach), y = number(-reach, reach);
  return {x, y, number(-reach, reach)};
}
glm::dvec3 direction() {
  const glm::dvec3 v = point(4);
  return v == glm::dvec3(0) ? glm::dvec3(0, 0, 1) : v;
}
double angle() { return number(-2, 2) * 3.141592653589793; }
glm::dvec3 factors() {
  const double x = std::exp2(number(-6, 6)), y = -std::exp2(number(-6, 6));
  return {x, y, std::exp2(number(-6, 6))};
}

double largest(const glm::dmat4& m) {
  double out = 0;
  for (int i = 0; i < 16; ++i) out = std::max(out, std::abs(m[i / 4][i % 4]));
  return out;
}

// a b = 1, where each entry of a is off by kEntry times a's largest term at the most, each of b likewise, and four
// products are added up. `terms`: how much larger than the entries the terms are.
void require_inverse(const glm::dmat4& a, const glm::dmat4& b, double terms = 1) {
  const glm::dmat4 product = a * b;
  const double in_a = kEntry * terms * largest(a), in_b = kEntry * terms * largest(b);
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      double bound = 0;
      for (int k = 0; k < 4; ++k) {
        const double x = std::abs(a[k][r]), y = std::abs(b[c][k]);
        bound += in_a * y + x * in_b + 2 * kUlp * x * y;
      }
      const double off = std::abs(product[c][r] - (r == c ? 1 : 0));
      if (!(off <= bound)) RC_FAIL(fmt::format("row {}, column {}: {} off, bound {}", r, c, off, bound));
    }
  }
}

RC_GTEST_PROP(Transforms, TimesTheirInverseAreTheIdentity, ()) {
  const glm::dvec3 t = point(100), s = factors(), axis = direction(), p = point(1);
  const double a = angle();
  require_inverse(tf::translation(t), tf::inverse_translation(t));
  require_inverse(tf::scaling(s), tf::inverse_scaling(s));
  require_inverse(tf::rotation_x(a), tf::inverse_rotation_x(a));
  require_inverse(tf::rotation_y(a), tf::inverse_rotation_y(a));
  require_inverse(tf::rotation_z(a), tf::inverse_rotation_z(a));
  require_inverse(tf::rotation(a, axis), tf::inverse_rotation(a, axis));
  require_inverse(tf::rotation_by_basis(a, axis), tf::inverse_rotation_by_basis(a, axis));
  const double two_p = 2 * (1 + glm::length(p));
  require_inverse(tf::orbit_model(p, a, axis), tf::inverse_orbit_model(p, a, axis), two_p);
}

struct View {
  glm::dvec3 eye, center, up;
  double sine;  ///< of the angle between the view and up
};

View view() {
  View v{point(10), {}, direction(), 0};
  const glm::dvec3 ahead = direction();
  v.center = v.eye + ahead;
  v.sine = glm::length(glm::cross(glm::normalize(ahead), glm::normalize(v.up)));
  RC_PRE(v.sine > 1.0 / 64);
  return v;
}

RC_GTEST_PROP(Transforms, CamerasTimesTheirInverseAreTheIdentity, ()) {
  const View v = view();
  const auto require = [&](auto there, auto back, const glm::dvec3& center) {
    require_inverse(there(v.eye, center, v.up), back(v.eye, center, v.up), 2 / v.sine);
    require_inverse(back(v.eye, center, v.up), there(v.eye, center, v.up), 2 / v.sine);
  };
  require(tf::gl::look_at, tf::gl::inverse_look_at, v.center);
  require(tf::gzrender::m_cam, tf::gzrender::inverse_m_cam, v.center - v.eye);
  require(tf::gzrender::x_iw, tf::gzrender::x_wi, v.center);
  require(tf::tinyrenderer::lookat, tf::tinyrenderer::inverse_lookat, v.center);
  const glm::dvec3 p = point(10), axis = direction();
  const double a = angle(), terms = 2 / v.sine + 2 * glm::length(p);
  require_inverse(tf::orbit_camera(tf::gzrender::x_iw(v.eye, v.center, v.up), p, a, axis),
                  tf::inverse_orbit_camera(tf::gzrender::x_wi(v.eye, v.center, v.up), p, a, axis), terms);
}

struct Volume {
  double l, r, b, t, n, f;
};

Volume volume() {
  const double n = std::exp2(number(-7, 3)), l = n * number(-4, 4), b = n * number(-4, 4);
  const double r = l + n * std::exp2(number(-3, 3)), t = b + n * std::exp2(number(-3, 3));
  return {l, r, b, t, n, n * (1 + std::exp2(number(-3, 14)))};
}

tf::FieldOfView field_of_view() { return {number(0.01, 0.99) * 3.141592653589793, std::exp2(number(-2, 2))}; }

RC_GTEST_PROP(Transforms, ProjectionsAndWindowsTimesTheirInverseAreTheIdentity, ()) {
  const Volume v = volume();
  const tf::FieldOfView f = field_of_view();
  const double d = std::exp2(number(-4, 6));
  const double x = *test::evenly(-99, 99), y = *test::evenly(-99, 99), w = *test::evenly(1, 16385);
  const double h = *test::evenly(1, 16385), depth = *test::evenly(1, 1 << 24);
  require_inverse(tf::gl::frustum(v.l, v.r, v.b, v.t, v.n, v.f), tf::gl::inverse_frustum(v.l, v.r, v.b, v.t, v.n, v.f));
  require_inverse(tf::gl::orthographic(v.l, v.r, v.b, v.t, v.n, v.f),
                  tf::gl::inverse_orthographic(v.l, v.r, v.b, v.t, v.n, v.f));
  require_inverse(tf::gl::perspective(f, v.n, v.f), tf::gl::inverse_perspective(f, v.n, v.f));
  require_inverse(tf::games101::orthographic(v.l, v.r, v.b, v.t, -v.n, -v.f),
                  tf::games101::inverse_orthographic(v.l, v.r, v.b, v.t, -v.n, -v.f));
  require_inverse(tf::games101::persp_to_ortho(-v.n, -v.f), tf::games101::inverse_persp_to_ortho(-v.n, -v.f));
  require_inverse(tf::games101::perspective(f, -v.n, -v.f), tf::games101::inverse_perspective(f, -v.n, -v.f));
  require_inverse(tf::gzrender::x_pi(d), tf::gzrender::inverse_x_pi(d));
  require_inverse(tf::tinyrenderer::projection(d), tf::tinyrenderer::inverse_projection(d));
  require_inverse(tf::gzrender::x_sp(w, h, depth), tf::gzrender::inverse_x_sp(w, h, depth));
  require_inverse(tf::games101::viewport(w, h), tf::games101::inverse_viewport(w, h));
  require_inverse(tf::tinyrenderer::viewport(x, y, w, h, depth), tf::tinyrenderer::inverse_viewport(x, y, w, h, depth));
}

RC_GTEST_PROP(Transforms, RotationsAreOrthonormalOfDeterminantOne, ()) {
  const double a = angle();
  const glm::dvec3 axis = direction();
  for (const glm::dmat4& r : {tf::rotation_x(a), tf::rotation_y(a), tf::rotation_z(a), tf::rotation(a, axis),
                              tf::rotation_by_basis(a, axis)}) {
    require_inverse(glm::transpose(r), r);
    // Nine entries, each times a cofactor that is at most 1; then some twelve roundings of terms that are at most 1.
    RC_ASSERT(std::abs(glm::determinant(glm::dmat3(r)) - 1) <= 9 * kEntry + 12 * kUlp);
  }
}

RC_GTEST_PROP(Transforms, TheInverseRotationIsTheTransposeAndTheRotationBackBitForBit, ()) {
  const double a = angle();
  const glm::dvec3 axis = direction();
  RC_ASSERT(tf::inverse_rotation(a, axis) == glm::transpose(tf::rotation(a, axis)));
  RC_ASSERT(tf::inverse_rotation(a, axis) == tf::rotation(-a, axis));
  RC_ASSERT(tf::inverse_rotation_x(a) == tf::rotation_x(-a));
  RC_ASSERT(tf::inverse_rotation_y(a) == tf::rotation_y(-a));
  RC_ASSERT(tf::inverse_rotation_z(a) == tf::rotation_z(-a));
}

// 004 3.1: "commutative property is for S, R only. Here assume uniform scaling".
RC_GTEST_PROP(Transforms, AUniformScalingCommutesWithARotationBitForBit, ()) {
  const glm::dmat4 s = tf::scaling(glm::dvec3(number(-8, 8))), r = tf::rotation(angle(), direction());
  RC_ASSERT(s * r == r * s);
}
RC_GTEST_PROP(Transforms, ANonUniformScalingDoesNot, ()) {
  const double a = angle(), x = number(1, 4), y = number(5, 8);
  RC_PRE(std::abs(std::sin(a)) > 1e-3);
  const glm::dmat4 s = tf::scaling({x, y, 1}), r = tf::rotation_z(a);
  // What +x becomes is (x cos, y sin) the one way and (x cos, x sin) the other.
  const double apart = (s * r)[0][1] - (r * s)[0][1];
  RC_ASSERT(std::abs(apart - (y - x) * std::sin(a)) <= 3 * 8 * kUlp);
  RC_ASSERT(std::abs(apart) > 1e-3);
}

RC_GTEST_PROP(Transforms, FieldOfViewAndNearPlaneGoBothWays, ()) {
  const tf::FieldOfView f = field_of_view();
  const double n = std::exp2(number(-7, 3));
  const tf::FieldOfView again = tf::field_of_view(tf::near_plane(f, -n), n);
  // Tangent, product, quotient, arc tangent: 3 ULP; the arc tangent makes none of it larger.
  RC_ASSERT(std::abs(again.fov_y - f.fov_y) <= 4 * kUlp * f.fov_y);
  RC_ASSERT(std::abs(again.aspect - f.aspect) <= kUlp * f.aspect);
  const double d = std::exp2(number(-4, 6));
  // The angle is off by 2 ULP, d by (1 + d^2) / 2 times that, and by the tangent's and the quotient's ULP.
  const double fov = tf::gzrender::fov_of_d(d);
  RC_ASSERT(std::abs(tf::gzrender::d_of_fov(fov) - d) <= kUlp * (2 * d + (1 + d * d) * fov));
  // The two ways to a perspective.
  const tf::NearPlane p = tf::near_plane(f, n);
  const glm::dmat4 by_plane = tf::gl::frustum(p.left, p.right, p.bottom, p.top, n, 3 * n);
  const glm::dmat4 by_view = tf::gl::perspective(f, n, 3 * n);
  for (int i = 0; i < 16; ++i) {
    const double theirs = by_view[i / 4][i % 4];
    RC_ASSERT(std::abs(by_plane[i / 4][i % 4] - theirs) <= 2 * kEntry * std::abs(theirs));
  }
}

RC_GTEST_PROP(Transforms, AnOrbitKeepsTheDistanceToItsPoint, ()) {
  const glm::dvec3 p = point(10), q = point(10), axis = direction();
  const double a = angle();
  const glm::dvec3 there(tf::orbit_model(p, a, axis) * glm::dvec4(q, 1));
  // A coordinate: three entries of R, one of the translation; their products' roundings.
  const double bound = 2 * (kEntry + 2 * kUlp) * (3 * glm::length(q) + 2 * (1 + glm::length(p)));
  RC_ASSERT(std::abs(glm::distance(there, p) - glm::distance(q, p)) <= bound);
  const glm::dvec3 on_axis = p + 2.0 * axis;
  const glm::dvec3 kept(tf::orbit_model(p, a, axis) * glm::dvec4(on_axis, 1));
  RC_ASSERT(glm::distance(kept, on_axis) <=
            2 * (kEntry + 2 * kUlp) * (3 * glm::length(on_axis) + 2 * (1 + glm::length(p))));
}

// The camera goes round the point, and sees it where it saw it before.
RC_GTEST_PROP(Transforms, AnOrbitingCameraKeepsItsViewOfThePoint, ()) {
  const View v = view();
  const glm::dvec3 p = point(10), axis = direction();
  const double a = angle();
  const glm::dmat4 before = tf::gl::look_at(v.eye, v.center, v.up), after = tf::orbit_camera(before, p, a, axis);
  const double reach = 1 + glm::length(p) + glm::length(v.eye);
  const double bound = 12 * (kEntry + 2 * kUlp) * reach;
  RC_ASSERT(glm::distance(glm::dvec3(after * glm::dvec4(p, 1)), glm::dvec3(before * glm::dvec4(p, 1))) <= bound);
  // Equal to the world turned the other way.
  const glm::dvec3 q = point(10);
  const glm::dvec4 turned_back = tf::inverse_orbit_model(p, a, axis) * glm::dvec4(q, 1);
  RC_ASSERT(glm::distance(after * glm::dvec4(q, 1), before * turned_back) <= bound + 12 * kUlp * 20 * reach);
}

// 004 3.2: (x, y, z', w) = (X, Y, Z/d, Z/d + 1) = X_pi (X, Y, Z, 1).
RC_GTEST_PROP(Transforms, XPiIsWhatTheNotesClaim, ()) {
  const glm::dvec3 p = point(100);
  const double d = std::exp2(number(-4, 6));
  const glm::dvec4 q = tf::gzrender::x_pi(d) * glm::dvec4(p, 1);
  RC_ASSERT(q.x == p.x && q.y == p.y);
  RC_ASSERT(std::abs(q.z - p.z / d) <= 1.5 * kUlp * std::abs(p.z / d));
  RC_ASSERT(q.w == q.z + 1);
  if (p.z == 0) RC_ASSERT(q.z == 0);
  if (p.z > 0) RC_ASSERT(q.z / q.w > 0 && q.z / q.w < 1);
  if (p.z < 0 && p.z > -d) RC_ASSERT(q.w > 0 && q.z / q.w < 0);
}

RC_GTEST_PROP(Transforms, WindowsTakeTheCubesCornersToTheScreens, ()) {
  const double x = *test::evenly(-99, 99), y = *test::evenly(-99, 99), w = *test::evenly(1, 16385);
  const double h = *test::evenly(1, 16385), depth = *test::evenly(1, 1 << 24);
  const auto at = [](const glm::dmat4& m, glm::dvec3 p) { return glm::dvec3(m * glm::dvec4(p, 1)); };
  const glm::dmat4 x_sp = tf::gzrender::x_sp(w, h, depth), m_viewport = tf::games101::viewport(w, h);
  const glm::dmat4 tiny = tf::tinyrenderer::viewport(x, y, w, h, depth);
  RC_ASSERT(at(x_sp, {-1, 1, 0}) == glm::dvec3(0, 0, 0));  // the upper left corner, on the view plane
  RC_ASSERT(at(x_sp, {1, -1, 1}) == glm::dvec3(w, h, depth));
  RC_ASSERT(at(m_viewport, {-1, -1, -1}) == glm::dvec3(0, 0, -1));
  RC_ASSERT(at(m_viewport, {1, 1, 1}) == glm::dvec3(w, h, 1));
  RC_ASSERT(at(tiny, {-1, -1, -1}) == glm::dvec3(x, y, 0));
  RC_ASSERT(at(tiny, {1, 1, 1}) == glm::dvec3(x + w, y + h, depth));
}

RC_GTEST_PROP(Transforms, ProjectionsTakeTheVolumesCornersToTheCubes, ()) {
  const Volume v = volume();
  const auto at = [](const glm::dmat4& m, glm::dvec3 p) {
    const glm::dvec4 q = m * glm::dvec4(p, 1);
    return glm::dvec3(q) / q.w;
  };
  // Of the two terms of a coordinate neither is larger, over w, than 1.5 `terms`, and each is off by kEntry and its
  // product's and quotient's roundings.
  const auto require = [&](const glm::dvec3& is, const glm::dvec3& expected, double terms) {
    const glm::dvec3 off = glm::abs(is - expected);
    const double bound = 3 * kEntry * terms;
    if (!(std::max({off.x, off.y, off.z}) <= bound)) RC_FAIL(fmt::format("{} {} {} > {}", off.x, off.y, off.z, bound));
  };
  const double k = v.f / v.n;  // the far plane is so many times larger
  const double terms =
      1 + 2 * std::max((std::abs(v.l) + std::abs(v.r)) / (v.r - v.l), (std::abs(v.b) + std::abs(v.t)) / (v.t - v.b)) +
      2 * (v.f + v.n) / (v.f - v.n);
  const glm::dmat4 frustum = tf::gl::frustum(v.l, v.r, v.b, v.t, v.n, v.f);
  const glm::dmat4 box = tf::gl::orthographic(v.l, v.r, v.b, v.t, v.n, v.f);
  const glm::dmat4 cuboid = tf::games101::orthographic(v.l, v.r, v.b, v.t, -v.n, -v.f);
  const glm::dmat4 both = cuboid * tf::games101::persp_to_ortho(-v.n, -v.f);
  require(at(frustum, {v.l, v.b, -v.n}), {-1, -1, -1}, terms);
  require(at(frustum, {v.r * k, v.t * k, -v.f}), {1, 1, 1}, terms);
  require(at(box, {v.l, v.b, -v.n}), {-1, -1, -1}, terms);
  require(at(box, {v.r, v.t, -v.f}), {1, 1, 1}, terms);
  require(at(cuboid, {v.l, v.b, -v.n}), {-1, -1, 1}, terms);
  require(at(cuboid, {v.r, v.t, -v.f}), {1, 1, -1}, terms);
  require(at(both, {v.l, v.b, -v.n}), {-1, -1, 1}, 2 * terms);
  require(at(both, {v.r * k, v.t * k, -v.f}), {1, 1, -1}, 2 * terms);
}

RC_GTEST_PROP(Transforms, NormalsStayAtRightAnglesToTheirPlane, ()) {
  const glm::dmat4 m = tf::scaling(factors()) * tf::rotation(angle(), direction()) * tf::scaling(factors());
  const glm::dvec3 in_plane = direction(), other = direction(), n = glm::cross(in_plane, other);
  const glm::dvec3 there = glm::dmat3(m) * in_plane, n_there = tf::normal_matrix(m) * n;
  // A cofactor is off by 1.5 ULP of the product of two columns' lengths; sums and products of three cost as much again
  // each; the determinant is common to all. 7 ULP of the terms in all.
  const double x = glm::length(m[0]), y = glm::length(m[1]), z = glm::length(m[2]);
  const double normal_terms = (y * z * std::abs(n.x) + z * x * std::abs(n.y) + x * y * std::abs(n.z)) /
                              std::abs(glm::determinant(glm::dmat3(m)));
  double point_terms = 0;
  for (int i = 0; i < 9; ++i) point_terms += std::abs(m[i / 3][i % 3] * in_plane[i / 3]);
  RC_ASSERT(std::abs(glm::dot(there, n_there)) <= 7 * kUlp * point_terms * normal_terms);
  RC_ASSERT(glm::length(n_there) > 0 || n == glm::dvec3(0));
}

// 000's u v w and 004's Gram-Schmidt are one camera; GL's is the same with x and z turned round.
RC_GTEST_PROP(Transforms, TheCamerasOfTheNotesAreOneCamera, ()) {
  const View v = view();
  const glm::dmat4 x_iw = tf::gzrender::x_iw(v.eye, v.center, v.up);
  const glm::dmat4 m_cam = tf::gzrender::m_cam(v.eye, v.center - v.eye, v.up);
  const glm::dmat4 glu = tf::gl::look_at(v.eye, v.center, v.up);
  const glm::dmat4 lookat = tf::tinyrenderer::lookat(v.eye, v.center, v.up);
  const double c = glm::distance(v.eye, v.center), reach = 1 + glm::length(v.eye) + c;
  const double bound = 4 * kEntry * reach / v.sine;
  RC_ASSERT(largest(m_cam - x_iw) <= bound);
  RC_ASSERT(largest(glu - tf::scaling({-1, 1, -1}) * x_iw) <= bound);
  RC_ASSERT(largest(lookat - tf::translation({0, 0, c}) * glu) <= bound);
}

}  // namespace
}  // namespace plumbline
