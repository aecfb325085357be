// The formulas of the notes that are no matrices, ours beside an evaluation of their own, in integers or in a wider
// format: the table goes on (transforms_table_test.cpp). What is an integer is equal. Of a sum, the unit is an ULP of
// its largest term, or of the sum where that is larger: at most 4, as there. In a million inputs 3.5 is seen.
#include "faults/pixel_barycentrics.h"
#include "kernels/attributes.h"
#include "kernels/coverage.h"
#include "kernels/depth.h"
#include "notes/raster/triangle_algorithms.h"
#include "pipeline/geometry.h"
#include "reference/exact/wide.h"
#include "scene/frame_buffer.h"
#include "tests/at_weights.h"
#include "tests/cross/transforms_table.h"
#include "tests/pipeline/window_triangles.h"
#include "transforms/projection.h"

namespace plumbline::test {
namespace {

using exact::Int128;
using raster::Corners;

/// x and y [1/256 pixel], wide enough for all products here.
struct Point {
  Int128 x, y;
};
Point point(glm::ivec2 p) { return {p.x, p.y}; }

// The notes' edge functions: the value of the edge from p to q at (x, y).
template <class P>
auto f(const P& i, const P& j, const P& p) {
  return (i.y - j.y) * p.x + (j.x - i.x) * p.y + i.x * j.y - j.x * i.y;
}
Int128 f_ij(Point i, Point j, Point p) { return f(i, j, p); }
Int128 cross_product(Point p, Point q, Point at) {
  return (q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x);  // z of (q - p) x (at - p)
}
Int128 lee(Point p, Point q, Point at) { return (q.y - p.y) * (at.x - p.x) - (q.x - p.x) * (at.y - p.y); }
using Expression = Int128 (*)(Point, Point, Point);

int whole(Inputs& r, int least, int most) { return static_cast<int>(std::floor(r.between(least, most + 1.0))); }
glm::ivec2 corner(Inputs& r, int reach) {
  const int x = whole(r, -reach, reach);
  return {x, whole(r, -reach, reach)};
}

/// Counter-clockwise in the window, of an area; corners at multiples of 1/256 pixel, which floats hold.
pipeline::ShadedTriangle triangle_within(Inputs& r, int reach) {
  for (;;) {
    pipeline::ShadedTriangle out{};
    for (std::size_t k = 0; k < 3; ++k) {
      pipeline::WindowVertex& v = out.v[k];
      v.snapped = corner(r, reach);
      v.p_win = glm::vec3(glm::vec2(glm::dvec2(v.snapped) / 256.0 + 0.5), static_cast<float>(r.between(0, 1)));
      v.inv_w = 1;
      for (int i = 0; i < 4; ++i) out.attributes[k].color()[i] = static_cast<float>(r.between(0, 1));
    }
    const std::int64_t area = pipeline::snapped_area(out);
    if (area == 0) continue;
    if (area < 0) std::swap(out.v[1], out.v[2]), std::swap(out.attributes[1], out.attributes[2]);
    out.front = true;
    return out;
  }
}

constexpr int kFarthest = 16384 * 256;

/// Edge function i at a pixel, without the tie rule's offset: twice an area [1/65536 pixel^2].
std::int64_t value_at(const pipeline::Edges& e, int i, int x, int y) {
  const bool owned = e.step_x[i] > 0 || (e.step_x[i] == 0 && e.step_y[i] > 0);
  return e.at_origin[i] + e.step_x[i] * x + e.step_y[i] * y + (owned ? 0 : 1);
}

Entry integer(std::int64_t ours, Int128 theirs) {
  return {static_cast<double>(ours), static_cast<Wide>(theirs), static_cast<Wide>(1)};  // all below 2^53
}

/// One edge of the triangle that ships, at any pixel.
Row edge_row(const char* formula, const char* reference, int edge, int sign, Expression theirs) {
  return row(formula, "edges_of", reference, 0, [=](Inputs& r) {
    const pipeline::ShadedTriangle t = triangle_within(r, kFarthest);
    const int x = whole(r, 0, 16383), y = whole(r, 0, 16383);
    const Point p = point(t.v[static_cast<std::size_t>(edge)].snapped);
    const Point q = point(t.v[static_cast<std::size_t>((edge + 1) % 3)].snapped);
    return Entries{integer(value_at(pipeline::edges_of(t), edge, x, y), sign * theirs(p, q, {256 * x, 256 * y}))};
  });
}

/// The step to the next pixel, or row.
Row step_row(const char* formula, const char* ours, bool along_x) {
  return row(formula, ours, "E there - E here", 0, [=](Inputs& r) {
    const pipeline::ShadedTriangle t = triangle_within(r, kFarthest);
    const pipeline::Edges e = pipeline::edges_of(t);
    const Int128 x = whole(r, 0, 16383), y = whole(r, 0, 16383);
    Entries out;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point p = point(t.v[i].snapped), q = point(t.v[(i + 1) % 3].snapped);
      const Point here{256 * x, 256 * y}, there{256 * (x + along_x), 256 * (y + !along_x)};
      out.push_back(integer(along_x ? e.step_x[i] : e.step_y[i], lee(p, q, here) - lee(p, q, there)));
    }
    return out;
  });
}

int sign_of(Int128 v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

/// Side of p -> q; a point on the line counts as moved to the right a hair, and up by a hair of that.
int side(Expression e, Point p, Point q, Point at) {
  for (const Point moved : {at, Point{at.x + 1, at.y}, Point{at.x, at.y + 1}}) {
    if (const int s = sign_of(e(p, q, moved)); s != 0) return s;
  }
  return 0;
}

using Cover = raster::Spans (*)(const Corners&, int, int);

/// Every pixel of a small frame, in or out.
Row inside_row(const char* formula, const char* ours, Cover cover, const char* reference, Expression e) {
  return row(formula, ours, reference, 0, [=](Inputs& r) {
    constexpr int kSide = 8;
    Corners c;
    const bool on_centres = r.between(0, 1) < 0.25;  // where ties are
    for (glm::ivec2& p : c) p = on_centres ? 256 * corner(r, kSide) : corner(r, 2 * 256 * kSide);
    int drawn[kSide][kSide] = {};
    for (const raster::Span& s : cover(c, kSide, kSide)) {
      for (int x = s.begin; x < s.end; ++x) ++drawn[s.y][x];
    }
    const Point p0 = point(c[0]), p1 = point(c[1]), p2 = point(c[2]);
    Entries out;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const Point at{256 * x, 256 * y};
        const int s = side(e, p0, p1, at);
        const bool in = e(p0, p1, p2) != 0 && s == side(e, p1, p2, at) && s == side(e, p2, p0, at);
        out.push_back(integer(drawn[y][x], in));
      }
    }
    return out;
  });
}

