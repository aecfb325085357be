#include "reference/arithmetic/texture.h"
#include "reference/arithmetic/bounded.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace plumbline::math {
namespace {

constexpr double kNoLength = -1e6;  // in place of log2(0), before lambda is limited

double squared_rho(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy) {
  const TextureLevel& base = texture.levels[static_cast<std::size_t>(texture.sampler.base_level)];
  const glm::dvec2 size(base.width, base.height), x = size * d_dx, y = size * d_dy;
  return std::max(glm::dot(x, x), glm::dot(y, y));
}

/// Range of rho that OpenGL allows (2.1, 3.8.8), from the larger of m_u and m_v to their sum; m_u is the larger of
/// |du/dx| and |du/dy|, m_v of |dv/dx| and |dv/dy|, u and v in texels.
struct RhoRange {
  double least, most;
};
RhoRange legal_rho(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy) {
  const TextureLevel& base = texture.levels[static_cast<std::size_t>(texture.sampler.base_level)];
  const glm::dvec2 m = glm::dvec2(base.width, base.height) * glm::max(glm::abs(d_dx), glm::abs(d_dy));
  return {std::max(m.x, m.y), m.x + m.y};
}

/// lambda within the sampler's limits, from log2(rho) and a bias.
double limited(const Sampler& s, double log2_rho, double bias) {
  return std::clamp(log2_rho + bias, static_cast<double>(s.min_lod), static_cast<double>(s.max_lod));
}

double bias_of(const Texture& texture) { return static_cast<double>(texture.sampler.lod_bias); }

double mesas_bias(const Texture& texture) { return std::round(256 * bias_of(texture)) / 256; }

double log2_of_rho(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy) {
  const double rho2 = squared_rho(texture, d_dx, d_dy);
  return rho2 > 0 ? 0.5 * std::log2(rho2) : kNoLength;
}

/// lambda up to which the texture is magnified (3.8.9).
double magnified_up_to(const Sampler& s, const LevelRules& rules) {
  if (rules.magnified_to_zero) return 0;
  const bool nearest = s.min == MinFilter::nearest_mipmap_nearest || s.min == MinFilter::nearest_mipmap_linear;
  return s.mag == MagFilter::linear && nearest ? 0.5 : 0;
}

/// A texture coordinate wrapped by the mode (3.8.7). `size`: the level's side [texels], which the clamping modes and
/// mirrored_repeat use.
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

/// The border's colour as a texel of the format (OpenGL 4.5, compatibility profile, table 15.1).
glm::dvec4 border_color(TextureFormat format, const glm::dvec4& border) {
  const bool no_color = format == TextureFormat::alpha;
  const bool gray = format == TextureFormat::luminance || format == TextureFormat::luminance_alpha ||
                    format == TextureFormat::intensity;
  const bool opaque = format == TextureFormat::luminance || format == TextureFormat::rgb;
  const double alpha = format == TextureFormat::intensity ? border.r : opaque ? 1 : border.a;
  if (no_color) return {0, 0, 0, alpha};
  return gray ? glm::dvec4(border.r, border.r, border.r, alpha) : glm::dvec4(border.r, border.g, border.b, alpha);
}

/// Texel (i, j) of a level; beyond the image, by the wrap mode: the texel around, at the edge, or the border's colour.
glm::dvec4 texel(const Texture& texture, const TextureLevel& level, int i, int j) {
  const Sampler& s = texture.sampler;
  const auto around = [](Wrap wrap, int at, int size) {
    if (wrap == Wrap::repeat) return at < 0 ? at + size : at >= size ? at - size : at;
    // Clamped to the edge, a texel beyond has the weight 0.
    return wrap == Wrap::clamp_to_border ? at : std::clamp(at, 0, size - 1);
  };
  const int x = around(s.wrap_s, i, level.width), y = around(s.wrap_t, j, level.height);
  if (x < 0 || y < 0 || x >= level.width || y >= level.height) {
    return border_color(texture.format, glm::dvec4(s.border));
  }
  return glm::dvec4(level.at(x, y));
}

glm::dvec4 in_level(const Texture& texture, int number, bool linear, glm::dvec2 st) {
  const TextureLevel& level = texture.levels[static_cast<std::size_t>(number)];
  const Sampler& s = texture.sampler;
  if (!std::isfinite(st.s) || !std::isfinite(st.t)) return glm::dvec4(std::numeric_limits<double>::quiet_NaN());
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

LevelRules level_rules(const Conventions& c) {
  return {c.level_of_detail == Conventions::LevelOfDetail::approximate,
          c.magnified == Conventions::Magnified::up_to_zero, c.half_way_level == Conventions::HalfWay::either,
          c.texture_bits};
}

double smallest_level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy, const LevelRules& rules) {
  const double rho = rules.approximate ? legal_rho(texture, d_dx, d_dy).least : 0;
  const double rho2 = rules.approximate ? rho * rho : squared_rho(texture, d_dx, d_dy);
  int exponent = 0;
  const double mantissa = std::frexp(rho2, &exponent);  // [1/2, 1)
  const double piecewise = rho2 > 0 ? 0.5 * (exponent - 1 + 2 * mantissa - 1) : kNoLength;
  return limited(texture.sampler, piecewise, std::min(bias_of(texture), mesas_bias(texture)));
}

double largest_level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy, const LevelRules& rules) {
  const double rho = legal_rho(texture, d_dx, d_dy).most, of_most = rho > 0 ? std::log2(rho) : kNoLength;
  return limited(texture.sampler, rules.approximate ? of_most : log2_of_rho(texture, d_dx, d_dy),
                 std::max(bias_of(texture), mesas_bias(texture)));
}

