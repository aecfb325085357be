// The formulas of the notes that are matrices, ours in double, beside GLM's functions of the same meaning in a wider
// format: here models, cameras, windows and normals; projections_table_test.cpp has the projections. The largest
// difference allowed is 4 ULP: of each entry where it is a quotient of a few sums, of the largest entry or term where
// terms cancel. Where the result is rounded once, it is half an ULP; where it is not rounded, 0. Of the roundings of a
// rotation about an axis the worst could add up to 10.5 (cross/osmesa/transforms_test.cpp); in a million inputs 4.8 is
// seen.
#include <gtest/gtest-spi.h>

#include <glm/gtc/matrix_inverse.hpp>

#include "tests/cross/transforms_table.h"
#include "transforms/look_at.h"
#include "transforms/normal.h"
#include "transforms/transform.h"
#include "transforms/viewport.h"

namespace plumbline::test {
namespace {

namespace tf = transforms;

std::vector<Row> transform_rows() {
  const auto size = [](Inputs& r) {
    const double x = r.of_any_size(1e-6, 1e6), y = r.of_any_size(1e-6, 1e6);
    return glm::dvec3(x, y, r.of_any_size(1e-6, 1e6));
  };
  const auto angle = [](Inputs& r) { return r.between(-2 * kTurn, 2 * kTurn); };
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  using Turn = glm::dmat4 (*)(double);
  const auto about = [=](const char* formula, const char* ours, Turn turn, const char* reference, double sign,
                         glm::dvec3 axis) {
    return row(formula, ours, reference, 1, [=](Inputs& r) {  // the sine's error, under an ULP
      const double a = angle(r);
      return by_largest(turn(a), turned(sign * a, axis));
    });
  };
  return {
      row("T (004 3.1)", "translation", "translate", 0,
          [=](Inputs& r) {
            const auto t = size(r);
            return by_entry(tf::translation(t), moved(t));
          }),
      row("T^-1", "inverse_translation", "inverse(translate)", 0,
          [=](Inputs& r) {
            const auto t = size(r);
            return by_entry(tf::inverse_translation(t), glm::inverse(moved(t)));
          }),
      row("S (004 3.1)", "scaling", "scale", 0,
          [=](Inputs& r) {
            const auto s = size(r);
            return by_entry(tf::scaling(s), scaled(s));
          }),
      row("S^-1", "inverse_scaling", "inverse(scale)", 0.51,  // the reference's own rounding on top
          [=](Inputs& r) {
            const auto s = size(r);
            return by_entry(tf::inverse_scaling(s), glm::inverse(scaled(s)));
          }),
      about("R_x (000, 004 3.1)", "rotation_x", tf::rotation_x, "rotate", 1, x),
      about("R_y (000, 004 3.1)", "rotation_y", tf::rotation_y, "rotate", 1, y),
      about("R_z (000, 004 3.1)", "rotation_z", tf::rotation_z, "rotate", 1, z),
      about("R_x^-1 = R_x^T", "inverse_rotation_x", tf::inverse_rotation_x, "rotate(-angle)", -1, x),
      about("R_y^-1 = R_y^T", "inverse_rotation_y", tf::inverse_rotation_y, "rotate(-angle)", -1, y),
      about("R_z^-1 = R_z^T", "inverse_rotation_z", tf::inverse_rotation_z, "rotate(-angle)", -1, z),
  };
}

std::vector<Row> axis_rows() {
  using Turn = glm::dmat4 (*)(double, const glm::dvec3&);
  using Orbit = glm::dmat4 (*)(const glm::dvec3&, double, const glm::dvec3&);
  const auto angle = [](Inputs& r) { return r.between(-kTurn, kTurn); };
  const auto about = [=](const char* formula, const char* ours, Turn turn, const char* reference, double sign) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const double a = angle(r);
      const auto axis = r.direction(10);
      return by_largest(turn(a, axis), turned(sign * a, axis));
    });
  };
  const auto orbit = [=](const char* formula, const char* ours, Orbit around, const char* reference, double sign) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const double a = angle(r);
      const auto p = r.point(10), axis = r.direction(10);
      // In p - R p both may cancel.
      return by_largest(around(p, a, axis), moved(p) * turned(sign * a, axis) * moved(-p), 2 * glm::length(p));
    });
  };
  // The camera at e looks along g; it is turned, and looks again from where it then is.
  const auto camera = [=](const char* formula, const char* ours, const char* reference, bool inverse) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const double a = angle(r);
      const auto e = r.point(10), p = r.point(10), axis = r.direction(10);
      const glm::dvec3 l = e + glm::dvec3(1, 0, 0), up(0, 1, 0);
      const WideMat4 o = moved(p) * turned(a, axis) * moved(-p);
      const auto at = [&](const glm::dvec3& v, Wide w) { return WideVec3(o * glm::vec<4, Wide>(wide(v), w)); };
      const WideMat4 there = glm::lookAtLH(at(e, 1), at(l, 1), at(up, 0));
      const double terms = glm::length(e) + 2 * glm::length(p);
      return inverse ? by_largest(tf::inverse_orbit_camera(tf::gzrender::x_wi(e, l, up), p, a, axis),
                                  glm::inverse(there), terms)
                     : by_largest(tf::orbit_camera(tf::gzrender::x_iw(e, l, up), p, a, axis), there, terms);
    });
  };
  return {
      about("R about an axis (Rodrigues)", "rotation", tf::rotation, "rotate", 1),
      about("R^-1 = R^T", "inverse_rotation", tf::inverse_rotation, "rotate(-angle)", -1),
      about("R by a basis (004 3.3.8)", "rotation_by_basis", tf::rotation_by_basis, "rotate", 1),
      about("its inverse", "inverse_rotation_by_basis", tf::inverse_rotation_by_basis, "rotate(-angle)", -1),
      orbit("orbit of a model (004 3.3.9)", "orbit_model", tf::orbit_model, "translate rotate translate", 1),
      orbit("its inverse", "inverse_orbit_model", tf::inverse_orbit_model, "translate rotate(-angle) translate", -1),
      camera("orbit of a camera (004 3.3.9)", "orbit_camera", "lookAtLH of the turned eye", false),
      camera("its inverse", "inverse_orbit_camera", "inverse(lookAtLH of the turned eye)", true),
  };
}