std::vector<Row> integer_rows() {
  return {
      edge_row("f_01 (000)", "as printed, 128 bits", 0, 1, f_ij),
      edge_row("f_12 (000)", "as printed, 128 bits", 1, 1, f_ij),
      edge_row("f_20 (000)", "as printed, 128 bits", 2, 1, f_ij),
      edge_row("P0P1 x P0Q (001)", "cross product, 128 bits", 0, 1, cross_product),
      edge_row("P1P2 x P1Q (001)", "cross product, 128 bits", 1, 1, cross_product),
      edge_row("P2P0 x P2Q (001)", "cross product, 128 bits", 2, 1, cross_product),
      edge_row("-E = dX (y - Y) - dY (x - X) (004)", "as printed, 128 bits", 0, -1, lee),
      step_row("E(x + 1, y) - E(x, y) = dY (004)", "edges_of, step_x", true),
      step_row("E(x, y + 1) - E(x, y) = -dX (004)", "edges_of, step_y", false),
      inside_row("alpha, beta, gamma > 0 (000)", "cover_by_barycentric", raster::cover_by_barycentric, "f_ij, 128 bits",
                 f_ij),
      inside_row("inside(t, x, y) (001)", "cover_by_cross_products", raster::cover_by_cross_products,
                 "cross products, 128 bits", cross_product),
      inside_row("LEE, consistent sign (004)", "cover_by_lee", raster::cover_by_lee, "E, 128 bits", lee),
      row("buffer size (004 1)", "buffer_bytes", "width x height x depth, 128 bits", 0,
          [](Inputs& r) {
            const int w = whole(r, 1, 16384), h = whole(r, 1, 16384), bytes = whole(r, 1, 20);
            const std::size_t ours = buffer_bytes(w, h, static_cast<std::size_t>(bytes));
            return Entries{integer(static_cast<std::int64_t>(ours), Int128(w) * h * bytes)};
          }),
      row("int(z/w + .5) (002)", "depth_code", "floor(255 z + 1/2)", 0,
          [](Inputs& r) {
            const auto z = static_cast<float>(r.between(0, 1));
            return number(pipeline::depth_code(double{z}, 255.0), std::floor(Wide(z) * 255 + 0.5L));
          }),
  };
}

