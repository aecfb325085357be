#include "capture/float_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plumbline {

namespace {

constexpr double kU = 0x1p-24, kInfinity = std::numeric_limits<double>::infinity();

// |first| + |second| of the cross product of two differences.
double terms(glm::dvec2 a, glm::dvec2 b) { return std::abs(a.x * b.y) + std::abs(a.y * b.x); }

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

struct Edges {
  explicit Edges(const WindowCorners& c)
      : at{glm::dvec2(c[0]), glm::dvec2(c[1]), glm::dvec2(c[2])},
        area(cross(at[1] - at[0], at[2] - at[0])),
        area_terms(terms(at[1] - at[0], at[2] - at[0])) {}
  glm::dvec2 from(std::size_t i) const { return at[(i + 1) % 3]; }  // of the edge opposite corner i
  glm::dvec2 to(std::size_t i) const { return at[(i + 2) % 3]; }
  double share(std::size_t i, glm::dvec2 p) const { return cross(to(i) - from(i), p - from(i)) / area; }

  std::array<glm::dvec2, 3> at;
  double area, area_terms;
};

double or_infinite(double v) { return std::isfinite(v) ? v : kInfinity; }

double sum_of(glm::dvec2 v) { return v.x + v.y; }

// Displacement of an edge whose x is stepped in float [u of a pixel].
double stepped_edge(double rows, double most_x) { return 2 * (std::ceil(rows) + 2) * most_x; }

bool is_from_origin(Conventions::DepthArithmetic arithmetic) {
  using enum Conventions::DepthArithmetic;
  return arithmetic == in_float_from_origin || arithmetic == in_float_from_origin_stepped;
}

bool steps_depths(Conventions::DepthArithmetic arithmetic) {
  using enum Conventions::DepthArithmetic;
  return arithmetic == in_float_stepped || arithmetic == in_float_from_origin_stepped;
}

// Number of steps over a box of pixels, from any of its corners.
double steps_over(glm::dvec2 box) { return sum_of(glm::ceil(box) + 2.0); }

}  // namespace

namespace {

glm::dvec2 displacement_in_float(Conventions::DepthArithmetic arithmetic, const WindowBox& box, glm::dvec2 frame) {
  using enum Conventions::DepthArithmetic;
  const glm::dvec2 size = box.high - box.low, in_frame = glm::min(size, frame);
  const double most_x = std::max(std::abs(box.low.x), std::abs(box.high.x));
  if (arithmetic == in_float_stepped) return {kU * stepped_edge(in_frame.y, most_x), 0};
  if (arithmetic != in_float_stepped_edges) return glm::dvec2(0);
  const glm::dvec2 walked = in_frame + 2.0;  // pixels
  const double of_first = 4 * std::numbers::sqrt2 * glm::length(size + 2.0),
               of_steps = steps_over(walked) * glm::length(walked) + sum_of(walked);
  return glm::dvec2(kU * (of_first + of_steps));
}

}  // namespace

glm::dvec2 edge_displacement(const Conventions& conventions, const WindowBox& box, glm::dvec2 frame) {
  glm::dvec2 out = displacement_in_float(conventions.depth_arithmetic, box, frame);
  if (conventions.edge_bits != Conventions::kFloat) {
    const double rows = std::ceil(box.high.y - box.low.y) + 4;
    out.x += std::ldexp(rows, -conventions.edge_bits);
  }
  return out;
}

bool steps_whole_box(const Conventions& conventions) {
  return conventions.edge_bits != Conventions::kFloat ||
         conventions.depth_arithmetic == Conventions::DepthArithmetic::in_float_stepped_edges;
}

double error_by_edge_functions(const WindowCorners& corners, glm::dvec2 p) {
  const Edges edges(corners);
  double out = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = std::abs(edges.share(i, p)),
                 of_edge = terms(edges.to(i) - edges.from(i), p - edges.from(i)) / std::abs(edges.area),
                 of_area = edges.area_terms / std::abs(edges.area);
    out += 4 * std::abs(corners[i].z) * (of_edge + share * of_area + share);
  }
  return or_infinite(out);
}