double level_of_detail(const Texture& texture, glm::dvec2 d_dx, glm::dvec2 d_dy) {
  return limited(texture.sampler, log2_of_rho(texture, d_dx, d_dy), bias_of(texture));
}

glm::dvec4 filtered_texel(const Texture& texture, glm::dvec2 st, double lambda, const LevelRules& rules) {
  const Sampler& s = texture.sampler;
  const int base = s.base_level, q = last_level(texture);
  if (std::isnan(lambda)) return glm::dvec4(lambda);  // another renderer's records may hold anything
  if (lambda <= magnified_up_to(s, rules)) return in_level(texture, base, s.mag == MagFilter::linear, st);
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

namespace {

bool filters_linearly(const Sampler& s, double lambda, const LevelRules& rules) {
  if (lambda <= magnified_up_to(s, rules)) return s.mag == MagFilter::linear;
  return s.min == MinFilter::linear || s.min == MinFilter::linear_mipmap_nearest ||
         s.min == MinFilter::linear_mipmap_linear;
}

/// The levels that are filtered at lambda.
std::pair<int, int> levels_at(const Texture& texture, double lambda, const LevelRules& rules) {
  const int base = texture.sampler.base_level, q = last_level(texture);
  if (!(lambda > magnified_up_to(texture.sampler, rules)) || !mipmaps(texture.sampler.min)) return {base, base};
  const double at = std::min(base + std::max(lambda, 0.0), static_cast<double>(q));
  return {static_cast<int>(std::floor(at)), static_cast<int>(std::ceil(at))};
}

/// Adds one level to the range: its slopes in s and t around `st` (linear), or the distance to the next texel
/// (nearest).
void add_slopes(const Texture& texture, int number, bool linear, glm::dvec2 st, TexelRange& out) {
  const TextureLevel& level = texture.levels[static_cast<std::size_t>(number)];
  const glm::dvec2 size(level.width, level.height);
  int &first_level = linear ? out.first_linear : out.first_nearest,
      &last_level = linear ? out.last_linear : out.last_nearest;
  const bool none = last_level < first_level;
  first_level = none ? number : std::min(first_level, number);
  last_level = none ? number : std::max(last_level, number);
  if (!linear) {
    for (int k = 0; k < 2; ++k) {
      const double at = st[k] * size[k];
      out.gap[k] = std::min(out.gap[k], std::abs(at - std::round(at)) / size[k]);
    }
    return;
  }
  // Between texel centres the filtered texel changes by at most the difference of neighbouring texels; the 3 x 3 texels
  // around `st` have all slopes within half a texel of it.
  glm::dvec4 at[3][3];
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 texels(std::floor(st.s * size.s) + i - 0.5, std::floor(st.t * size.t) + j - 0.5);
      at[j][i] = in_level(texture, number, false, texels / size);
    }
  }
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 2; ++i) {
      out.slope_s = glm::max(out.slope_s, size.s * glm::abs(at[j][i + 1] - at[j][i]));
      out.slope_t = glm::max(out.slope_t, size.t * glm::abs(at[i + 1][j] - at[i][j]));
    }
  }
}

/// Error of weighted means where weights and results have n fraction bits: each weight (within two levels, and between
/// them) is off by 2^-n, each of the three results by half of that.
glm::dvec4 weights_error(const Texture& texture, const TexelRange& range, const LevelRules& rules) {
  const bool means = range.last_linear >= range.first_linear || range.last_nearest > range.first_nearest;
  if (rules.weight_bits == Conventions::kFloat || !means) return glm::dvec4(0);
  const int coarsest = std::max({range.last_linear, range.last_nearest, 0});
  const TextureLevel& level = texture.levels[static_cast<std::size_t>(coarsest)];
  const glm::dvec4 neighbours = range.slope_s / static_cast<double>(level.width) +
                                range.slope_t / static_cast<double>(level.height) + (range.hi - range.lo);
  return std::ldexp(1.0, -rules.weight_bits) * (neighbours + 1.5);
}

}  // namespace

bool depends_on_lambda(const Sampler& s) {
  return mipmaps(s.min) || (s.min == MinFilter::linear) != (s.mag == MagFilter::linear);
}

