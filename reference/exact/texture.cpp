#include "reference/exact/texture.h"

#include <algorithm>
#include <cmath>

namespace plumbline::exact {
namespace {

using Real = long double;

/// A coordinate of the unit interval, by the wrap mode (3.8.7); of clamp_to_edge and clamp_to_border, by the level's
/// size.
double wrapped(Wrap wrap, double s, int size) {
  const double half = 0.5 / size;
  switch (wrap) {
    case Wrap::repeat: return s - std::floor(s);
    case Wrap::mirrored_repeat: {
      const double fraction = s - std::floor(s);
      const double mirrored = std::fmod(std::floor(s), 2.0) == 0 ? fraction : 1 - fraction;
      return std::clamp(mirrored, half, 1 - half);
    }
    case Wrap::clamp_to_edge: return std::clamp(s, half, 1 - half);
    case Wrap::clamp_to_border: return std::clamp(s, -half, 1 + half);
  }
  return s;
}

/// A texel; one outside of the image is its neighbour around (repeat) or the border.
glm::dvec4 texel(const Texture& texture, const TextureLevel& level, int i, int j) {
  const Sampler& s = texture.sampler;
  const auto around = [](Wrap wrap, int at, int size) {
    if (wrap == Wrap::repeat) return at < 0 ? at + size : at >= size ? at - size : at;
    // Clamped to the edge, a texel beyond has the weight 0.
    return wrap == Wrap::clamp_to_border ? at : std::clamp(at, 0, size - 1);
  };
  const int x = around(s.wrap_s, i, level.width), y = around(s.wrap_t, j, level.height);
  if (x < 0 || y < 0 || x >= level.width || y >= level.height) {
    return glm::dvec4(source_components(texture.format, s.border));
  }
  return glm::dvec4(level.at(x, y));
}

glm::dvec4 in_level(const Texture& texture, int number, bool linear, glm::dvec2 st) {
  const TextureLevel& level = texture.levels[static_cast<std::size_t>(number)];
  const Sampler& s = texture.sampler;
  const double u = level.width * wrapped(s.wrap_s, st.s, level.width);
  const double v = level.height * wrapped(s.wrap_t, st.t, level.height);
  if (!linear) {
    // s = 1 after a repeat's rounding, or clamped to the edge's centre: the last texel.
    const auto at = [](Wrap wrap, double x, int size) {
      const int i = static_cast<int>(std::floor(x));
      return wrap == Wrap::clamp_to_border ? i : std::min(i, size - 1);
    };
    return texel(texture, level, at(s.wrap_s, u, level.width), at(s.wrap_t, v, level.height));
  }
  const int i0 = static_cast<int>(std::floor(u - 0.5)), j0 = static_cast<int>(std::floor(v - 0.5));
  const double a = u - 0.5 - i0, b = v - 0.5 - j0;
  return (1 - a) * (1 - b) * texel(texture, level, i0, j0) + a * (1 - b) * texel(texture, level, i0 + 1, j0) +
         (1 - a) * b * texel(texture, level, i0, j0 + 1) + a * b * texel(texture, level, i0 + 1, j0 + 1);
}

}  // namespace

TexturePlace texture_place(const WindowTriangle<double>& triangle, const std::array<glm::dvec2, 3>& texcoords,
                           const Barycentric& weights, int x, int y) {
  // Weights are affine: a step of one pixel is their derivative.
  const auto at = weights.at(x, y), right = weights.at(x + 1, y), above = weights.at(x, y + 1);
  const auto over_w = [&](const std::array<Real, 3>& b) {
    std::array<Real, 3> sum{};  // s/w, t/w, 1/w
    for (std::size_t i = 0; i < 3; ++i) {
      const Real q = b[i] * triangle.v[i].inv_w;
      sum[0] += q * texcoords[i].s;
      sum[1] += q * texcoords[i].t;
      sum[2] += q;
    }
    return sum;
  };
  const auto change = [](const std::array<Real, 3>& to, const std::array<Real, 3>& from) {
    return std::array<Real, 3>{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  };
  const auto f = over_w(at), d_dx = over_w(change(right, at)), d_dy = over_w(change(above, at));
  const Real s = f[0] / f[2], t = f[1] / f[2];
  const auto quotient = [&](const std::array<Real, 3>& d) {
    return glm::dvec2((d[0] - s * d[2]) / f[2], (d[1] - t * d[2]) / f[2]);
  };
  return {glm::dvec2(s, t), quotient(d_dx), quotient(d_dy)};
}

double level_of_detail(const Texture& texture, const TexturePlace& place) {
  const TextureLevel& base = texture.levels[static_cast<std::size_t>(texture.sampler.base_level)];
  const glm::dvec2 size(base.width, base.height);
  const double rho = std::max(glm::length(size * place.d_dx), glm::length(size * place.d_dy));
  const double lambda = (rho > 0 ? std::log2(rho) : -1e6) + static_cast<double>(texture.sampler.lod_bias);
  return std::clamp(lambda, static_cast<double>(texture.sampler.min_lod), static_cast<double>(texture.sampler.max_lod));
}

glm::dvec4 filtered_texel(const Texture& texture, glm::dvec2 st, double lambda) {
  const Sampler& s = texture.sampler;
  const int base = s.base_level, q = last_level(texture);
  const bool nearest_mipmap = s.min == MinFilter::nearest_mipmap_nearest || s.min == MinFilter::nearest_mipmap_linear;
  const double c = s.mag == MagFilter::linear && nearest_mipmap ? 0.5 : 0;
  if (lambda <= c) return in_level(texture, base, s.mag == MagFilter::linear, st);
  switch (s.min) {
    case MinFilter::nearest: return in_level(texture, base, false, st);
    case MinFilter::linear: return in_level(texture, base, true, st);
    case MinFilter::nearest_mipmap_nearest:
    case MinFilter::linear_mipmap_nearest: {
      // Equation 3.25.
      const int d = lambda <= 0.5              ? base
                    : base + lambda <= q + 0.5 ? static_cast<int>(std::ceil(base + lambda + 0.5)) - 1
                                               : q;
      return in_level(texture, d, s.min == MinFilter::linear_mipmap_nearest, st);
    }
    case MinFilter::nearest_mipmap_linear:
    case MinFilter::linear_mipmap_linear: {
      // Equations 3.26 to 3.28.
      const bool linear = s.min == MinFilter::linear_mipmap_linear;
      if (base + lambda >= q) return in_level(texture, q, linear, st);
      const int d1 = static_cast<int>(std::floor(base + lambda));
      const double fraction = lambda - std::floor(lambda);
      return (1 - fraction) * in_level(texture, d1, linear, st) + fraction * in_level(texture, d1 + 1, linear, st);
    }
  }
  return glm::dvec4(0);
}

glm::dvec4 textured_color(TextureFormat format, const DrawTexture& state, const glm::dvec4& fragment,
                          const glm::dvec4& texel) {
  using F = TextureFormat;
  const glm::dvec3 cf(fragment), cs(texel), cc(state.color);
  const double af = fragment.a, as = texel.a, ac = static_cast<double>(state.color.a);
  const glm::dvec3 one(1);
  // The tables, column by column; decal is defined for rgb and rgba.
  switch (state.environment) {
    case TextureEnvironment::replace:
      switch (format) {
        case F::alpha: return {cf, as};
        case F::luminance:
        case F::rgb: return {cs, af};
        case F::luminance_alpha:
        case F::intensity:
        case F::rgba: return {cs, as};
      }
      break;
    case TextureEnvironment::modulate:
      switch (format) {
        case F::alpha: return {cf, af * as};
        case F::luminance:
        case F::rgb: return {cf * cs, af};
        case F::luminance_alpha:
        case F::intensity:
        case F::rgba: return {cf * cs, af * as};
      }
      break;
    case TextureEnvironment::decal:
      return format == F::rgb ? glm::dvec4(cs, af) : glm::dvec4(cf * (1 - as) + cs * as, af);
    case TextureEnvironment::blend:
      switch (format) {
        case F::alpha: return {cf, af * as};
        case F::luminance:
        case F::rgb: return {cf * (one - cs) + cc * cs, af};
        case F::luminance_alpha:
        case F::rgba: return {cf * (one - cs) + cc * cs, af * as};
        case F::intensity: return {cf * (one - cs) + cc * cs, af * (1 - as) + ac * as};
      }
      break;
    case TextureEnvironment::add:
      switch (format) {
        case F::alpha: return {cf, af * as};
        case F::luminance:
        case F::rgb: return {glm::clamp(cf + cs, 0.0, 1.0), af};
        case F::luminance_alpha:
        case F::rgba: return {glm::clamp(cf + cs, 0.0, 1.0), af * as};
        case F::intensity: return glm::clamp(fragment + texel, 0.0, 1.0);
      }
      break;
  }
  return fragment;
}

}  // namespace plumbline::exact
