// The projections of the notes, beside GLM's: the table goes on (transforms_table_test.cpp).
#include "tests/cross/transforms_table.h"
#include "transforms/projection.h"

namespace plumbline::test {
namespace {

namespace tf = transforms;

// A view volume: the distances of its near and far planes, and its sides where the near plane cuts them.
struct Volume {
  tf::NearPlane plane;
  double near, far;
};

Volume volume(Inputs& r) {
  Volume v;
  v.near = std::exp2(r.between(-7, 3));
  v.far = v.near * (1 + std::exp2(r.between(-3, 14)));
  v.plane.left = v.near * r.between(-4, 4);
  v.plane.right = v.plane.left + v.near * std::exp2(r.between(-3, 3));
  v.plane.bottom = v.near * r.between(-4, 4);
  v.plane.top = v.plane.bottom + v.near * std::exp2(r.between(-3, 3));
  return v;
}

tf::FieldOfView field_of_view(Inputs& r) { return {r.between(0.01, 0.49) * kTurn, std::exp2(r.between(-2, 2))}; }

using Box = glm::dmat4 (*)(double, double, double, double, double, double);
using WideBox = WideMat4 (*)(Wide, Wide, Wide, Wide, Wide, Wide);
using Lens = glm::dmat4 (*)(const tf::FieldOfView&, double, double);

WideMat4 wide_perspective(const tf::FieldOfView& v, Wide n, Wide f) {
  return glm::perspectiveRH_NO(Wide(v.fov_y), Wide(v.aspect), n, f);
}

std::vector<Row> gl_rows() {
  const auto box = [](const char* formula, const char* ours, Box matrix, const char* reference, WideBox theirs,
                      bool inverse) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const Volume v = volume(r);
      const auto& p = v.plane;
      const WideMat4 wide_matrix = theirs(p.left, p.right, p.bottom, p.top, v.near, v.far);
      return by_entry(matrix(p.left, p.right, p.bottom, p.top, v.near, v.far),
                      inverse ? glm::inverse(wide_matrix) : wide_matrix);
    });
  };
  const auto lens = [](const char* formula, const char* ours, Lens matrix, const char* reference, bool inverse) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const auto v = field_of_view(r);
      const Volume d = volume(r);
      const WideMat4 wide_matrix = wide_perspective(v, d.near, d.far);
      return by_entry(matrix(v, d.near, d.far), inverse ? glm::inverse(wide_matrix) : wide_matrix);
    });
  };
  return {
      box("glFrustum", "gl::frustum", tf::gl::frustum, "frustumRH_NO", glm::frustumRH_NO, false),
      box("its inverse", "gl::inverse_frustum", tf::gl::inverse_frustum, "inverse(frustumRH_NO)", glm::frustumRH_NO,
          true),
      box("glOrtho", "gl::orthographic", tf::gl::orthographic, "orthoRH_NO", glm::orthoRH_NO, false),
      box("its inverse", "gl::inverse_orthographic", tf::gl::inverse_orthographic, "inverse(orthoRH_NO)",
          glm::orthoRH_NO, true),
      lens("gluPerspective", "gl::perspective", tf::gl::perspective, "perspectiveRH_NO", false),
      lens("its inverse", "gl::inverse_perspective", tf::gl::inverse_perspective, "inverse(perspectiveRH_NO)", true),
  };
}

// GAMES101's cube has +1 near, and its w is z: GL's matrix with both turned round.
WideMat4 near_is_plus_one(const WideMat4& gl) { return glm::scale(kOne, WideVec3(1, 1, -1)) * gl; }

WideMat4 games101_ortho(const Volume& v) {
  const auto& p = v.plane;
  return near_is_plus_one(glm::orthoRH_NO<Wide>(p.left, p.right, p.bottom, p.top, v.near, v.far));
}
WideMat4 games101_frustum_to_box(const Volume& v) {
  const auto& p = v.plane;
  return glm::inverse(games101_ortho(v)) *
         -near_is_plus_one(glm::frustumRH_NO<Wide>(p.left, p.right, p.bottom, p.top, v.near, v.far));
}

