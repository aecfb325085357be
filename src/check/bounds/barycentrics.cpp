#include "check/bounds/barycentrics.h"

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

}  // namespace plumbline::check
