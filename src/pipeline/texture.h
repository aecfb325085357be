// Stage 8: the filtered texel (OpenGL 2.1 spec 3.8.7 to 3.8.9), and the level of detail that it was filtered at.
//
// Texel coordinates are worked out in double: s times a width is exact there, so that which texel is the nearest, and
// how far off its centre a fragment lies, is not rounded at all.
#pragma once

#include <array>

#include "pipeline/attributes.h"
#include "pipeline/lanes.h"
#include "pipeline/math.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

template <class R>
struct TexCoords {
  R s, t;
};
/// Of s and t, by window x and y.
template <class R>
struct Gradients {
  Wide<R> ds_dx, dt_dx, ds_dy, dt_dy;
};
/// A fragment's.
template <class R>
struct FilteredTexel {
  Color<R> color;  ///< texture source components (Cs, As)
  R lod;           ///< lambda: bias and limits applied
};

/// s/w, t/w and 1/w, affine in the window, at the anchor of the triangle's barycentric planes.
struct GradientSetup {
  double x0, y0;
  double s_0, s_x, s_y, t_0, t_x, t_y, q_0, q_x, q_y;
};
GradientSetup gradient_setup(const WindowTriangle<float>& triangle, const std::array<Vec4<float>, 3>& texcoords,
                             const BarycentricPlanes& planes);

/// d(s/w : 1/w) = (d(s/w) - s d(1/w)) / (1/w), exact for each pixel: no neighbours are asked.
template <class R>
Gradients<R> gradients(const GradientSetup& g, const Pixels<R>& p) {
  const Wide<R> dx = p.x_win - g.x0, dy = p.y_win - g.y0;
  const Wide<R> q = g.q_0 + (dx * g.q_x + dy * g.q_y);
  // Extrapolated out of a sliver, 1/w may reach 0: no division there.
  const auto divides = q * q > 1e-300;
  const Wide<R> w = select(divides, Wide<R>(1) / select(divides, q, Wide<R>(1)), Wide<R>(0));
  const Wide<R> s = (g.s_0 + (dx * g.s_x + dy * g.s_y)) * w, t = (g.t_0 + (dx * g.t_x + dy * g.t_y)) * w;
  return {(g.s_x - s * g.q_x) * w, (g.t_x - t * g.q_x) * w, (g.s_y - s * g.q_y) * w, (g.t_y - t * g.q_y) * w};
}

/// What of a texture is looked at per fragment, chosen once per draw.
struct TextureSetup {
  const Texture* texture;
  Sampler sampler;
  int last;              ///< the highest level that may be sampled
  double c;              ///< lambda up to which a texture is magnified
  double width, height;  ///< of the base level
};
TextureSetup texture_setup(const Texture& texture, const Sampler& sampler);

/// lambda (equations 3.17 to 3.22): log2 of the longer of the two vectors by which texel coordinates go from one pixel
/// to the next; of no length, the smallest.
template <class R>
R level_of_detail(const TextureSetup& t, const Gradients<R>& g) {
  const auto squared = [&](Wide<R> ds, Wide<R> dt) {
    const Wide<R> du = ds * t.width, dv = dt * t.height;
    return du * du + dv * dv;
  };
  const Wide<R> x = squared(g.ds_dx, g.dt_dx), y = squared(g.ds_dy, g.dt_dy), rho2 = select(x > y, x, y);
  const auto has_length = rho2 > 1e-300;
  const Wide<R> log2_rho = select(has_length, 0.5 * log2_of(select(has_length, rho2, Wide<R>(1))), Wide<R>(-1e6));
  const Wide<R> lambda = log2_rho + to_wide(t.sampler.lod_bias);
  const Wide<R> least = to_wide(t.sampler.min_lod), most = to_wide(t.sampler.max_lod);
  const Wide<R> low = select(lambda > least, lambda, least);
  return to_float(select(low < most, low, most));
}

/// A texel coordinate, every other image of a repeated row of `size` turned round. The coordinate is, not the texel's
/// number (3.8.7): between two texels it is the one that then lies to its right.
template <class W>
W mirrored(W u, std::int64_t size) {
  const auto whole = floor_int(u), image = (whole - (whole % size + size) % size) / size;
  const W within = u - to_wide(image * size);
  return select(image % 2 != 0, to_wide(size) - within, within);
}

