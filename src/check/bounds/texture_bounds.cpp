#include "check/bounds/texture_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/bounds/units.h"
#include "reference/arithmetic/texture.h"

namespace plumbline::check {

double largest_texel(const Texture& texture) {
  float out = 1;
  for (const glm::vec4& t : texture.levels[0].texels) {
    const glm::vec4 a = glm::abs(t);
    out = std::max({out, a.r, a.g, a.b, a.a});
  }
  return out;
}

namespace {

/// Error of texture coordinates: of s and t, and of their product with a level's size, its fraction and the half texel.
Vec2<double> coordinate_error(Vec2<double> st, Vec2<double> st_error) { return st_error + 4 * u * glm::abs(st); }

/// True if `error` reaches half a texel, the limit of TexelRange's slopes, in a level that may be filtered linearly.
bool beyond_slopes(const Texture& texture, const TexelRange& range, Vec2<double> error) {
  if (range.last_linear < range.first_linear) return false;
  const TextureLevel& finest = texture.levels[static_cast<std::size_t>(range.first_linear)];
  return !(std::max(error.s * finest.width, error.t * finest.height) < 0.5);
}

}  // namespace

TexelBound texel_bound(const Texture& texture, const TexelRange& range, Vec2<double> st, Vec2<double> st_error,
                       double arithmetic) {
  const Vec2<double> error = coordinate_error(st, st_error);
  TexelBound out{range, Vec4<double>(0)};
  const auto known = [&](int k) { return error[k] == 0 || error[k] < range.gap[k]; };
  const bool finite = std::isfinite(error.s + error.t);
  const bool open = !(finite && known(0) && known(1)) || beyond_slopes(texture, range, error);
  out.slack = open ? Vec4<double>(std::numeric_limits<double>::infinity())
                   : range.slope_s * error.s + range.slope_t * error.t + arithmetic;
  return out;
}

OpenShare open_share(const Texture& texture, const TexelRange& range, const PlaneValue& plane, Vec2<double> st_error) {
  OpenShare out;
  const Vec2<double> st(plane.value), error = coordinate_error(st, st_error);
  if (!std::isfinite(error.s + error.t) || beyond_slopes(texture, range, error)) return {1, true};
  for (int number = range.first_nearest; number <= range.last_nearest; ++number) {
    const TextureLevel& level = texture.levels[static_cast<std::size_t>(number)];
    const Vec2<double> size(level.width, level.height);
    for (int k = 0; k < 2; ++k) {
      const double at = size[k] * st[k], from_line = std::abs(at - std::round(at)), w = size[k] * error[k];
      const double slope = std::min(size[k] * std::hypot(plane.d_dx[k], plane.d_dy[k]), 0.5);
      out.centre = out.centre || (w > 0 && from_line <= w);
      if (w > 0 && from_line <= std::max(w, slope)) out.area += std::min(1.0, w / slope);
    }
  }
  out.area = std::min(out.area, 1.0);
  return out;
}

std::string_view mesas_other_level(const Texture& texture, const TexelRange& range) {
  const Sampler& s = texture.sampler;
  const double lo = range.lambda_lo, hi = range.lambda_hi;
  const bool late = s.mag == MagFilter::linear &&
                    (s.min == MinFilter::nearest_mipmap_nearest || s.min == MinFilter::nearest_mipmap_linear);
  if (late && hi > 0 && lo <= 0.5) return "Mesa switches to nearest mipmaps at a lambda of 0, the specification at 1/2";
  const bool one_level = s.min == MinFilter::nearest_mipmap_nearest || s.min == MinFilter::linear_mipmap_nearest;
  const auto rounded_up = [&](double lambda) { return lo <= lambda && lambda <= hi && std::fmod(lambda, 2.0) == 1.5; };
  if (one_level && (rounded_up(s.min_lod) || rounded_up(s.max_lod)))
    return "Mesa rounds a lambda half way between two levels to the even one, the specification down";
  return {};
}

Environed environ_error(TextureFormat format, const DrawTexture& state, const Vec4<double>& f,
                        const Vec4<double>& f_error, const Vec4<double>& s, const Vec4<double>& s_error,
                        const Roundings& roundings) {
  using math::Bounded;
  Environed out{};
  for (int c = 0; c < 4; ++c) {
    const Bounded v = math::textured_channel<Bounded>(
        {format, state.environment, c == 3}, {f[c], f_error[c]}, {s[c], s_error[c]}, {s.a, s_error.a},
        {static_cast<double>(state.color[c]), 0}, math::Rounding{roundings});
    out.color[c] = v.value;
    out.error[c] = v.error;
  }
  return out;
}

}  // namespace plumbline::check