/// Weights at a pixel of the triangle's neighbourhood, and the largest of the terms that each is the sum of.
struct Weighed {
  pipeline::Barycentric ours;
  WideVec3 at[3];  ///< the corners, less the pixel's centre: exact, and so are products of two
  WideVec3 terms;
};
Weighed weighed(Inputs& r) {
  Weighed out;
  const pipeline::ShadedTriangle t = triangle_within(r, 64 * 256);
  const int x = whole(r, -64, 64), y = whole(r, -64, 64), dx = whole(r, 0, 63), dy = whole(r, 0, 63);
  const pipeline::BarycentricPlanes p = pipeline::planes_of(t, x - dx, y - dy);
  out.ours = pipeline::barycentric(p, {x, y, x + 0.5, y + 0.5});
  for (std::size_t i = 0; i < 3; ++i) out.at[i] = WideVec3(t.v[i].p_win) - WideVec3(x + 0.5, y + 0.5, 0);
  const auto largest = [&](const pipeline::Affine<double>& f) {
    return std::max({std::abs(f.at_0), std::abs(dx * f.x), std::abs(dy * f.y)});
  };
  const double l1 = largest(p.l1), l2 = largest(p.l2);
  out.terms = {std::max(1.0, l1 + l2), l1, l2};  // l0 = 1 - l1 - l2
  return out;
}

/// 002's barycentric(), as the tutorial that it follows has it: one cross product for both weights.
WideVec3 by_one_cross_product(const WideVec3 (&at)[3]) {
  const WideVec3 x(at[2].x - at[0].x, at[1].x - at[0].x, at[0].x), y(at[2].y - at[0].y, at[1].y - at[0].y, at[0].y);
  const WideVec3 u = glm::cross(x, y);
  return {1 - (u.x + u.y) / u.z, u.y / u.z, u.x / u.z};
}

/// Our weights beside others.
template <class Theirs>
Row weights_row(const char* formula, const char* reference, Theirs theirs) {
  return row(formula, "planes_of, barycentric", reference, 4, [=](Inputs& r) {
    const Weighed w = weighed(r);
    const WideVec3 t = theirs(w.at);
    const WideVec3 magnitude = glm::max(w.terms, glm::abs(t));
    return Entries{{w.ours.l0, t.x, magnitude.x}, {w.ours.l1, t.y, magnitude.y}, {w.ours.l2, t.z, magnitude.z}};
  });
}

WideVec3 alpha_beta_gamma(const WideVec3 (&at)[3]) {
  const auto& [p0, p1, p2] = at;
  const WideVec3 here(0);
  return {f(p1, p2, here) / f(p1, p2, p0), f(p2, p0, here) / f(p2, p0, p1), f(p0, p1, here) / f(p0, p1, p2)};
}

