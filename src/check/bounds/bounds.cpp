#include "check/bounds/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "reference/arithmetic/polygon_offset.h"

namespace plumbline::check {

Barycentrics along_line(const WindowTriangle<double>& t, double x, double y) {
  const Vec2<double> a(t.v[0].p_win), d = Vec2<double>(t.v[1].p_win) - a;
  const double square = glm::dot(d, d), of = square > 0 ? 1 / square : 0;
  const double share = glm::dot(Vec2<double>(x, y) - a, d) * of;
  return {{1 - share, share, 0}, {-d.x * of, d.x * of, 0}, {-d.y * of, d.y * of, 0}};
}

Barycentrics barycentrics(const WindowTriangle<double>& t, double x, double y) {
  if (t.corners < 3) return along_line(t, x, y);
  Vec2<double> p[3];
  for (std::size_t i = 0; i < 3; ++i) p[i] = Vec2<double>(t.v[i].p_win);
  const auto area = [&] { return (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x); };
  double a = area();
  if (!(t.front ? a > 0 : a < 0)) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = Vec2<double>(t.v[i].snapped) / 256.0 + 0.5;
    a = area();
  }
  Barycentrics out;
  for (int i = 0; i < 3; ++i) {
    const Vec2<double> from = p[(i + 1) % 3], to = p[(i + 2) % 3];
    out.d_dx[i] = (from.y - to.y) / a;
    out.d_dy[i] = (to.x - from.x) / a;
    out.value[i] = out.d_dx[i] * (x - from.x) + out.d_dy[i] * (y - from.y);
  }
  return out;
}

glm::dvec2 depth_slopes(const WindowTriangle<double>& t) {
  const Vec3<double> z(t.v[0].p_win.z, t.v[1].p_win.z, t.v[2].p_win.z);
  const Barycentrics b = barycentrics(t, t.v[0].p_win.x, t.v[0].p_win.y);
  return {std::abs(glm::dot(b.d_dx, z)), std::abs(glm::dot(b.d_dy, z))};
}

namespace {

// Depth and colour at a share of the way along a line.
struct OfLine {
  double depth;
  Vec4<double> color;
};
OfLine at_share(const WindowTriangle<double>& t, double share, const DepthLimits& limits) {
  const double q0 = (1 - share) * t.v[0].inv_w, q1 = share * t.v[1].inv_w;
  return {std::clamp((1 - share) * t.v[0].p_win.z + share * t.v[1].p_win.z, limits.low, limits.high),
          (q0 * t.v[0].color + q1 * t.v[1].color) / (q0 + q1)};
}

double distance_from_line(const WindowTriangle<double>& t, double x, double y) {
  const Vec2<double> a(t.v[0].p_win), b(t.v[1].p_win);
  const double share = std::clamp(along_line(t, x, y).value[1], 0.0, 1.0);
  return glm::distance(Vec2<double>(x, y), a + share * (b - a));
}

}  // namespace

Vec4<double> magnitude(const Mat4<double>& m, const Vec4<double>& p) {
  Vec4<double> out(0);
  for (int column = 0; column < 4; ++column) out += glm::abs(m[column]) * std::abs(p[column]);
  return out;
}

namespace {

// |M| |v|.
Vec3<double> terms(const Mat3<double>& m, const Vec3<double>& v) {
  Vec3<double> sum(0);
  for (int column = 0; column < 3; ++column) sum += glm::abs(m[column]) * std::abs(v[column]);
  return sum;
}

}  // namespace

double normal_magnitude(const Mat3<double>& n_matrix, const Vec3<double>& n) {
  return glm::length(terms(n_matrix, n)) / glm::length(n_matrix * n);
}

double inverted_normal_magnitude(const Mat4<double>& model_view, const Mat3<double>& n_matrix, const Vec3<double>& n) {
  const Mat3<double> transposed = glm::transpose(Mat3<double>(model_view));
  return glm::length(terms(n_matrix, terms(transposed, terms(n_matrix, n)))) / glm::length(n_matrix * n);
}