double error_by_plane(const WindowCorners& corners, glm::dvec2 p) {
  const Edges edges(corners);
  glm::dvec2 slope(0), farthest(0), from_corner(0), slope_terms(0);
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 along = edges.to(i) - edges.from(i);
    slope += corners[i].z * glm::dvec2(-along.y, along.x) / edges.area;
    farthest = glm::max(farthest, glm::abs(edges.at[i]));
    from_corner = glm::max(from_corner, glm::abs(p - edges.at[i]));
    most = std::max(most, std::abs(corners[i].z));
  }
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {  // differences of depths times the other side's length
    const glm::dvec2 other = glm::abs(edges.at[3 - i] - edges.at[0]);
    slope_terms += std::abs(corners[i].z - corners[0].z) * glm::dvec2(other.y, other.x);
  }
  const glm::dvec2 slope_error = (slope_terms + edges.area_terms * glm::abs(slope)) / std::abs(edges.area);
  return or_infinite(4 *
                     (most + sum_of(glm::abs(slope) * (glm::abs(p) + farthest)) + sum_of(slope_error * from_corner)));
}

double error_by_edge_equations(const WindowCorners& corners, glm::dvec2 p) {
  const Edges edges(corners);
  double z = 0, out = 0, c_terms = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 along = edges.to(i) - edges.from(i),
                     ends = glm::abs(edges.from(i)) + glm::abs(edges.to(i));  // c = -(a x + b y) of their middle, or so
    const double of_c = ends.x * ends.y;
    out += std::abs(corners[i].z) * (std::abs(along.y * p.x) + std::abs(along.x * p.y) + of_c);
    c_terms += of_c;
    z += corners[i].z * edges.share(i, p);
  }
  return or_infinite(10 * (out + std::abs(z) * c_terms) / std::abs(edges.area));
}

double error_by_steps(Conventions::DepthArithmetic arithmetic, const WindowCorners& corners, glm::dvec2 p,
                      glm::dvec2 frame) {
  const Edges edges(corners);
  double slope = 0, most = 0;
  glm::dvec2 low(corners[0]), high(corners[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    slope -= corners[i].z * (edges.to(i) - edges.from(i)).y / edges.area;
    most = std::max(most, std::abs(corners[i].z));
    low = glm::min(low, edges.at[i]);
    high = glm::max(high, edges.at[i]);
  }
  const glm::dvec2 way = glm::min(glm::max(glm::abs(p - low), glm::abs(high - p)), frame);  // from either side
  const double of_edge = arithmetic == Conventions::DepthArithmetic::in_float_stepped
                             ? stepped_edge(way.y, std::max(std::abs(low.x), std::abs(high.x)))
                             : 0;
  return or_infinite(most * steps_over(way) + of_edge * std::abs(slope));
}

double error_by_stepped_edges(const WindowCorners& corners, glm::dvec2 p, glm::dvec2 frame) {
  const Edges edges(corners);
  glm::dvec2 low = p, high = p;
  for (const glm::dvec2& corner : edges.at) {
    low = glm::min(low, corner - 1.0);
    high = glm::max(high, corner + 1.0);
  }
  low = glm::max(low, frame == kNoSides ? -frame : glm::dvec2(0));
  high = glm::min(high, frame);
  const glm::dvec2 box = high - low;
  std::array<double, 3> of_share{};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 along = edges.to(i) - edges.from(i);
    double most = 0, most_terms = 0;
    for (const glm::dvec2 at : {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)}) {
      most = std::max(most, std::abs(cross(along, at - edges.from(i))));
      most_terms = std::max(most_terms, terms(along, at - edges.from(i)));
    }
    const double of_steps = steps_over(box) * most + terms(along, box + 2.0);
    of_share[i] = (4 * most_terms + of_steps) / std::abs(edges.area);
  }
  const auto of_sum = [&](double origin) {  // of z - origin, as a sum of shares
    double out = 0;
    for (std::size_t i = 0; i < 3; ++i) out += std::abs(corners[i].z - origin) * of_share[i];
    return out;
  };
  return or_infinite(std::max({of_sum(0), of_sum(corners[0].z), of_sum(corners[1].z), of_sum(corners[2].z)}));
}

namespace {

// error_of_inv_w() of corners of which the largest |z_i - z_of_zero| is `most`.
double error_of_inv_w_within(double z_of_zero, double most) { return kU * (std::abs(z_of_zero) + 4 * most); }

}  // namespace