/// Weights inside of a triangle, and w of its corners: colours by 000's sum, or that over w.
Row color_row(const char* formula, const char* ours, const char* reference, double largest_w) {
  return {formula, ours, reference, 24, 4, [=](Inputs& r) {
            pipeline::ShadedTriangle t = triangle_within(r, 256);
            const double a = r.between(0, 1), b = r.between(0, 1 - a);
            const double l[3] = {1 - a - b, a, b};
            WideVec3 sum(0);
            Wide of_weights = 0;
            for (std::size_t i = 0; i < 3; ++i) {
              t.v[i].inv_w = static_cast<float>(1 / r.between(1, largest_w));
              const Wide weight = Wide(l[i]) * t.v[i].inv_w;
              sum += weight * WideVec3(t.attributes[i].color());
              of_weights += weight;
            }
            const auto c = test::attributes_at(t, testing_words::color_setup(t), l[1], l[2]);
            sum /= of_weights;
            Entries out;  // colours are in [0, 1], and so is what is added to the first corner's
            for (const auto& [mine, theirs] : {std::pair(c.r, sum.r), {c.g, sum.g}, {c.b, sum.b}}) {
              out.push_back({mine, theirs, 1});
            }
            return out;
          }};
}

std::vector<Row> interpolation_rows() {
  const auto segment = [](Inputs& r) {
    const float z0 = static_cast<float>(r.between(0, 1)), z1 = static_cast<float>(r.between(0, 1));
    pipeline::WindowTriangle t;
    t.v[0].p_win.z = z0, t.v[1].p_win.z = z1;
    const double at = r.between(0, 1);
    const float ours = test::depth_at(pipeline::depth_setup(t, {DepthFormat::z32f}), at, 0);
    return number(ours, z0 * (1 - Wide(at)) + z1 * Wide(at));
  };
  return {
      weights_row("alpha = f_12/f_12(x_0, y_0) (000)", "f_ij, 64 bits", alpha_beta_gamma),
      weights_row("barycentric() (002)", "one cross product, 64 bits", by_one_cross_product),
      color_row("alpha c_0 + beta c_1 + ... (000)", "attributes, w = 1", "as printed, 64 bits", 1),
      color_row("varying * bar (002), over w", "attributes", "sum(b a / w) / sum(b / w), 64 bits", 100),
      {"p_0 (1 - t) + p_1 t (002)", "depth", "as printed, 64 bits", 24, 0.51, segment},
  };
}

/// A point of the view volume through stage 4, in a window of w x h pixels.
Entries divided(Inputs& r) {
  Matrices<float> m{};
  m.win_scale = {static_cast<float>(whole(r, 1, 16384)) / 2, static_cast<float>(whole(r, 1, 16384)) / 2, 0.5f};
  m.win_translate = m.win_scale;
  pipeline::Polygon polygon;
  for (int i = 0; i < 3; ++i) {
    const double w = std::exp2(r.between(-4, 6));
    const glm::dvec3 p = w * r.point(1);
    polygon.corners.push_back({Vec4<float>(glm::vec3(p), static_cast<float>(w)), {}, false});
  }
  const Draw draw;
  std::vector<pipeline::ShadedTriangle> triangles;
  pipeline::to_window({&draw, Topology::triangles, false, false, m}, polygon, triangles);
  Entries out;
  for (const pipeline::ShadedTriangle& t : triangles) {
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec4<float>& c = polygon.corners[(v + 1) % 3].p_clip;  // a fan's corners are (1, 2, 0)
      for (int i = 0; i < 3; ++i) {
        const Wide theirs = (Wide(c[i]) / c.w + 1) * m.win_scale[i];
        out.push_back({t.v[v].p_win[i], theirs, std::max<Wide>(m.win_translate[i], std::abs(theirs))});
      }
    }
  }
  return out;
}

