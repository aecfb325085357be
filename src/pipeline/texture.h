// Stage 8: the filtered texel (OpenGL 2.1 spec 3.8.7 to 3.8.9), and the level of detail that it was filtered at.
//
// Texel coordinates are worked out in double: s times a width is exact there, so that which texel is the nearest, and
// how far off its centre a fragment lies, is not rounded at all.
#pragma once

#include <array>
#include <bit>

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
  Affine<double> s, t, q;
};
GradientSetup gradient_setup(const WindowTriangle<float>& triangle, const std::array<Vec4<float>, 3>& texcoords,
                             const BarycentricPlanes& planes);

/// d(s/w : 1/w) = (d(s/w) - s d(1/w)) / (1/w), exact for each pixel: no neighbours are asked.
template <class R>
Gradients<R> gradients(const GradientSetup& g, const Pixels<R>& p) {
  const Offset<R> at{p.x_win - g.x0, p.y_win - g.y0};
  const Wide<R> q = value_at<R>(g.q, at);
  // Extrapolated out of a sliver, 1/w may reach 0: no division there.
  const auto divides = q * q > 1e-300;
  const Wide<R> w = select(divides, Wide<R>(1) / select(divides, q, Wide<R>(1)), Wide<R>(0));
  const Wide<R> s = value_at<R>(g.s, at) * w, t = value_at<R>(g.t, at) * w;
  return {(g.s.x - s * g.q.x) * w, (g.t.x - t * g.q.x) * w, (g.s.y - s * g.q.y) * w, (g.t.y - t * g.q.y) * w};
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
W mirrored(W u, double size) {
  const W image = floor_of(floor_of(u) / size), within = u - image * size;
  return select(image - 2.0 * floor_of(image * 0.5) != 0.0, size - within, within);
}

/// Where texel `i` of a row of `size` is found; -1: the border. Whole numbers, `i` up to 2^40: what is below a whole
/// number by 1 / size is not rounded to it.
template <class W>
W wrapped(Wrap wrap, W i, double size) {
  switch (wrap) {
    case Wrap::repeat: return i - floor_of(i / size) * size;
    case Wrap::mirrored_repeat:  // of a mirrored coordinate
    case Wrap::clamp_to_edge: return clamped(i, W(0), W(size - 1.0));
    case Wrap::clamp_to_border: return select((i < 0.0) | (i >= size), W(-1), i);
  }
  return i;
}
/// Of texel `i`, and of the next.
template <class R>
std::array<Int<R>, 2> texel_numbers(Wrap wrap, const Wide<R>& i, int size) {
  if (wrap == Wrap::repeat && std::has_single_bit(static_cast<unsigned>(size))) {
    const Int<R> number = to_int(i), last(size - 1);
    return {number & last, (number + Int<R>(1)) & last};
  }
  return {to_int(wrapped(wrap, i, size)), to_int(wrapped(wrap, i + 1.0, size))};
}

template <class R>
Color<R> select(Mask<R> mask, const Color<R>& yes, const Color<R>& no) {
  return {select(mask, yes.r, no.r), select(mask, yes.g, no.g), select(mask, yes.b, no.b), select(mask, yes.a, no.a)};
}

/// Of texels side by side, each lane's own.
inline Color<float> texels(const glm::vec4* from, std::int64_t number) {
  const glm::vec4& texel = from[number];
  return {texel.r, texel.g, texel.b, texel.a};
}
/// A texel of a level, the border's colour outside.
template <class R>
Color<R> fetch(const TextureSetup& t, const TextureLevel& level, Int<R> x, Int<R> y) {
  const Int<R> number = y * Int<R>(level.width) + x, none(0);
  if (t.sampler.wrap_s != Wrap::clamp_to_border && t.sampler.wrap_t != Wrap::clamp_to_border) {
    return texels(level.texels.data(), number);
  }
  const Mask<R> outside = (x < none) | (y < none);
  const Color<R> inside = texels(level.texels.data(), select(outside, none, number));
  const glm::vec4 border = source_components(t.texture->format, t.sampler.border);
  return select<R>(outside, {R(border.r), R(border.g), R(border.b), R(border.a)}, inside);
}

/// A mean, 1 - k of `x` and k of `y`; of two colours, in double.
template <class W>
W mix(const W& x, const W& y, const W& k) {
  return x + k * (y - x);
}
template <class R>
Color<R> mix(const Color<R>& a, const Color<R>& b, const Wide<R>& k) {
  const auto channel = [&](R x, R y) { return to_float(mix<Wide<R>>(to_wide(x), to_wide(y), k)); };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b), channel(a.a, b.a)};
}

