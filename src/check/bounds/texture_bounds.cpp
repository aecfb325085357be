#include "check/bounds/texture_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/bounds/units.h"

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

/// Whether a place off by `error` may be half a texel off, beyond TexelRange's slopes, in a level filtered linearly.
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
  using E = TextureEnvironment;
  const bool has_color = format != TextureFormat::alpha, intensity = format == TextureFormat::intensity;
  const bool has_alpha = format != TextureFormat::luminance && format != TextureFormat::rgb;
  // f (1 - k) + c k of a fragment's f, a constant or texel c, and a share k.
  struct Value {
    double value, error;
  };
  const auto mixed = [&](Value a, Value b, Value k) -> Value {
    const double v = a.value * (1 - k.value) + b.value * k.value;
    const double error = std::abs(1 - k.value) * a.error + std::abs(k.value) * b.error +
                         (std::abs(b.value - a.value) + a.error + b.error) * k.error;
    return {v, error + roundings(std::abs(a.value * (1 - k.value)) + std::abs(b.value * k.value))};
  };
  const auto product = [&](Value a, Value b) -> Value {
    return {a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error +
                                   roundings(std::abs(a.value * b.value))};
  };
  const auto sum = [&](Value a, Value b) -> Value {
    const double v = a.value + b.value;
    return {std::clamp(v, 0.0, 1.0), a.error + b.error + roundings(std::abs(v))};
  };
  const auto of_f = [&](int k) { return Value{f[k], f_error[k]}; };
  const auto of_s = [&](int k) { return Value{s[k], s_error[k]}; };
  const auto constant = [&](int k) { return Value{static_cast<double>(state.color[k]), 0}; };
  const auto channel = [&](int k) -> Value {
    if (!has_color) return of_f(k);
    switch (state.environment) {
      case E::replace: return of_s(k);
      case E::modulate: return product(of_f(k), of_s(k));
      case E::decal: return format == TextureFormat::rgb ? of_s(k) : mixed(of_f(k), of_s(k), of_s(3));
      case E::blend: return mixed(of_f(k), constant(k), of_s(k));
      case E::add: return sum(of_f(k), of_s(k));
    }
    return of_f(k);
  };
  const auto alpha = [&]() -> Value {
    if (!has_alpha || state.environment == E::decal) return of_f(3);
    if (state.environment == E::replace) return of_s(3);
    if (intensity && state.environment == E::blend) return mixed(of_f(3), constant(3), of_s(3));
    if (intensity && state.environment == E::add) return sum(of_f(3), of_s(3));
    return product(of_f(3), of_s(3));
  };
  Environed out{};
  for (int k = 0; k < 4; ++k) {
    const Value v = k < 3 ? channel(k) : alpha();
    out.color[k] = v.value;
    out.error[k] = v.error;
  }
  return out;
}

}  // namespace plumbline::check