namespace {

// Cancellation in the gradients of a triangle's planes. The relative error of a gradient is u * share * longest.
struct Cancelled {
  Vec2<double> e1;
  double longest, area, share;
};
Cancelled cancelled_in(const WindowTriangle<double>& t) {
  const auto& v = t.v;
  double farthest = 0;
  for (const auto& corner : v) farthest = std::max({farthest, std::abs(corner.p_win.x), std::abs(corner.p_win.y)});
  // Every gradient is a sum of products of differences over the area, in float. Cancellation: at most the longest side
  // times the window position, over the area (of a line: the squared length).
  const Vec2<double> e1 = Vec2<double>(v[1].p_win) - Vec2<double>(v[0].p_win);
  const Vec2<double> e2 = Vec2<double>(v[2].p_win) - Vec2<double>(v[0].p_win);
  const double longest = std::max({std::abs(e1.x), std::abs(e1.y), std::abs(e2.x), std::abs(e2.y)});
  const double area = t.corners == 3 ? std::abs(e1.x * e2.y - e1.y * e2.x) : std::max(glm::dot(e1, e1), 1e-300);
  return {e1, longest, area, (longest + farthest) / area};
}

// Error of the gradient of a plane with the corner values f0, f1, f2 [u]; `steepest`: its larger component.
double gradient_bound(const WindowTriangle<double>& t, double f0, double f1, double f2, double steepest) {
  const Cancelled c = cancelled_in(t);
  const double range = std::max(std::abs(f1 - f0), std::abs(f2 - f0));
  return c.longest / c.area * range + c.share * c.longest * steepest;
}

// bounds_from_origin() by the barycentrics `b`.
PlaneBounds bounds_by(const WindowTriangle<double>& t, const Barycentrics& b, int x, int y) {
  constexpr double kFlushed = kFlushedUnderflow / kFloatRounding;
  const Cancelled cancelled = cancelled_in(t);
  const auto& v = t.v;
  double x0 = 0, y0 = 0, from_corner = 0;
  for (const auto& corner : v) {
    x0 = std::max(x0, std::abs(corner.p_win.x));
    y0 = std::max(y0, std::abs(corner.p_win.y));
    from_corner = std::max({from_corner, std::abs(x + 0.5 - corner.p_win.x), std::abs(y + 0.5 - corner.p_win.y)});
  }
  // Flushing: a gradient has five results (two differences over the area, two products, their difference). Their errors
  // are multiplied by the ways to the origin and to the pixel; eight other results are flushed once.
  const double flushed = kFlushed * (8 + (3 + 2 * cancelled.longest / cancelled.area) * (x + x0 + y + y0));
  // {value at the pixel, bound} of the plane through the corners' values.
  const auto plane = [&](double f0, double f1, double f2) {
    const Vec3<double> f(f0, f1, f2);
    const double d_dx = std::abs(glm::dot(b.d_dx, f)), d_dy = std::abs(glm::dot(b.d_dy, f));
    const double gradient_error = gradient_bound(t, f0, f1, f2, std::max(d_dx, d_dy));
    return std::pair(glm::dot(b.value, f), std::max({std::abs(f0), std::abs(f1), std::abs(f2)}) + d_dx * (x + x0) +
                                               d_dy * (y + y0) + gradient_error * from_corner + flushed);
  };
  PlaneBounds out;
  out.depth = 1 + plane(v[0].p_win.z, v[1].p_win.z, v[2].p_win.z).second;
  const auto [inv_w, e_inv_w] = plane(v[0].inv_w, v[1].inv_w, v[2].inv_w);
  out.inv_w = e_inv_w / std::abs(inv_w);
  for (int c = 0; c < 4; ++c) {
    const auto [q, e_q] = plane(v[0].color[c] * v[0].inv_w, v[1].color[c] * v[1].inv_w, v[2].color[c] * v[2].inv_w);
    out.color[c] = (e_q + std::abs(q / inv_w) * e_inv_w) / std::abs(inv_w) + kFlushed;
  }
  return out;
}

// Weights along a line, by the position on the major axis alone; value[1] is the weight of the line's second end.
Barycentrics along_major(const WindowTriangle<double>& t, const Vec2<double>& e1, int x, int y) {
  const auto in_float = [](double d) { return std::abs(static_cast<float>(d)); };  // x where they are as long
  const int major = in_float(e1.x) >= in_float(e1.y) ? 0 : 1;
  const double share = ((major == 0 ? x : y) + 0.5 - t.v[0].p_win[major]) / e1[major], slope = 1 / e1[major];
  const Vec3<double> gradient(-slope, slope, 0);
  return {{1 - share, share, 0}, major == 0 ? gradient : Vec3<double>(0), major == 0 ? Vec3<double>(0) : gradient};
}

}  // namespace

Vec4<double> PlaneBounds::color_error(double factor) const {
  const double left = 1 - factor * kFloatRounding * inv_w;
  if (!(left > 0)) return Vec4<double>(std::numeric_limits<double>::infinity());
  return factor * kFloatRounding / left * color;
}

DepthLimits depth_limits(const DrawIndex& draws, std::int32_t primitive) {
  const Draw* draw = draws.scene().depth_clamp ? draws.draw(static_cast<std::uint32_t>(primitive)) : nullptr;
  if (draw == nullptr) return {};
  const auto [low, high] = std::minmax(draw->depth_range.near, draw->depth_range.far);
  return {low, high};
}