/// Coordinates of texels, for those that a plane extrapolated out of a sliver makes: within what a double counts.
template <class W>
W bounded(const W& u) {
  return clamped(u, W(-0x1p40), W(0x1p40));
}

/// One level, linear or nearest.
template <class R>
Color<R> sample_level(const TextureSetup& t, int number, bool linear, const TexCoords<R>& at) {
  using W = Wide<R>;
  const TextureLevel& level = t.texture->levels[static_cast<std::size_t>(number)];
  const Wrap wrap_s = t.sampler.wrap_s, wrap_t = t.sampler.wrap_t;
  const double shift = linear ? 0.5 : 0.0;
  const auto place = [&](Wrap wrap, R coordinate, double size) {
    const W u = bounded<W>(to_wide(coordinate) * size);
    return (wrap == Wrap::mirrored_repeat ? mirrored<W>(u, size) : u) - shift;
  };
  const W u = place(wrap_s, at.s, level.width), v = place(wrap_t, at.t, level.height);
  const W i = floor_of(u), j = floor_of(v);
  const auto [x, right] = texel_numbers<R>(wrap_s, i, level.width);
  const auto [y, above] = texel_numbers<R>(wrap_t, j, level.height);
  const Color<R> texel = fetch<R>(t, level, x, y);
  if (!linear) return texel;
  const Color<R> beside = fetch<R>(t, level, right, y);
  const Color<R> over = fetch<R>(t, level, x, above), diagonal = fetch<R>(t, level, right, above);
  const W a = u - i, b = v - j;
  const auto channel = [&](R Color<R>::*c) {  // rounded once
    const W low = mix<W>(to_wide(texel.*c), to_wide(beside.*c), a);
    return to_float(mix<W>(low, mix<W>(to_wide(over.*c), to_wide(diagonal.*c), a), b));
  };
  return {channel(&Color<R>::r), channel(&Color<R>::g), channel(&Color<R>::b), channel(&Color<R>::a)};
}

/// The level below lambda; whether it is mixed with the next, and how much of that.
template <class R>
struct Levels {
  R first;
  Mask<R> two;
  Wide<R> k;
};
template <class R>
Levels<R> levels(const TextureSetup& t, R lod) {
  using W = Wide<R>;
  const W lambda = to_wide(lod), base(t.sampler.base_level), last(t.last);
  const MinFilter min = t.sampler.min;
  const R none(0);
  if (!mipmaps(min)) return {to_float(base), none != none, W(0)};
  if (min == MinFilter::nearest_mipmap_nearest || min == MinFilter::linear_mipmap_nearest) {
    // ceil(lambda + 1/2) - 1: a half is rounded down
    return {to_float(lesser_of(base - floor_of(-(lambda + 0.5)) - 1.0, last)), none != none, W(0)};
  }
  const W whole = floor_of(lambda), first = base + whole;
  return {to_float(lesser_of(first, last)), first < last, lambda - whole};
}

/// At a level of detail, no NaN.
template <class R>
Color<R> sample(const TextureSetup& t, const TexCoords<R>& at, R lod) {
  const Sampler& s = t.sampler;
  const Mask<R> larger = lod <= R(static_cast<float>(t.c)), smaller = lod > R(static_cast<float>(t.c));
  const auto magnified = [&] { return sample_level<R>(t, s.base_level, s.mag == MagFilter::linear, at); };
  if (!any(smaller)) return magnified();
  const bool linear = s.min == MinFilter::linear || s.min == MinFilter::linear_mipmap_nearest ||
                      s.min == MinFilter::linear_mipmap_linear;
  const Levels<R> of = levels<R>(t, lod);
  const R first = select(larger, R(static_cast<float>(s.base_level)), of.first);
  const Mask<R> two = of.two & smaller;
  // Each level that any lane wants, for all lanes.
  Color<R> low{R(0), R(0), R(0), R(0)}, high = low;
  for (int number = s.base_level; number <= t.last; ++number) {
    const R level(static_cast<float>(number));
    const Mask<R> is_first = first == level, is_second = (first == level - R(1)) & two;
    if (!any(is_first | is_second)) continue;
    const Color<R> texel = sample_level<R>(t, number, linear, at);
    low = select<R>(is_first, texel, low);
    high = select<R>(is_second, texel, high);
  }
  if (any(two)) low = select<R>(two, mix<R>(low, high, of.k), low);
  const bool alike = linear == (s.mag == MagFilter::linear);
  return alike || !any(larger) ? low : select<R>(larger, magnified(), low);
}

/// Stage 8.
template <class R>
FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& gradients) {
  const R lod = level_of_detail<R>(t, gradients);
  return {sample<R>(t, at, lod), lod};
}

}  // namespace plumbline::pipeline