double error_of_inv_w(const WindowCorners& corners, std::optional<double> z_of_zero) {
  if (!z_of_zero) return 0;
  double most = 0;
  for (const glm::dvec3& corner : corners) most = std::max(most, std::abs(corner.z - *z_of_zero));
  return error_of_inv_w_within(*z_of_zero, most);
}

double depth_error(Conventions::DepthArithmetic arithmetic, const WindowCorners& corners, glm::dvec2 p,
                   glm::dvec2 frame, std::optional<double> z_of_zero) {
  using enum Conventions::DepthArithmetic;
  if (z_of_zero) {
    WindowCorners from = corners;
    for (glm::dvec3& corner : from) corner.z -= *z_of_zero;
    const double by_inv_w = depth_error(arithmetic, from, p, frame) + error_of_inv_w(corners, z_of_zero);
    return std::max(by_inv_w, depth_error(arithmetic, corners, p, frame));
  }
  if (arithmetic == in_double) return 0;
  double out = std::max(error_by_edge_functions(corners, p), error_by_plane(corners, p));
  if (is_from_origin(arithmetic)) out = std::max(out, error_by_edge_equations(corners, p));
  if (steps_depths(arithmetic)) out += error_by_steps(arithmetic, corners, p, frame);
  if (arithmetic == in_float_stepped_edges) out += error_by_stepped_edges(corners, p, frame);
  return kU * (out + 1);
}

double shares_error(Conventions::DepthArithmetic arithmetic, const WindowCorners& corners, glm::dvec2 p,
                    glm::dvec2 frame) {
  double out = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    WindowCorners share = corners;
    for (std::size_t k = 0; k < 3; ++k) share[k].z = i == k ? 1 : 0;
    out += depth_error(arithmetic, share, p, frame);
  }
  return out;
}

double attribute_error(double shares, double most) {
  if (shares == 0) return 0;
  return shares < 1 ? 2 * most * shares / (1 - shares) : kInfinity;
}

// A triangle of altitude h has A >= h L, L its longest side, at most the window's diagonal D: no less than h^2. Depths
// are at most 1, less z_of_zero at most `most`; their gradient g is at most 2 / h. Products of differences are at most
// L D, those of positions at most 4 times the window's area. A plane's differences of depths are at most g L, so that
// its gradient is off by 3 sqrt(2) g L / h or less (both components together), over a distance of at most D. A stepped
// edge function is at most L (D + 2).
double depth_error_of_pieces(Conventions::DepthArithmetic arithmetic, double altitude, double slope, glm::dvec2 window,
                             glm::dvec2 frame, std::optional<double> z_of_zero) {
  using enum Conventions::DepthArithmetic;
  const double from = z_of_zero.value_or(0), most = std::max({1.0, std::abs(from), std::abs(1 - from)}),
               of_inv_w = z_of_zero ? error_of_inv_w_within(from, most) : 0;
  if (arithmetic == in_double) return of_inv_w;
  if (!(altitude > 0)) return kInfinity;
  const double diagonal = glm::length(window), thin = diagonal / altitude,
               rise = std::min(slope, 2 / altitude) * diagonal;
  const double by_edges = 4 * most * (3 * 2 * thin + 2 * thin + 1),
               by_plane = 4 * (most + 2 * rise + 3 * std::sqrt(2.0) * rise * thin),
               by_equations = most * 10 * 30 * window.x * window.y / (altitude * altitude);
  const glm::dvec2 stepped = glm::min(window, frame);
  const double of_edge = arithmetic == in_float_stepped ? stepped_edge(stepped.y + 1, window.x) * rise / diagonal : 0,
               by_steps = steps_depths(arithmetic) ? most * (sum_of(stepped) + 6) + of_edge : 0,
               by_stepped_edges =
                   most * 3 *
                   ((4 * std::numbers::sqrt2 + steps_over(stepped + 2.0)) * (diagonal + 3) + sum_of(stepped) + 8) /
                   altitude,
               steps = arithmetic == in_float_stepped_edges ? by_stepped_edges : by_steps,
               in_differences = std::max(by_edges, by_plane),
               of_depth = is_from_origin(arithmetic) ? std::max(in_differences, by_equations) : in_differences;
  return kU * (of_depth + steps + 1) + of_inv_w;
}

}  // namespace plumbline