struct View {
  glm::dvec3 eye, center, up;
  double sine;  ///< of the angle between the view and up
};

View view(Inputs& r) {
  for (;;) {
    const auto eye = r.point(10), direction = r.direction(10), up = r.direction(10);
    const double sine = glm::length(glm::cross(glm::normalize(direction), glm::normalize(up)));
    if (sine > 1.0 / 64) return {eye, eye + direction, up, sine};
  }
}

// A normal to two directions has 1/sine of their relative error, sine being that of their angle: only more digits
// help.
double magnitude(const View& v) { return std::max(1.0, glm::length(v.eye)) / v.sine; }

using LookAt = glm::dmat4 (*)(const glm::dvec3&, const glm::dvec3&, const glm::dvec3&);
using WideLookAt = WideMat4 (*)(const View&);

Row look_at_row(const char* formula, const char* ours, LookAt look_at, const char* reference, WideLookAt theirs,
                double terms = 1) {
  return row(formula, ours, reference, 4, [=](Inputs& r) {
    const View v = view(r);
    return by_largest(look_at(v.eye, v.center, v.up), theirs(v), terms * magnitude(v));
  });
}

WideMat4 rh(const View& v) { return glm::lookAtRH(wide(v.eye), wide(v.center), wide(v.up)); }
WideMat4 lh(const View& v) { return glm::lookAtLH(wide(v.eye), wide(v.center), wide(v.up)); }
// 000 is given the gaze: here it is what the others call the centre.
WideMat4 lh_along(const View& v) { return glm::lookAtLH(wide(v.eye), wide(v.eye) + wide(v.center), wide(v.up)); }
WideMat4 centered(const View& v) {
  const WideVec3 eye_centered(0, 0, glm::distance(wide(v.eye), wide(v.center)));
  return glm::translate(kOne, eye_centered) * rh(v);
}

