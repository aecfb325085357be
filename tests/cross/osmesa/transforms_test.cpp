// The notes' matrices beside OpenGL's own functions, read back. Mesa holds and computes in float, so the unit is a
// float's ULP. One rounding of e may cost u |e|, u = 2^-24, which is at most an ULP of e, and half an ULP of 1. A bound
// allows that many roundings, all at their worst and all in one direction: of the long chains, an axis' and a camera's,
// random inputs see a third and less. What is handed over is a float already, unless it says otherwise.
#include <array>
#include <vector>

#include "reference/osmesa/gl/context.h"
#include "reference/osmesa/gl/matrix_stack.h"
#include "tests/cross/transforms_table.h"
#include "transforms/look_at.h"
#include "transforms/projection.h"
#include "transforms/transform.h"
#include "transforms/viewport.h"

namespace plumbline::test {
namespace {

namespace tf = transforms;

constexpr double kDegree = kTurn / 360;

double as_float(double x) { return static_cast<float>(x); }
glm::dvec3 as_float(const glm::dvec3& v) { return glm::dvec3(glm::vec3(v)); }

glm::dmat4 gl(const std::vector<osmesa::MatrixCall>& calls) {
  static const osmesa::MatrixStack stack(osmesa::make_opengl_context(MesaDriver::llvmpipe));
  return stack.product(calls);
}

Row float_row(const char* formula, const char* ours, const char* reference, double bound,
              std::function<Entries(Inputs&)> input) {
  return {formula, ours, reference, 24, bound, std::move(input)};
}

double degrees(Inputs& r) { return as_float(r.between(-180, 180)); }
glm::dvec3 size(Inputs& r) {
  const double x = r.of_any_size(1e-3, 1e3), y = r.of_any_size(1e-3, 1e3);
  return as_float(glm::dvec3(x, y, r.of_any_size(1e-3, 1e3)));
}
double distance(Inputs& r) { return as_float(std::exp2(r.between(-4, 6))); }
double pixels(Inputs& r) { return std::floor(r.between(1, 16385)); }

std::vector<Row> model_rows() {
  // The largest entry is 1. The angle in radians is rounded, pi u at the most, and its sine and cosine, u each.
  constexpr double kSine = (3.15 + 1) / 2;
  // About an axis, k = 1 - c, c and s the angle's: a component of the unit axis has 3.5 roundings (half of 3 for the
  // sum of squares, its root, the quotient), a product of two 8; k x y has 10, and |k x y + c| <= 1 one more. On the
  // diagonal c's own error counts 1 - x x, so the worst is x x = 1, k = 2; elsewhere less.
  constexpr double kAxisInU = 2 * 10 + 1, kAxis = kAxisInU / 2;
  // p - R p: each entry of R on |p|, then three products and sums.
  constexpr double kOrbit = kAxisInU + 6;
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  using Turn = glm::dmat4 (*)(double);
  const auto about = [=](const char* formula, const char* ours, Turn turn, const char* reference, double sign,
                         glm::dvec3 axis) {
    return float_row(formula, ours, reference, kSine, [=](Inputs& r) {
      const double a = degrees(r);
      return by_largest(turn(a * kDegree), gl({Rotate{sign * a, axis}}));
    });
  };
  using About = glm::dmat4 (*)(double, const glm::dvec3&);
  const auto about_axis = [=](const char* formula, const char* ours, About turn, double sign) {
    return float_row(formula, ours, "glRotate", kAxis, [=](Inputs& r) {
      const double a = degrees(r);
      const auto axis = as_float(r.direction(10));
      return by_largest(turn(a * kDegree, axis), gl({Rotate{sign * a, axis}}));
    });
  };
  return {
      float_row("T (004 3.1)", "translation", "glTranslate", 0,
                [](Inputs& r) {
                  const auto t = size(r);
                  return by_entry(tf::translation(t), gl({Translate{t}}));
                }),
      float_row("T^-1", "inverse_translation", "glTranslate(-t)", 0,
                [](Inputs& r) {
                  const auto t = size(r);
                  return by_entry(tf::inverse_translation(t), gl({Translate{-t}}));
                }),
      float_row("S (004 3.1)", "scaling", "glScale", 0,
                [](Inputs& r) {
                  const auto s = size(r);
                  return by_entry(tf::scaling(s), gl({Scale{s}}));
                }),
      float_row("S^-1", "inverse_scaling", "glScale(1/s)", 1,  // 1/s is no float: one rounding
                [](Inputs& r) {
                  const auto s = size(r);
                  return by_entry(tf::inverse_scaling(s), gl({Scale{1.0 / s}}));
                }),
      about("R_x (000, 004 3.1)", "rotation_x", tf::rotation_x, "glRotate", 1, x),
      about("R_y (000, 004 3.1)", "rotation_y", tf::rotation_y, "glRotate", 1, y),
      about("R_z (000, 004 3.1)", "rotation_z", tf::rotation_z, "glRotate", 1, z),
      about("R_x^-1 = R_x^T", "inverse_rotation_x", tf::inverse_rotation_x, "glRotate(-angle)", -1, x),
      about("R_y^-1 = R_y^T", "inverse_rotation_y", tf::inverse_rotation_y, "glRotate(-angle)", -1, y),
      about("R_z^-1 = R_z^T", "inverse_rotation_z", tf::inverse_rotation_z, "glRotate(-angle)", -1, z),
      about_axis("R about an axis (Rodrigues)", "rotation", tf::rotation, 1),
      about_axis("R^-1 = R^T", "inverse_rotation", tf::inverse_rotation, -1),
      about_axis("R by a basis (004 3.3.8)", "rotation_by_basis", tf::rotation_by_basis, 1),
      float_row("orbit of a model (004 3.3.9)", "orbit_model", "glTranslate glRotate glTranslate", kOrbit,
                [](Inputs& r) {
                  const double a = degrees(r);
                  const auto p = as_float(r.point(10)), axis = as_float(r.direction(10));
                  const auto read = gl({Translate{p}, Rotate{a, axis}, Translate{-p}});
                  return by_largest(tf::orbit_model(p, a * kDegree, axis), read,
                                    std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
                }),
  };
}

// A camera by its angles: turned about y, then lifted about x, then rolled about z, degrees in float.
struct Pose {
  glm::dvec3 eye;
  double yaw, pitch, roll;

  glm::dvec3 turned(const glm::dvec3& v) const {
    return glm::dvec3(tf::rotation_y(yaw * kDegree) * tf::rotation_x(pitch * kDegree) * tf::rotation_z(roll * kDegree) *
                      glm::dvec4(v, 0));
  }
  std::vector<osmesa::MatrixCall> to_world() const {
    return {Translate{eye}, Rotate{yaw, {0, 1, 0}}, Rotate{pitch, {1, 0, 0}}, Rotate{roll, {0, 0, 1}}};
  }
  std::vector<osmesa::MatrixCall> from_world() const {
    return {Rotate{-roll, {0, 0, 1}}, Rotate{-pitch, {1, 0, 0}}, Rotate{-yaw, {0, 1, 0}}, Translate{-eye}};
  }
};

Pose pose(Inputs& r) {
  const double yaw = degrees(r), pitch = degrees(r) / 2, roll = degrees(r);
  return {as_float(r.point(10)), yaw, pitch, roll};
}

std::vector<Row> gl_look_at_rows() {
  // Three angles: pi u for the argument of each (half of it for the pitch) and, in the norm of a rotation, 1.5 u for
  // sine and cosine; two products of orthonormal matrices, 3 u each; the product with the eye 4 u more.
  constexpr double kCamera = 2.5 * 3.15 + 3 * 1.5 + 2 * 3 + 4;
  using LookAt = glm::dmat4 (*)(const glm::dvec3&, const glm::dvec3&, const glm::dvec3&);
  // `ahead`: where the camera's own space has what it looks at; given as a point, or, to M_cam, as a direction.
  const auto camera = [=](const char* formula, const char* ours, LookAt look_at, const char* reference,
                          glm::dvec3 ahead, bool gaze, bool inverse) {
    return float_row(formula, ours, reference, kCamera, [=](Inputs& r) {
      const Pose p = pose(r);
      const glm::dvec3 view = p.turned(ahead);
      const auto m = look_at(p.eye, gaze ? view : p.eye + view, p.turned({0, 1, 0}));
      return by_largest(m, gl(inverse ? p.to_world() : p.from_world()), glm::length(p.eye));
    });
  };
  const glm::dvec3 forward(0, 0, 1), backward(0, 0, -1);
  return {
      camera("M_cam u v w (000)", "gzrender::m_cam", tf::gzrender::m_cam, "glRotate x 3, glTranslate(-e)", forward,
             true, false),
      camera("M_cam^-1", "gzrender::inverse_m_cam", tf::gzrender::inverse_m_cam, "glTranslate(e), glRotate x 3",
             forward, true, true),
      camera("X_iw (004 3.3)", "gzrender::x_iw", tf::gzrender::x_iw, "glRotate x 3, glTranslate(-c)", forward, false,
             false),
      camera("X_wi (004 3.3)", "gzrender::x_wi", tf::gzrender::x_wi, "glTranslate(c), glRotate x 3", forward, false,
             true),
      camera("gluLookAt", "gl::look_at", tf::gl::look_at, "glRotate x 3, glTranslate(-eye)", backward, false, false),
      camera("its inverse", "gl::inverse_look_at", tf::gl::inverse_look_at, "glTranslate(eye), glRotate x 3", backward,
             false, true),
      float_row("lookat (002)", "tinyrenderer::lookat", "glTranslate(0, 0, c) and gluLookAt's", kCamera,
                [](Inputs& r) {
                  const Pose p = pose(r);
                  const double c = distance(r);
                  const auto center = p.eye + c * p.turned({0, 0, -1});
                  auto calls = p.from_world();
                  calls.insert(calls.begin(), Translate{{0, 0, c}});
                  const auto m = tf::tinyrenderer::lookat(p.eye, center, p.turned({0, 1, 0}));
                  return by_largest(m, gl(calls), glm::length(p.eye) + c);
                }),
  };
}

struct FrustumSides {
  double l, r, b, t, n, f;
};

FrustumSides frustum_sides(Inputs& random) {
  const double n = as_float(std::exp2(random.between(-7, 3)));
  const double l = as_float(n * random.between(-4, 4)), b = as_float(n * random.between(-4, 4));
  const double w = n * std::exp2(random.between(-3, 3)), h = n * std::exp2(random.between(-3, 3));
  return {l, as_float(l + w), b, as_float(b + h), n, as_float(n * (1 + std::exp2(random.between(-3, 14))))};
}

Scale upside_down() { return {{1, 1, -1}}; }

std::vector<Row> gl_projection_rows() {
  // A sum, a difference or a product, and their quotient.
  constexpr double kQuotient = 3;
  // z' = (z_ndc + 1)/4 of glFrustum's with far = 2 near: 2 roundings in an entry, 1 in the sum of two; then the product
  // with d and the sum that leaves 0, against terms as large as d.
  constexpr double kViewPlane = 7;
  const auto lens = [](Inputs& r) {
    return std::pair(tf::FieldOfView{r.between(10, 170) * kDegree, std::exp2(r.between(-2, 2))}, frustum_sides(r));
  };
  // All of X_pi but its scale: its w times d is the distance from the eye.
  const auto from_minus_d = [](double d) {
    return std::vector<osmesa::MatrixCall>{Translate{{0, 0, 0.25}}, Scale{{1, 1, 0.25}},
                                           Frustum{-1, 1, -1, 1, d, 2 * d}, upside_down(), Translate{{0, 0, d}}};
  };
  return {
      float_row("glFrustum", "gl::frustum", "glFrustum", kQuotient,
                [](Inputs& r) {
                  const auto [l, r_side, b, t, n, f] = frustum_sides(r);
                  return by_entry(tf::gl::frustum(l, r_side, b, t, n, f), gl({Frustum{l, r_side, b, t, n, f}}));
                }),
      float_row("glOrtho", "gl::orthographic", "glOrtho", kQuotient,
                [](Inputs& r) {
                  const FrustumSides v = frustum_sides(r);
                  return by_entry(tf::gl::orthographic(v.l, v.r, v.b, v.t, v.n, v.f),
                                  gl({Orthographic{v.l, v.r, v.b, v.t, v.n, v.f}}));
                }),
      // The plane is rounded when it is handed over.
      float_row("gluPerspective, l r b t (001)", "gl::perspective, near_plane", "glFrustum", kQuotient + 1,
                [=](Inputs& r) {
                  const auto [view, v] = lens(r);
                  const auto p = tf::near_plane(view, v.n);
                  return by_entry(tf::gl::perspective(view, v.n, v.f),
                                  gl({Frustum{p.left, p.right, p.bottom, p.top, v.n, v.f}}));
                }),
      float_row("M_ortho (001)", "games101::orthographic", "glScale(1, 1, -1) glOrtho", kQuotient,
                [](Inputs& r) {
                  const FrustumSides v = frustum_sides(r);
                  return by_entry(tf::games101::orthographic(v.l, v.r, v.b, v.t, -v.n, -v.f),
                                  gl({upside_down(), Orthographic{v.l, v.r, v.b, v.t, v.n, v.f}}));
                }),
      float_row("M_persp (001)", "-games101::perspective", "glScale(1, 1, -1) glFrustum", kQuotient + 1,
                [=](Inputs& r) {
                  const auto [view, v] = lens(r);
                  const auto p = tf::near_plane(view, -v.n);
                  return by_entry(-tf::games101::perspective(view, -v.n, -v.f),
                                  gl({upside_down(), Frustum{p.left, p.right, p.bottom, p.top, v.n, v.f}}));
                }),
      float_row("X_pi (000, 004 3.2)", "d gzrender::x_pi", "glFrustum from -d, z by glScale", kViewPlane,
                [=](Inputs& r) {
                  const double d = distance(r);
                  return by_largest(d * tf::gzrender::x_pi(d), gl(from_minus_d(d)));
                }),
      float_row("w = 1 - z/c (002)", "c tinyrenderer::projection", "the same, z turned and times c", kViewPlane,
                [=](Inputs& r) {
                  const double c = distance(r);
                  auto calls = from_minus_d(c);
                  calls.insert(calls.begin(), Scale{{1, 1, -c}});
                  calls.push_back(upside_down());
                  return by_largest(c * tf::tinyrenderer::projection(c), gl(calls), c * c);
                }),
  };
}

std::vector<Row> gl_window_rows() {
  constexpr double kMaxInt = 16777215;  // a float has no more digits
  return {
      float_row("X_sp (000, 004 3.2)", "gzrender::x_sp", "glTranslate glScale", 0,
                [](Inputs& r) {
                  const double xs = pixels(r), ys = pixels(r);
                  return by_entry(tf::gzrender::x_sp(xs, ys, kMaxInt),
                                  gl({Translate{{xs / 2, ys / 2, 0}}, Scale{{xs / 2, -ys / 2, kMaxInt}}}));
                }),
      float_row("X_sp^-1", "gzrender::inverse_x_sp", "glScale glTranslate", 2,  // 1/s is rounded, and its product
                [](Inputs& r) {
                  const double xs = pixels(r), ys = pixels(r);
                  return by_entry(tf::gzrender::inverse_x_sp(xs, ys, kMaxInt),
                                  gl({Scale{{2 / xs, -2 / ys, 1 / kMaxInt}}, Translate{{-xs / 2, -ys / 2, 0}}}));
                }),
      float_row("M_viewport (001)", "games101::viewport", "glTranslate glScale", 0,
                [](Inputs& r) {
                  const double w = pixels(r), h = pixels(r);
                  const osmesa::MatrixCall half = Translate{{w / 2, h / 2, 0}}, scale = Scale{{w / 2, h / 2, 1}};
                  return by_entry(tf::games101::viewport(w, h), gl({half, scale}));
                }),
      float_row("viewport (002)", "tinyrenderer::viewport", "glTranslate glScale glTranslate", 0,
                [](Inputs& r) {
                  const double x = pixels(r), y = pixels(r), w = pixels(r), h = pixels(r);
                  return by_entry(tf::tinyrenderer::viewport(x, y, w, h, 255),
                                  gl({Translate{{x, y, 0}}, Scale{{w / 2, h / 2, 127.5}}, Translate{{1, 1, 1}}}));
                }),
  };
}

TEST(OsmesaTransforms, Models) { expect_table(model_rows()); }
TEST(OsmesaTransforms, LookAt) { expect_table(gl_look_at_rows()); }
TEST(OsmesaTransforms, Projections) { expect_table(gl_projection_rows()); }
TEST(OsmesaTransforms, Windows) { expect_table(gl_window_rows()); }

// The other way: a bound is a float's few ULP, not a blanket.
TEST(OsmesaTransforms, SeesOneMatrixTakenForAnother) {
  const auto holds_for = [](auto ours) {
    return holds(float_row("", "", "", 30, [=](Inputs& r) {
      const double a = degrees(r);
      const auto axis = as_float(r.direction(10));
      return by_largest(ours(a, axis), gl({Rotate{a, axis}}));
    }));
  };
  EXPECT_TRUE(holds_for([](double a, const glm::dvec3& axis) { return tf::rotation(a * kDegree, axis); }));
  EXPECT_FALSE(holds_for([](double a, const glm::dvec3& axis) { return tf::inverse_rotation(a * kDegree, axis); }));
  EXPECT_FALSE(holds_for([](double a, const glm::dvec3& axis) { return tf::rotation(a, axis); })) << "degrees";
  EXPECT_FALSE(holds_for([](double a, const glm::dvec3& axis) { return tf::rotation(a * kDegree * 1.00001, axis); }));
}

TEST(OsmesaTransforms, GlRefusesWhatIsNoVolume) {
  EXPECT_THROW(gl({Frustum{0, 0, 0, 1, 1, 2}}), std::runtime_error);
  EXPECT_EQ(gl({}), glm::dmat4(1)) << "and what it refused leaves nothing behind";
}

}  // namespace
}  // namespace plumbline::test