/// Where texel `i` of a row of `size` is found; -1: the border.
template <class I>
I wrapped(Wrap wrap, I i, I size) {
  const auto mod = [](I value, I by) { return (value % by + by) % by; };
  const auto clamped = [&](I lo, I hi) { return select(i < lo, lo, select(i > hi, hi, i)); };
  switch (wrap) {
    case Wrap::repeat: return mod(i, size);
    case Wrap::mirrored_repeat:  // of a mirrored coordinate
    case Wrap::clamp_to_edge: return clamped(I(0), size - 1);
    case Wrap::clamp_to_border: return select((i < 0) | (i >= size), I(-1), i);
  }
  return i;
}

/// A texel of a level, the border's colour outside.
template <class R>
Color<R> fetch(const TextureSetup& t, const TextureLevel& level, Int<R> i, Int<R> j);
template <>
inline Color<float> fetch<float>(const TextureSetup& t, const TextureLevel& level, std::int64_t i, std::int64_t j) {
  const std::int64_t x = wrapped<std::int64_t>(t.sampler.wrap_s, i, level.width);
  const std::int64_t y = wrapped<std::int64_t>(t.sampler.wrap_t, j, level.height);
  const glm::vec4 texel = x < 0 || y < 0 ? source_components(t.texture->format, t.sampler.border)
                                         : level.at(static_cast<int>(x), static_cast<int>(y));
  return {texel.r, texel.g, texel.b, texel.a};
}

/// A mean of two colours, in double: 1 - k of `a`, k of `b`.
template <class R>
Color<R> mix(const Color<R>& a, const Color<R>& b, Wide<R> k) {
  const auto channel = [&](R x, R y) { return to_float(to_wide(x) + k * (to_wide(y) - to_wide(x))); };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b), channel(a.a, b.a)};
}

/// Coordinates of texels, for those that a plane extrapolated out of a sliver makes: within what an integer holds.
template <class W>
W bounded(const W& u) {
  const W most(0x1p40), low = select(u > -most, u, -most);
  return select(low < most, low, most);
}

/// One level, linear or nearest.
template <class R>
Color<R> sample_level(const TextureSetup& t, int number, bool linear, const TexCoords<R>& at) {
  const TextureLevel& level = t.texture->levels[static_cast<std::size_t>(number)];
  const double shift = linear ? 0.5 : 0.0;
  const auto place = [&](Wrap wrap, R coordinate, int size) {
    const Wide<R> u = bounded(to_wide(coordinate) * size);
    return (wrap == Wrap::mirrored_repeat ? mirrored(u, size) : u) - shift;
  };
  const Wide<R> u = place(t.sampler.wrap_s, at.s, level.width), v = place(t.sampler.wrap_t, at.t, level.height);
  const Int<R> i = floor_int(u), j = floor_int(v);
  if (!linear) return fetch<R>(t, level, i, j);
  const Wide<R> a = u - to_wide(i), b = v - to_wide(j);
  return mix<R>(mix<R>(fetch<R>(t, level, i, j), fetch<R>(t, level, i + 1, j), a),
                mix<R>(fetch<R>(t, level, i, j + 1), fetch<R>(t, level, i + 1, j + 1), a), b);
}

/// At a level of detail. What is asked of it is the same for all lanes of a SIMD type only by chance: one at a time.
inline Color<float> sample(const TextureSetup& t, const TexCoords<float>& at, float lod) {
  const Sampler& s = t.sampler;
  const double lambda = to_wide(lod);
  if (lambda <= t.c) return sample_level<float>(t, s.base_level, s.mag == MagFilter::linear, at);
  const bool linear = s.min == MinFilter::linear || s.min == MinFilter::linear_mipmap_nearest ||
                      s.min == MinFilter::linear_mipmap_linear;
  if (!mipmaps(s.min)) return sample_level<float>(t, s.base_level, linear, at);
  if (s.min == MinFilter::nearest_mipmap_nearest || s.min == MinFilter::linear_mipmap_nearest) {
    // ceil(lambda + 1/2) - 1: a half is rounded down
    const int nearest = s.base_level - static_cast<int>(floor_int(-(lambda + 0.5))) - 1;
    return sample_level<float>(t, nearest > t.last ? t.last : nearest, linear, at);
  }
  const std::int64_t whole = floor_int(lambda);
  const int first = s.base_level + static_cast<int>(whole);
  if (first >= t.last) return sample_level<float>(t, t.last, linear, at);
  return mix<float>(sample_level<float>(t, first, linear, at), sample_level<float>(t, first + 1, linear, at),
                    lambda - to_wide(whole));
}

/// Stage 8.
template <class R>
FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& gradients) {
  const R lod = level_of_detail<R>(t, gradients);
  return {sample(t, at, lod), lod};
}

}  // namespace plumbline::pipeline