std::vector<Row> look_at_rows() {
  // A gaze of its own, as far from up as the view is.
  const auto gaze = [](const char* formula, const char* ours, LookAt look_at, const char* reference,
                       WideLookAt theirs) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      View v = view(r);
      v.center -= v.eye;
      return by_largest(look_at(v.eye, v.center, v.up), theirs(v), magnitude(v));
    });
  };
  return {
      gaze("M_cam u v w (000)", "gzrender::m_cam", tf::gzrender::m_cam, "lookAtLH", lh_along),
      gaze("M_cam^-1", "gzrender::inverse_m_cam", tf::gzrender::inverse_m_cam, "inverse(lookAtLH)",
           [](const View& v) { return glm::inverse(lh_along(v)); }),
      look_at_row("lookat (002)", "tinyrenderer::lookat", tf::tinyrenderer::lookat, "translate(0, 0, c) lookAtRH",
                  centered),
      look_at_row("its inverse", "tinyrenderer::inverse_lookat", tf::tinyrenderer::inverse_lookat,
                  "inverse(translate(0, 0, c) lookAtRH)", [](const View& v) { return glm::inverse(centered(v)); }),
      // Gram-Schmidt: where Z's length is off by e, 2 e of Z stay in Y.
      look_at_row("X_iw (004 3.3)", "gzrender::x_iw", tf::gzrender::x_iw, "lookAtLH", lh, 2),
      look_at_row(
          "X_wi (004 3.3)", "gzrender::x_wi", tf::gzrender::x_wi, "inverse(lookAtLH)",
          [](const View& v) { return glm::inverse(lh(v)); }, 2),
      look_at_row("gluLookAt", "gl::look_at", tf::gl::look_at, "lookAtRH", rh),
      look_at_row("its inverse", "gl::inverse_look_at", tf::gl::inverse_look_at, "inverse(lookAtRH)",
                  [](const View& v) { return glm::inverse(rh(v)); }),
  };
}

std::vector<Row> window_rows() {
  const auto pixels = [](Inputs& r) { return std::floor(r.between(1, 16385)); };
  constexpr double kMaxInt = 2147483647.0;
  const auto centered = [](double w, double h, const glm::dvec3& by) { return moved({w / 2, h / 2, 0}) * scaled(by); };
  return {
      row("X_sp (000, 004 3.2)", "gzrender::x_sp", "translate scale", 0,
          [=](Inputs& r) {
            const double xs = pixels(r), ys = pixels(r);
            return by_entry(tf::gzrender::x_sp(xs, ys, kMaxInt), centered(xs, ys, {xs / 2, -ys / 2, kMaxInt}));
          }),
      row("X_sp^-1", "gzrender::inverse_x_sp", "inverse(translate scale)", 0.51,
          [=](Inputs& r) {
            const double xs = pixels(r), ys = pixels(r);
            return by_entry(tf::gzrender::inverse_x_sp(xs, ys, kMaxInt),
                            glm::inverse(centered(xs, ys, {xs / 2, -ys / 2, kMaxInt})));
          }),
      row("M_viewport (001)", "games101::viewport", "translate scale", 0,
          [=](Inputs& r) {
            const double w = pixels(r), h = pixels(r);
            return by_entry(tf::games101::viewport(w, h), centered(w, h, {w / 2, h / 2, 1}));
          }),
      row("its inverse", "games101::inverse_viewport", "inverse(translate scale)", 0.51,
          [=](Inputs& r) {
            const double w = pixels(r), h = pixels(r);
            return by_entry(tf::games101::inverse_viewport(w, h), glm::inverse(centered(w, h, {w / 2, h / 2, 1})));
          }),
      row("viewport (002)", "tinyrenderer::viewport", "translate scale translate", 0,
          [=](Inputs& r) {
            const double x = pixels(r), y = pixels(r), w = pixels(r), h = pixels(r);
            return by_entry(tf::tinyrenderer::viewport(x, y, w, h, 255),
                            moved({x, y, 0}) * scaled({w / 2, h / 2, 127.5}) * moved({1, 1, 1}));
          }),
      row("its inverse", "tinyrenderer::inverse_viewport", "inverse(translate scale translate)", 0.51,
          [=](Inputs& r) {
            const double x = pixels(r), y = pixels(r), w = pixels(r), h = pixels(r);
            return by_entry(tf::tinyrenderer::inverse_viewport(x, y, w, h, 255),
                            glm::inverse(moved({x, y, 0}) * scaled({w / 2, h / 2, 127.5}) * moved({1, 1, 1})));
          }),
      row("normals (002)", "normal_matrix", "inverseTranspose", 4,
          [](Inputs& r) {
            const glm::dvec3 before = r.direction(1), after = r.direction(1);
            const double x = r.of_any_size(0.5, 2), y = r.of_any_size(0.5, 2);
            const glm::dmat3 m(tf::rotation(1, after) * tf::scaling({x, y, 1}) * tf::rotation(2, before));
            // The products that are subtracted in a cofactor, over the determinant.
            const double longest = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
            const double terms = longest * longest / std::abs(glm::determinant(m));
            return by_largest(tf::normal_matrix(glm::dmat4(m)), glm::inverseTranspose(glm::mat<3, 3, Wide>(m)), terms);
          }),
      row("their inverse", "inverse_normal_matrix", "transpose", 0,
          [](Inputs& r) {
            glm::dmat4 m(1);
            for (int i = 0; i < 3; ++i) m[i] = glm::dvec4(r.point(10), 0);
            return by_entry(tf::inverse_normal_matrix(m), glm::transpose(glm::mat<3, 3, Wide>(m)));
          }),
  };
}

