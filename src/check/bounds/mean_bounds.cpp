#include "check/bounds/mean_bounds.h"

#include <algorithm>
#include <cmath>

#include "check/bounds/bounds.h"

namespace plumbline::check {

PlaneValue color_of_plane(const WindowTriangle<double>& t, int x, int y) {
  const Barycentrics b = barycentrics(t, x + 0.5, y + 0.5);
  const Vec3<double> inv_w(t.v[0].inv_w, t.v[1].inv_w, t.v[2].inv_w);
  const double q = glm::dot(b.value, inv_w);
  const auto sum = [&](const Vec3<double>& weights, const Vec4<double>& from) {
    Vec4<double> out(0);
    for (int i = 0; i < 3; ++i) out += weights[i] * inv_w[i] / q * (t.v[static_cast<std::size_t>(i)].color - from);
    return out;
  };
  const Vec4<double> value = sum(b.value, Vec4<double>(0));
  return {value, sum(b.d_dx, value), sum(b.d_dy, value)};
}

Vec4<double> slope_rounding(const WindowTriangle<double>& t, int x, int y, const SlopeArithmetic& arithmetic) {
  const Barycentrics b = barycentrics(t, x + 0.5, y + 0.5);
  const PlaneValue plane = color_of_plane(t, x, y);
  const Vec4<double> size = glm::abs(plane.value), slope = glm::max(glm::abs(plane.d_dx), glm::abs(plane.d_dy));
  double q = 0, q_slope = 0, q_error = 0, q_slope_error = 0;
  Vec4<double> error(0), slope_error(0);  // of c/w and its slope
  for (int i = 0; i < 3; ++i) {
    const WindowVertex<double>& v = t.v[static_cast<std::size_t>(i)];
    const double steep = std::abs(b.d_dx[i]) + std::abs(b.d_dy[i]), terms = arithmetic.rounding * std::abs(v.inv_w);
    q += b.value[i] * v.inv_w;
    q_slope += steep * std::abs(v.inv_w);
    q_error += terms * (1 + arithmetic.pixels * steep);
    q_slope_error += terms * steep;
    error += terms * (1 + arithmetic.pixels * steep) * glm::abs(v.color);
    slope_error += terms * steep * glm::abs(v.color);
  }
  q = std::abs(q);
  const Vec4<double> of_slopes =
      (slope_error + size * q_slope_error + (error + size * q_error) * (q_slope / q) + slope * q_error) / q;
  if (!arithmetic.by_differences) return of_slopes;
  return glm::max(of_slopes, 2.0 * ((error + size * q_error) / q + arithmetic.rounding * size));
}

double depth_rounding(const WindowTriangle<double>& t) {
  constexpr double kTerms = 6 * 0x1p-53, kPixels = 128;
  const Vec3<double> z(t.v[0].p_win.z, t.v[1].p_win.z, t.v[2].p_win.z);
  const glm::dvec2 slopes = depth_slopes(t);
  const double most = std::max({std::abs(z.x), std::abs(z.y), std::abs(z.z)});
  const double out = kTerms * (most + kPixels * (slopes.x + slopes.y));
  return std::isfinite(out) ? out : 0;
}

namespace {

// Changes of the three q_i and of their sum within a block of 4 x 4 pixels in which a pipeline may evaluate them in
// float: there the changes of q_1, q_2 and the sum are at most half of the least 1/w (kernels/attributes.h,
// changes_little). Elsewhere 0.
struct BlockChanges {
  Vec3<double> q{0};
  double sum = 0;
};
BlockChanges block_changes(const WindowTriangle<double>& t, const Barycentrics& b) {
  constexpr double kSteps = 3, kNearlyHalf = 0.5 + 1e-6;  // planes differ in their last bits
  if (t.corners < 3) return {};
  const Vec3<double> inv_w(t.v[0].inv_w, t.v[1].inv_w, t.v[2].inv_w);
  const double sum = kSteps * (std::abs(glm::dot(b.d_dx, inv_w)) + std::abs(glm::dot(b.d_dy, inv_w)));
  const Vec3<double> q = kSteps * (glm::abs(b.d_dx) + glm::abs(b.d_dy)) * inv_w;
  const double most = kNearlyHalf * std::min({inv_w.x, inv_w.y, inv_w.z});
  return std::max({q.y, q.z, sum}) <= most ? BlockChanges{q, sum} : BlockChanges{};
}

}  // namespace

Vec4<double> bounds_of_mean(const WindowTriangle<double>& t, int x, int y) {
  const Barycentrics b = barycentrics(t, x + 0.5, y + 0.5);
  const BlockChanges changes = block_changes(t, b);
  const Vec3<double> q = b.value * Vec3<double>(t.v[0].inv_w, t.v[1].inv_w, t.v[2].inv_w);
  const double sum = q.x + q.y + q.z;
  const double condition = (std::abs(q.x) + std::abs(q.y) + std::abs(q.z)) / std::abs(sum);
  const Vec4<double> d1 = t.v[1].color - t.v[0].color, d2 = t.v[2].color - t.v[0].color;
  const Vec4<double> mean = t.v[0].color + (q.y / sum) * d1 + (q.z / sum) * d2;
  // A corner's share of nearly 0 keeps its rounding in double: 2^-52 of terms anchored a tile away.
  const auto share = [&](int i) {
    const double k = std::abs(q[i] / sum), terms = 1 + 128 * (std::abs(b.d_dx[i]) + std::abs(b.d_dy[i]));
    return condition * k + 0x1p-28 * terms * std::abs(t.v[static_cast<std::size_t>(i)].inv_w / sum) +
           0.4 * (changes.q[i] + k * changes.sum) / std::abs(sum);
  };
  return 0.2 * (glm::abs(mean) + glm::abs(t.v[0].color)) + share(1) * glm::abs(d1) + share(2) * glm::abs(d2);
}

}  // namespace plumbline::check