std::vector<Row> games101_rows() {
  const auto ortho = [](const char* formula, const char* ours, Box matrix, const char* reference, bool inverse) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const Volume v = volume(r);
      const auto& p = v.plane;
      const WideMat4 wide_matrix = games101_ortho(v);
      return by_entry(matrix(p.left, p.right, p.bottom, p.top, -v.near, -v.far),
                      inverse ? glm::inverse(wide_matrix) : wide_matrix);
    });
  };
  const auto squeeze = [](const char* formula, const char* ours, glm::dmat4 (*matrix)(double, double),
                          const char* reference, bool inverse) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const Volume v = volume(r);
      const WideMat4 wide_matrix = games101_frustum_to_box(v);
      return by_largest(matrix(-v.near, -v.far), inverse ? glm::inverse(wide_matrix) : wide_matrix);
    });
  };
  const auto lens = [](const char* formula, const char* ours, Lens matrix, const char* reference, bool inverse) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const auto f = field_of_view(r);
      const Volume v = volume(r);
      const WideMat4 wide_matrix = -near_is_plus_one(wide_perspective(f, v.near, v.far));
      return by_largest(matrix(f, -v.near, -v.far), inverse ? glm::inverse(wide_matrix) : wide_matrix);
    });
  };
  return {
      ortho("M_ortho (001)", "games101::orthographic", tf::games101::orthographic, "orthoRH_NO, z turned", false),
      ortho("its inverse", "games101::inverse_orthographic", tf::games101::inverse_orthographic,
            "inverse(orthoRH_NO, z turned)", true),
      squeeze("M_persp->ortho (001)", "games101::persp_to_ortho", tf::games101::persp_to_ortho,
              "inverse(orthoRH_NO) -frustumRH_NO", false),
      squeeze("its inverse", "games101::inverse_persp_to_ortho", tf::games101::inverse_persp_to_ortho,
              "inverse(frustumRH_NO) orthoRH_NO", true),
      lens("M_persp (001)", "games101::perspective", tf::games101::perspective, "-perspectiveRH_NO, z turned", false),
      lens("its inverse", "games101::inverse_perspective", tf::games101::inverse_perspective,
           "inverse(-perspectiveRH_NO, z turned)", true),
      row("l r b t of fovY, aspect (001)", "near_plane", "inverse(perspectiveRH_NO) of corners", 4,
          [](Inputs& r) {
            const auto f = field_of_view(r);
            const double n = volume(r).near;
            const WideMat4 back = glm::inverse(wide_perspective(f, n, Wide(2) * Wide(n)));
            const auto corner = [&](Wide sign) {
              const auto p = back * glm::vec<4, Wide>(sign, sign, -1, 1);
              return p / p.w;
            };
            const auto plane = tf::near_plane(f, -n);
            return by_entry(glm::dmat2(plane.left, plane.bottom, plane.right, plane.top),
                            glm::mat<2, 2, Wide>(glm::vec<2, Wide>(corner(-1)), glm::vec<2, Wide>(corner(1))));
          }),
      row("fovY of l r b t (001)", "field_of_view", "angle between the rays", 4,
          [](Inputs& r) {
            const auto p = tf::near_plane(field_of_view(r), 1);
            const double n = volume(r).near;
            const Wide top = p.top;
            return number(tf::field_of_view(p, -n).fov_y, std::atan2(2 * top * n, Wide(n) * n - top * top));
          }),
      row("aspect of l r b t (001)", "field_of_view", "width / height", 0.5,
          [](Inputs& r) {
            const auto p = tf::near_plane(field_of_view(r), 1);
            return number(tf::field_of_view(p, -1).aspect, (Wide(p.right) - p.left) / (Wide(p.top) - p.bottom));
          }),
  };
}