PlaneBounds bounds_from_origin(const WindowTriangle<double>& t, int x, int y, const DepthLimits& limits) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (area_may_vanish(t)) return {kInfinity, Vec4<double>(kInfinity)};
  const Barycentrics b = barycentrics(t, x + 0.5, y + 0.5);
  PlaneBounds out = bounds_by(t, b, x, y);
  if (t.corners != 2) return out;
  const Vec2<double> e1 = cancelled_in(t).e1;
  if (e1 == Vec2<double>(0)) return out;
  const Barycentrics by_major = along_major(t, e1, x, y);
  const PlaneBounds along_bounds = bounds_by(t, by_major, x, y);
  out.depth = std::max(out.depth, along_bounds.depth);
  out.color = glm::max(out.color, along_bounds.color);
  out.inv_w = std::max(out.inv_w, along_bounds.inv_w);
  const OfLine projected = at_share(t, b.value[1], limits), along = at_share(t, by_major.value[1], limits);
  out.line_shift_depth = along.depth - projected.depth;
  out.line_shift_color = along.color - projected.color;
  return out;
}

bool area_may_vanish(const WindowTriangle<double>& t) {
  if (t.corners < 3) return false;
  const Vec2<double> a(t.v[0].p_win), e1 = Vec2<double>(t.v[1].p_win) - a, e2 = Vec2<double>(t.v[2].p_win) - a;
  const double terms = std::abs(e1.x * e2.y) + std::abs(e1.y * e2.x);
  return std::abs(e1.x * e2.y - e1.y * e2.x) <= 3 * kFloatRounding * terms;
}

bool is_near(const WindowTriangle<double>& t, int x, int y) {
  const Vec3<double> b = barycentrics(t, x + 0.5, y + 0.5).value;
  return std::min({b.x, b.y, b.z}) >= -1.0 / 64;
}

std::span<const WindowTriangle<double>> triangles_of(const Records<double>& r, std::int32_t primitive) {
  const auto number = [](const WindowTriangle<double>& t) { return static_cast<std::int32_t>(t.primitive); };
  return std::ranges::equal_range(r.triangles, primitive, {}, number);
}

namespace {

// True if the pixel's centre is inside the triangle or within a pixel of its outline; always of lines.
bool reaches(const WindowTriangle<double>& t, int x, int y) {
  if (t.corners < 3) return true;
  const Vec2<double> centre(x + 0.5, y + 0.5);
  const Vec3<double> b = barycentrics(t, centre.x, centre.y).value;
  if (std::min({b.x, b.y, b.z}) >= 0) return true;
  WindowTriangle<double> edges = t;  // distance_from_line() takes the first edge
  for (int i = 0; i < 3; ++i) {
    if (!(distance_from_line(edges, centre.x, centre.y) > 1)) return true;
    std::rotate(edges.v.begin(), edges.v.begin() + 1, edges.v.end());
  }
  return false;
}

// Calls visit(t) for each window triangle of the primitive that reaches the pixel; if none does, for all of them.
void each_at(const Records<double>& r, std::int32_t primitive, int x, int y, auto visit) {
  const std::span<const WindowTriangle<double>> all = triangles_of(r, primitive);
  const auto is_here = [&](const WindowTriangle<double>& t) { return all.size() == 1 || reaches(t, x, y); };
  const bool any = std::ranges::any_of(all, is_here);
  for (const WindowTriangle<double>& t : all) {
    if (!any || is_here(t)) visit(t);
  }
}

}  // namespace

PlaneBounds primitive_bounds(const Records<double>& r, std::int32_t primitive, int x, int y,
                             const DepthLimits& limits) {
  PlaneBounds out{1, Vec4<double>(1)};
  double nearest = std::numeric_limits<double>::infinity();
  each_at(r, primitive, x, y, [&](const WindowTriangle<double>& t) {
    const PlaneBounds b = bounds_from_origin(t, x, y, limits);
    out.depth = std::max(out.depth, b.depth);
    out.color = glm::max(out.color, b.color);
    out.inv_w = std::max(out.inv_w, b.inv_w);
    const double distance = distance_from_line(t, x + 0.5, y + 0.5);
    if (distance >= nearest) return;
    nearest = distance;  // of an unfilled triangle, the edge nearest the pixel
    out.line_shift_depth = b.line_shift_depth;
    out.line_shift_color = b.line_shift_color;
  });
  return out;
}

OffsetErrors::OffsetErrors(const Scene& scene, const Conventions& conventions)
    : draws_(scene), conventions_(conventions) {
  any_ = std::ranges::any_of(scene.draws, [](const Draw& draw) { return draw.polygon_offset != PolygonOffset{}; });
}