// The other way: what is wrong is beyond its bound, and by far.
TEST(TransformsTable, NamesASlipOfTheNotes) {
  // 000: "v = w x v", where v is what up was taken for.
  const LookAt as_printed = [](const glm::dvec3& e, const glm::dvec3& g, const glm::dvec3& t) {
    const glm::dvec3 w = glm::normalize(g), u = glm::normalize(glm::cross(t, w)), v = glm::cross(w, t);
    glm::dmat4 m(1);
    for (int i = 0; i < 3; ++i) m[i] = {u[i], v[i], w[i], 0};
    m[3] = {-glm::dot(u, e), -glm::dot(v, e), -glm::dot(w, e), 1};
    return m;
  };
  static const Row wrong[] = {look_at_row("v = w x v (000, as printed)", "", as_printed, "lookAtLH", lh)};
  EXPECT_NONFATAL_FAILURE(expect_table(wrong), "v = w x v");
  EXPECT_TRUE(holds(look_at_row("v = w x u", "", tf::gzrender::x_iw, "", lh, 2)));
}

TEST(TransformsTable, NamesAnErrorOfAFewUlp) {
  const auto off_by = [](double ulp) {
    return row("", "", "", 4, [=](Inputs& r) {
      const double x = r.of_any_size(1e-3, 1e3);
      const double unit = std::ldexp(1.0, std::ilogb(x) - 52);
      return number(x + ulp * unit, x);
    });
  };
  EXPECT_EQ(largest_difference(off_by(0)), 0);
  EXPECT_EQ(largest_difference(off_by(3)), 3);
  EXPECT_TRUE(holds(off_by(4)));
  EXPECT_FALSE(holds(off_by(5)));
}

TEST(TransformsTable, NamesWhatIsNoNumber) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto of = [](double ours, double theirs) {
    return row("", "", "", 4, [=](Inputs&) { return Entries{{ours, theirs, 1}}; });
  };
  EXPECT_TRUE(holds(of(1, 1)));
  EXPECT_FALSE(holds(of(nan, 1)));
  EXPECT_FALSE(holds(of(1, nan)));
  EXPECT_FALSE(holds(of(nan, nan)));
  EXPECT_FALSE(holds(of(infinity, infinity)));
  EXPECT_FALSE(holds(of(infinity, 1)));
  const Row zero = row("", "", "", 4, [](Inputs&) { return number(1e-300, 0); });
  EXPECT_FALSE(holds(zero)) << "where the reference is 0, so must ours be";
}

TEST(TransformsTable, Transforms) { expect_table(transform_rows()); }
TEST(TransformsTable, AboutAnAxis) { expect_table(axis_rows()); }
TEST(TransformsTable, LookAt) { expect_table(look_at_rows()); }
TEST(TransformsTable, WindowAndNormals) { expect_table(window_rows()); }

}  // namespace
}  // namespace plumbline::test