// X_pi is GL's frustum of the same eye with its far plane at infinity: z from [-1, 1] to [0, 1], all over d.
WideMat4 x_pi(Wide d) {
  const WideMat4 eye =
      glm::infinitePerspectiveLH(2 * std::atan(1 / d), Wide(1), d) * glm::translate(kOne, WideVec3(0, 0, d));
  const WideMat4 halved = glm::translate(kOne, WideVec3(0, 0, 0.5L)) * glm::scale(kOne, WideVec3(1, 1, 0.5L));
  return halved * eye * (1 / d);
}
// x_pi turned round to look down -z, z not divided by c.
WideMat4 tiny(Wide c) { return glm::scale(kOne, WideVec3(1, 1, -c)) * x_pi(c) * glm::scale(kOne, WideVec3(1, 1, -1)); }

std::vector<Row> view_plane_rows() {
  using Plane = glm::dmat4 (*)(double);
  const auto plane = [](const char* formula, const char* ours, Plane matrix, const char* reference,
                        WideMat4 (*theirs)(Wide), bool inverse) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const double d = std::exp2(r.between(-4, 6));
      const WideMat4 wide_matrix = theirs(d);
      return by_largest(matrix(d), inverse ? glm::inverse(wide_matrix) : wide_matrix);
    });
  };
  return {
      row("1/d = tan(FOV/2) (004 3.2)", "gzrender::d_of_fov", "perspectiveRH_NO", 4,
          [](Inputs& r) {
            const double fov = field_of_view(r).fov_y;
            return number(tf::gzrender::d_of_fov(fov),
                          glm::perspectiveRH_NO(Wide(fov), Wide(1), Wide(1), Wide(2))[1][1]);
          }),
      row("FOV of d", "gzrender::fov_of_d", "angle between the rays", 4,
          [](Inputs& r) {
            const double d = std::exp2(r.between(-4, 6));
            const glm::vec<2, Wide> up(1, d), down(-1, d);
            return number(tf::gzrender::fov_of_d(d), std::acos(glm::dot(glm::normalize(up), glm::normalize(down))));
          }),
      plane("X_pi (000, 004 3.2)", "gzrender::x_pi", tf::gzrender::x_pi, "infinitePerspectiveLH from -d", x_pi, false),
      plane("X_pi^-1", "gzrender::inverse_x_pi", tf::gzrender::inverse_x_pi, "inverse(infinitePerspectiveLH)", x_pi,
            true),
      row("x = X/(Z/d+1), z' = Z/(Z+d)", "gzrender::x_pi, over w", "similar triangles", 4,
          [](Inputs& r) {
            const double d = std::exp2(r.between(-4, 6));
            const auto p = r.point(10) + glm::dvec3(0, 0, 10);  // in front of the view plane
            const auto q = tf::gzrender::x_pi(d) * glm::dvec4(p, 1);
            const Wide distance = Wide(p.z) + d;
            Entries out;
            for (int i = 0; i < 3; ++i) {
              const Wide expected = p[i] * (i < 2 ? Wide(d) : Wide(1)) / distance;
              out.push_back({q[i] / q.w, expected, std::abs(expected)});
            }
            return out;
          }),
      plane("w = 1 - z/c (002)", "tinyrenderer::projection", tf::tinyrenderer::projection,
            "infinitePerspectiveLH, z turned", tiny, false),
      plane("its inverse", "tinyrenderer::inverse_projection", tf::tinyrenderer::inverse_projection,
            "inverse(infinitePerspectiveLH, z turned)", tiny, true),
  };
}

TEST(ProjectionsTable, OfGl) { expect_table(gl_rows()); }
TEST(ProjectionsTable, Of001) { expect_table(games101_rows()); }
TEST(ProjectionsTable, OnTheViewPlane) { expect_table(view_plane_rows()); }

}  // namespace
}  // namespace plumbline::test