/// A point through two matrices, by stage 1. The unit: all terms' magnitudes, added up.
Entries transformed(Inputs& r) {
  Matrices<float> m{};
  m.normal = Mat3<float>(1);
  for (Mat4<float>* matrix : {&m.model_view, &m.projection}) {
    for (int i = 0; i < 16; ++i) (*matrix)[i / 4][i % 4] = static_cast<float>(r.between(-2, 2));
  }
  Mesh mesh;
  mesh.positions = {glm::vec3(r.point(10))};
  mesh.normals = {glm::vec3(0, 0, 1)};
  std::vector<Vertex<float>> out;
  pipeline::transform(m, Normals::normalize, mesh, out);
  const glm::vec<4, Wide> p(mesh.positions[0], 1);
  const WideMat4 projection(m.projection), model_view(m.model_view);
  const auto magnitudes = [](WideMat4 w) {
    for (int c = 0; c < 4; ++c) w[c] = glm::abs(w[c]);
    return w;
  };
  const auto theirs = projection * (model_view * p);
  const auto terms = magnitudes(projection) * (magnitudes(model_view) * glm::abs(p));
  Entries entries;
  for (int i = 0; i < 4; ++i) entries.push_back({out[0].p_clip[i], theirs[i], terms[i]});
  return entries;
}

std::vector<Row> note_projection_rows() {
  const auto plane = [](const char* formula, const char* ours, const char* reference, bool right) {
    return row(formula, ours, reference, 4, [=](Inputs& r) {
      const transforms::FieldOfView view{r.between(0.01, 0.49) * kTurn, std::exp2(r.between(-2, 2))};
      const double n = -std::exp2(r.between(-7, 3));
      const auto p = transforms::near_plane(view, n);
      const Wide t = -n * std::tan(Wide(view.fov_y) / 2);
      return right ? number(p.right, t * view.aspect) : number(p.top, t);
    });
  };
  return {
      plane("t = |n| tan(fovY/2) (001)", "near_plane, top", "as printed, 64 bits", false),
      plane("r = t aspect (001)", "near_plane, right", "as printed, 64 bits", true),
      {"V_b = X_ba V_a (004 3), twice", "transform", "two products, 64 bits", 24, 4, transformed},
      // 1/w, its product, the sum: at most two roundings of a term and one of a sum of two.
      {"x/w, y/w, z/w, to a window (004 3)", "to_window", "(c/w + 1) size/2, 64 bits", 24, 4, divided},
  };
}

// The other way: a formula with one sign or one name wrong is beyond its bound.
TEST(FormulasTable, NamesASlip) {
  const Expression slipped = [](Point i, Point j, Point p) {
    return (i.y - j.y) * p.x + (j.x - i.x) * p.y + i.x * j.y + j.x * i.y;
  };
  EXPECT_FALSE(holds(edge_row("", "", 0, 1, slipped)));
  EXPECT_FALSE(holds(edge_row("", "", 0, 1, lee))) << "004 has the other sign";
  EXPECT_FALSE(holds(inside_row("", "", raster::cover_by_lee, "", slipped)));
  EXPECT_FALSE(holds(inside_row(
      "", "",
      [](const Corners& c, int w, int h) {
        raster::Spans out = raster::cover_by_lee(c, w, h);
        if (!out.empty()) out.pop_back();  // a row lost
        return out;
      },
      "", lee)));
  EXPECT_FALSE(holds(weights_row("", "", [](const WideVec3(&at)[3]) {
    const WideVec3 t = alpha_beta_gamma(at);
    return WideVec3(t.x, t.z, t.y);  // barycentric() with its last two exchanged
  })));
  EXPECT_FALSE(holds(weights_row("", "", [](const WideVec3(&at)[3]) {
    return alpha_beta_gamma(at) * (1 + std::ldexp(Wide(1), -49));  // by 16 to 32 ULP
  })));
}

TEST(FormulasTable, Integers) { expect_table(integer_rows()); }
TEST(FormulasTable, Interpolation) { expect_table(interpolation_rows()); }
TEST(FormulasTable, Projection) { expect_table(note_projection_rows()); }

}  // namespace
}  // namespace plumbline::test