double OffsetErrors::of(const WindowTriangle<double>& t) const {
  const Draw* draw = any_ && t.corners == 3 ? draws_.draw(t.primitive) : nullptr;
  if (draw == nullptr || draw->polygon_offset == PolygonOffset{}) return 0;
  const PolygonOffset& offset = draw->polygon_offset;
  const Vec3<double> z(t.v[0].p_win.z, t.v[1].p_win.z, t.v[2].p_win.z);
  const glm::dvec2 slopes = depth_slopes(t);
  const double m = std::max(slopes.x, slopes.y);
  const double factor = std::abs(static_cast<double>(offset.factor)), units = static_cast<double>(offset.units);
  const auto r = math::offset_unit(draws_.scene().frame.depth, conventions_, std::max({z.x, z.y, z.z}));
  return factor * (4 * m + gradient_bound(t, z.x, z.y, z.z, m)) +
         2 * (factor * m + std::abs(units) * static_cast<double>(r));
}

double OffsetErrors::factor_of(const WindowTriangle<double>& t) const {
  const Draw* draw = any_ && t.corners == 3 ? draws_.draw(t.primitive) : nullptr;
  return draw == nullptr ? 0 : static_cast<double>(draw->polygon_offset.factor);
}

double OffsetErrors::by_length(const WindowTriangle<double>& t) const {
  const double factor = factor_of(t);
  if (factor == 0) return 0;
  const glm::dvec2 slopes = depth_slopes(t);
  return factor * (glm::length(slopes) - std::max(slopes.x, slopes.y));
}

double OffsetErrors::by_grid(const WindowTriangle<double>& t) const {
  const double factor = factor_of(t);
  if (factor == 0) return 0;
  WindowTriangle<double> snapped = t;
  for (WindowVertex<double>& v : snapped.v) {
    v.p_win.x = 0.5 + v.snapped.x / double{kSubpixel};
    v.p_win.y = 0.5 + v.snapped.y / double{kSubpixel};
  }
  const glm::dvec2 on_grid = depth_slopes(snapped), slopes = depth_slopes(t);
  const double moved = factor * (std::max(on_grid.x, on_grid.y) - std::max(slopes.x, slopes.y));
  return std::isfinite(moved) ? moved : 0;
}

double OffsetErrors::of(const Records<double>& r, std::int32_t primitive, int x, int y) const {
  double most = 0;
  if (!any_) return most;
  each_at(r, primitive, x, y, [&](const WindowTriangle<double>& t) { most = std::max(most, of(t)); });
  return most;
}

std::vector<EdgeValue> edge_values(std::span<const WindowTriangle<double>> edges, int x, int y,
                                   const DepthLimits& limits) {
  std::vector<EdgeValue> out;
  for (const WindowTriangle<double>& t : edges) {
    if (t.corners != 2 || distance_from_line(t, x + 0.5, y + 0.5) > t.width + 2.0) continue;
    const OfLine projected = at_share(t, along_line(t, x + 0.5, y + 0.5).value[1], limits);
    const PlaneBounds along = bounds_from_origin(t, x, y, limits);
    out.push_back({projected.depth, projected.color});
    out.push_back({projected.depth + along.line_shift_depth, projected.color + along.line_shift_color});
  }
  if (out.size() <= 2) out.clear();
  return out;
}

namespace {

// Coverage of a pixel by a point: a square about the nearest centre (odd sizes) or corner of pixels (stages.h, 5).
bool covers(const WindowTriangle<double>& point, int x, int y) {
  const Vec2<double> p = Vec2<double>(point.v[0].snapped) / static_cast<double>(kSubpixel) + 0.5;
  const Vec2<double> middle = point.width % 2 == 1 ? glm::floor(p) + 0.5 : glm::floor(p + 0.5);
  const Vec2<double> off = glm::abs(Vec2<double>(x + 0.5, y + 0.5) - middle);
  return std::max(off.x, off.y) < point.width / 2.0;
}

}  // namespace

std::vector<EdgeValue> tied_corners(std::span<const WindowTriangle<double>> corners, int x, int y, double tie) {
  std::vector<EdgeValue> there, out;
  for (const WindowTriangle<double>& t : corners) {
    if (t.corners == 1 && covers(t, x, y)) there.push_back({t.v[0].p_win.z, t.v[0].color});
  }
  // A point has no slopes: z0 brought to the origin and back, four roundings of |z| each.
  const auto ties = [&](const EdgeValue& a, const EdgeValue& b) {
    return std::abs(a.depth - b.depth) <= tie + 4 * kFloatRounding * (std::abs(a.depth) + std::abs(b.depth));
  };
  for (const EdgeValue& value : there) {
    if (std::ranges::count_if(there, [&](const EdgeValue& other) { return ties(value, other); }) > 1)
      out.push_back(value);
  }
  return out;
}

}  // namespace plumbline::check