TexelRange texel_range(const Texture& texture, glm::dvec2 st, double lambda_lo, double lambda_hi,
                       const LevelRules& rules) {
  TexelRange out;
  out.lambda_lo = lambda_lo;
  out.lambda_hi = lambda_hi;
  std::uint64_t sloped = 0;  // a bit for each level and filter that add_slopes() has added
  out.lo = glm::dvec4(kInfinity);
  out.hi = -out.lo;
  const auto add = [&](double lambda) {
    const glm::dvec4 texel = filtered_texel(texture, st, lambda, rules);
    out.lo = glm::min(out.lo, texel);
    out.hi = glm::max(out.hi, texel);
    const auto [first, last] = levels_at(texture, lambda, rules);
    const bool linear = filters_linearly(texture.sampler, lambda, rules);
    for (int level = first; level <= last; ++level) {
      const std::uint64_t bit = std::uint64_t{1} << (2 * level + (linear ? 1 : 0));
      if ((sloped & bit) == 0) add_slopes(texture, level, linear, st, out);
      sloped |= bit;
    }
  };
  add(lambda_lo);
  const bool is_magnified = lambda_lo <= lambda_hi && lambda_hi <= magnified_up_to(texture.sampler, rules);
  if (depends_on_lambda(texture.sampler) && !is_magnified) {
    add(lambda_hi);
    // Level and filter change only at multiples of 1/2 of lambda, between which the texel is linear in lambda. The
    // choice just beyond a multiple is sampled, too.
    constexpr double kMost = 16, kBeyond = 1e-9;
    for (double at = std::ceil(2 * std::max(lambda_lo, -1.0)) / 2; at <= std::min(lambda_hi, kMost); at += 0.5) {
      add(at);
      if (at + kBeyond <= lambda_hi || rules.half_way_either) add(at + kBeyond);
    }
  }
  const glm::dvec4 of_weights = weights_error(texture, out, rules);
  out.lo -= of_weights;
  out.hi += of_weights;
  return out;
}

glm::dvec4 textured_color(TextureFormat format, const DrawTexture& state, const glm::dvec4& fragment,
                          const glm::dvec4& texel) {
  glm::dvec4 out;
  for (int c = 0; c < 4; ++c) {
    out[c] = textured_channel<double>({format, state.environment, c == 3}, fragment[c], texel[c], texel.a,
                                      static_cast<double>(state.color[c]), Exactly());
  }
  return out;
}

namespace {

/// True if `bound` is within the slopes' range: below half a texel, in s and t, of each linearly filtered level.
bool within_slopes(const Texture& texture, const TexelRange& range, glm::dvec2 bound) {
  if (range.last_linear < range.first_linear) return std::isfinite(bound.s + bound.t);
  const TextureLevel& finest = texture.levels[static_cast<std::size_t>(range.first_linear)];
  return bound.s * finest.width < 0.5 && bound.t * finest.height < 0.5;
}

/// True if another texel, within the bound of s or of t, may be the nearest.
bool is_open(const TexelRange& range, glm::dvec2 bound) {
  const auto known = [&](glm::length_t k) { return bound[k] == 0 || bound[k] < range.gap[k]; };
  return !(known(0) && known(1));
}

}  // namespace

BoundedFour bounded_textured_color(const Texture& texture, const DrawTexture& state, const BoundedFour& fragment,
                                   const BoundedPlace& place, const LevelRules& rules) {
  const TexelRange range = texel_range(texture, place.st, place.lambda_lo, place.lambda_hi, rules);
  const glm::dvec4 texel = filtered_texel(texture, place.st, place.lambda, rules);
  BoundedFour out{textured_color(texture.format, state, fragment.value, texel), 0};
  const bool open =
      is_open(range, place.bound) || !within_slopes(texture, range, place.bound) || !std::isfinite(fragment.bound);
  if (open) return {out.value, kInfinity};
  const glm::dvec4 slack = range.slope_s * place.bound.s + range.slope_t * place.bound.t;
  const glm::dvec4 lo = range.lo - slack, hi = range.hi + slack;
  // Every environment is linear in each of Cf, Af, Cs and As: its extremes are at the ends of their intervals.
  for (unsigned ends = 0; ends < 16; ++ends) {
    const auto low = [&](unsigned of) { return (ends >> of & 1u) == 0; };
    const glm::dvec4 f = fragment.value + fragment.bound * glm::dvec4(glm::dvec3(low(0) ? -1 : 1), low(1) ? -1 : 1);
    const glm::dvec4 s(glm::dvec3(low(2) ? lo : hi), low(3) ? lo.a : hi.a);
    const glm::dvec4 apart = glm::abs(textured_color(texture.format, state, f, s) - out.value);
    out.bound = std::max({out.bound, apart.r, apart.g, apart.b, apart.a});
  }
  constexpr double kRoundings = 8 * kFloatRounding;
  const glm::dvec4 size = glm::max(glm::abs(lo), glm::abs(hi));
  out.bound += kRoundings * std::max({1.0, size.r, size.g, size.b, size.a});
  return out;
}

}  // namespace plumbline::math
