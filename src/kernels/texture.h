// Stage 8: the filtered texel (OpenGL 2.1 spec 3.8.7 to 3.8.9), and the level of detail that it was filtered at.
//
// Texel coordinates are computed in double, where s times a width is exact: the nearest texel, and the fragment's
// distance from its centre, come from no rounded number.
#pragma once

#include <array>
#include <bit>
#include <type_traits>

#include "kernels/attributes.h"
#include "kernels/lanes.h"
#include "kernels/math.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

template <class R>
struct TexCoords {
  R s, t;
};
/// Derivatives of s and t by window x and y [1/pixel], times q^2. Derivatives by x are affine functions of y alone,
/// derivatives by y of x alone.
template <class R>
struct Gradients {
  Wide<R> ds_dx, dt_dx, ds_dy, dt_dy;
  Wide<R> q = Wide<R>(1);  ///< 1/w
};
/// Output of stage 8 for one fragment.
template <class R>
struct FilteredTexel {
  Color<R> color;  ///< texture source components (Cs, As)
  R lod;           ///< lambda: bias and limits applied
};

/// Per-triangle input of gradients(), relative to the barycentric planes' anchor. With S = s/w and q = 1/w, q^2
/// d(S/q)/dx = S_x q - S q_x = (S_x q_0 - S_0 q_x) + (S_x q_y - S_y q_x) dy, as the terms in dx cancel; q^2 d(S/q)/dy =
/// (S_y q_0 - S_0 q_y) - (S_x q_y - S_y q_x) dx. s_turn, t_turn: the factors of dy and -dx.
template <class W>
struct GradientSetupOf {
  W ds_dx, ds_dy, s_turn, dt_dx, dt_dy, t_turn;
};
using GradientSetup = GradientSetupOf<double>;
/// Setup from the corners' s, t and 1/w.
template <class W>
[[gnu::always_inline]] inline GradientSetupOf<W> gradient_setup(const CornerPlanes<W>& planes, const W (&of_s)[3],
                                                                const W (&of_t)[3], const W (&inv_w)[3]) {
  const auto through = [&](const W& v0, const W& v1, const W& v2) { return planes.through(v0, v1 - v0, v2 - v0); };
  const auto over_w = [&](const W(&v)[3]) { return through(v[0] * inv_w[0], v[1] * inv_w[1], v[2] * inv_w[2]); };
  const Affine<W> s = over_w(of_s), t = over_w(of_t), q = through(inv_w[0], inv_w[1], inv_w[2]);
  const auto cross = [](const W& a, const W& b, const W& c, const W& d) { return difference_of_products(a, b, c, d); };
  return {cross(s.x, q.at_0, s.at_0, q.x), cross(s.y, q.at_0, s.at_0, q.y), cross(s.x, q.y, s.y, q.x),
          cross(t.x, q.at_0, t.at_0, q.x), cross(t.y, q.at_0, t.at_0, q.y), cross(t.x, q.y, t.y, q.x)};
}
GradientSetup gradient_setup(const WindowTriangle& triangle, const std::array<Vec4<float>, 3>& texcoords,
                             const BarycentricPlanes& planes);

/// Gradients at a fragment, analytic: no differences between neighbouring pixels. `g`: GradientSetupOf one triangle, or
/// of each lane's; `q`: 1/w.
template <class R>
[[gnu::always_inline]] inline Gradients<R> gradients(const auto& g, const Offset<R>& at, const Wide<R>& q) {
  return {g.ds_dx + at.dy * g.s_turn, g.dt_dx + at.dy * g.t_turn, g.ds_dy - at.dx * g.s_turn,
          g.dt_dy - at.dx * g.t_turn, q};
}

/// Per-draw input of stage 8. Points to the texture and its texels, which must outlive it.
struct TextureSetup {
  const Texture* texture;
  Sampler sampler;
  int last;                                 ///< highest level that may be sampled
  double c;                                 ///< lambda up to which a texture is magnified
  double magnified_rho2;                    ///< rho^2 up to which a texture is certainly magnified; 0: no such bound
  double width, height;                     ///< of the base level [texels]
  std::array<const glm::vec4*, 16> texels;  ///< of each level
  glm::vec4 border;                         ///< texture source components
  bool has_border;                          ///< whether either wrap is clamp_to_border
};
/// `texture`: levels[sampler.base_level] exists, at most 16 levels.
TextureSetup texture_setup(const Texture& texture, const Sampler& sampler);

/// rho^2 q^4, rho = max(|d(u,v)/dx|, |d(u,v)/dy|) [texels per pixel].
template <class R>
[[gnu::always_inline]] inline Wide<R> longer_squared(const TextureSetup& t, const Gradients<R>& g) {
  const auto squared = [&](const Wide<R>& ds, const Wide<R>& dt) {
    const Wide<R> du = ds * t.width, dv = dt * t.height;
    return du * du + dv * dv;
  };
  return greater_of(squared(g.ds_dx, g.dt_dx), squared(g.ds_dy, g.dt_dy));
}

/// lambda (equations 3.17 to 3.22): log2(rho) plus the bias, clamped to [min_lod, max_lod]; rho as in longer_squared().
/// rho^2 outside (1e-300, 1e300): min_lod.
template <class R>
[[gnu::always_inline]] inline R level_of_detail(const TextureSetup& t, const Gradients<R>& g) {
  using W = Wide<R>;
  const W q2 = g.q * g.q, rho2 = longer_squared<R>(t, g) / (q2 * q2);
  // Extrapolated out of a sliver, 1/w may reach 0.
  const auto has_length = (rho2 > 1e-300) & (rho2 < 1e300);
  const W log2_rho = select(has_length, 0.5 * log2_of(select(has_length, rho2, W(1))), W(-1e6));
  const W lambda = log2_rho + to_wide(t.sampler.lod_bias);
  const W least = to_wide(t.sampler.min_lod), most = to_wide(t.sampler.max_lod);
  const W low = select(lambda > least, lambda, least);
  return to_float(select(low < most, low, most));
}

/// Texel coordinate `u`, mirrored in every odd image of a row of `size` texels. The coordinate is mirrored, not the
/// texel number (3.8.7): on the border of two texels, floor() then takes the texel right of the mirrored coordinate.
template <class W>
W mirrored(const W& u, const W& size) {
  const W image = floor_of(floor_of(u) / size), within = u - image * size;
  return select(image - 2.0 * floor_of(image * 0.5) != 0.0, size - within, within);
}

/// Number of texel `i` in a row of `size` texels after wrapping; -1: the border. `i`: an integer, |i| <= 2^40, so that
/// i / size in double never rounds up to the next integer.
template <class W>
W wrapped(Wrap wrap, const W& i, const W& size) {
  switch (wrap) {
    case Wrap::repeat: return i - floor_of(i / size) * size;
    case Wrap::mirrored_repeat:  // of a mirrored coordinate
    case Wrap::clamp_to_edge: return clamped(i, W(0), size - 1.0);
    case Wrap::clamp_to_border: return select((i < 0.0) | (i >= size), W(-1), i);
  }
  return i;
}
/// Numbers of texels `i` and i + 1, wrapped. `halves`: the sizes of all levels are powers of two.
template <class R>
[[gnu::always_inline]] inline std::array<Int<R>, 2> texel_numbers(Wrap wrap, const Wide<R>& i, const Wide<R>& size,
                                                                  bool halves) {
  if (wrap == Wrap::repeat && halves) {
    const Int<R> number = to_int(i), last = to_int(size) - Int<R>(1);
    return {number & last, (number + Int<R>(1)) & last};
  }
  return {to_int(wrapped<Wide<R>>(wrap, i, size)), to_int(wrapped<Wide<R>>(wrap, i + 1.0, size))};
}

/// Weighted mean (1 - k) x + k y.
template <class W>
W mix(const W& x, const W& y, const W& k) {
  return x + k * (y - x);
}

/// Width or height of a level [texels], or of each lane's level. `base`: that of level 0.
template <class R>
[[gnu::always_inline]] inline Wide<R> size_of_level(int base, int level) {
  return Wide<R>(static_cast<double>(std::max(base >> level, 1)));
}
template <class R>
[[gnu::always_inline]] inline Wide<R> size_of_level(int base, const R& level) {
  return greater_of(floor_of(static_cast<double>(base) * power_of_two(-to_wide(level))), Wide<R>(1));
}

/// Texels around the sample point in each lane's level: tap 0 below left of the point (with a nearest filter: the
/// nearest texel), 1 right of tap 0, 2 above, 3 right and above; and the point's fractions `right` and `above`, [0,1).
template <class R>
struct Taps {
  static constexpr int kLanes = Lanes<R>::width;
  const glm::vec4* texels[kLanes];  ///< of the level
  std::int32_t twice[4][kLanes];    ///< 2 x texel number (x86 scales an index by at most 8 bytes); below 0: the border
  double right[kLanes], above[kLanes];
};
/// `level`: one level's number, or each lane's. `linear`: the filter takes four taps, else tap 0 alone.
template <class R, class Level>
[[gnu::always_inline]] inline void find_taps(const TextureSetup& t, const Level& level, bool linear,
                                             const TexCoords<R>& at, Taps<R>& out) {
  using W = Wide<R>;
  using I = Int<R>;
  constexpr int kLanes = Lanes<R>::width;
  const TextureLevel& image = t.texture->levels[0];
  const Wrap wrap_s = t.sampler.wrap_s, wrap_t = t.sampler.wrap_t;
  const W shift(linear ? 0.5 : 0.0);
  const auto place = [&](Wrap wrap, const R& coordinate, const W& size) {
    // A plane extrapolated out of a sliver makes any number; a double counts texels up to 2^40 well.
    const W u = clamped<W>(to_wide(coordinate) * size, W(-0x1p40), W(0x1p40));
    return (wrap == Wrap::mirrored_repeat ? mirrored<W>(u, size) : u) - shift;
  };
  const auto halves = [](int base) { return std::has_single_bit(static_cast<unsigned>(base)); };
  const W width = size_of_level<R>(image.width, level), height = size_of_level<R>(image.height, level);
  const W u = place(wrap_s, at.s, width), v = place(wrap_t, at.t, height), i = floor_of(u), j = floor_of(v);
  const auto [x, right] = texel_numbers<R>(wrap_s, i, width, halves(image.width));
  const auto [y, above] = texel_numbers<R>(wrap_t, j, height, halves(image.height));
  if constexpr (std::is_same_v<Level, int>) {
    std::fill_n(out.texels, kLanes, t.texels[static_cast<std::size_t>(level)]);
  } else {
    std::int32_t levels[kLanes];
    store(to_int(level), levels);
    for (int lane = 0; lane < kLanes; ++lane) out.texels[lane] = t.texels[static_cast<std::size_t>(levels[lane])];
  }
  const auto find = [&](const I& column, const I& row, std::int32_t* to) {
    const I none(0), number = shifted_left<1>(row * to_int(width) + column);
    store(t.has_border ? select((column < none) | (row < none), I(-1), number) : number, to);
  };
  find(x, y, out.twice[0]);
  find(right, y, out.twice[1]);
  find(x, above, out.twice[2]);
  find(right, above, out.twice[3]);
  store(u - i, out.right);
  store(v - j, out.above);
}

/// Row (row_of_fours) of the mean of the taps by area, or, with a nearest filter, of tap 0.
template <class R, bool kBorder>
[[gnu::always_inline]] inline Wide<R> texel_row(const TextureSetup& t, const Taps<R>& taps, bool linear, int row) {
  using W = Wide<R>;
  const auto tap = [&](int i) {
    return row_of_fours(R(), row, [&](int lane) {
      const std::ptrdiff_t twice = taps.twice[i][lane];
      return kBorder && twice < 0 ? &t.border.r : reinterpret_cast<const float*>(taps.texels[lane]) + 2 * twice;
    });
  };
  if (!linear) return tap(0);
  const W right = row_of_shares(R(), row, taps.right), above = row_of_shares(R(), row, taps.above);
  return mix<W>(mix<W>(tap(0), tap(1), right), mix<W>(tap(2), tap(3), right), above);
}

/// Levels that lambda chooses: `first`, the nearest or, where two levels are mixed, the one below lambda; `two`,
/// whether level first + 1 is mixed in; k, its share [0,1).
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

/// Levels of a texel: `first` (int: one of all lanes, or R), mixed where `two` with `second`, whose share is k [0,1).
template <class R, class Level>
struct MixedLevels {
  Level first, second;
  Mask<R> two;
  Wide<R> k;
};

/// Texel of the levels, linear or nearest within a level. Rounded once, from double.
template <class R, bool kBorder, class Level>
Color<R> mix_levels(const TextureSetup& t, const TexCoords<R>& at, bool linear, const MixedLevels<R, Level>& of) {
  Taps<R> taps;
  find_taps<R>(t, of.first, linear, at, taps);
  Wide<R> low[4];
  for (int row = 0; row < 4; ++row) low[row] = texel_row<R, kBorder>(t, taps, linear, row);
  if (!any(of.two)) return fours_of_rows(low);
  find_taps<R>(t, of.second, linear, at, taps);
  double share[Lanes<R>::width];
  store(of.k, share);
  Wide<R> mixed[4];
  for (int row = 0; row < 4; ++row) {
    mixed[row] = mix<Wide<R>>(low[row], texel_row<R, kBorder>(t, taps, linear, row), row_of_shares(R(), row, share));
  }
  const Color<R> color = fours_of_rows(mixed);
  return all(of.two) ? color : select<R>(of.two, color, fours_of_rows(low));
}

template <class R, class Level>
Color<R> sample_levels(const TextureSetup& t, const TexCoords<R>& at, bool linear, const MixedLevels<R, Level>& of) {
  return t.has_border ? mix_levels<R, true>(t, at, linear, of) : mix_levels<R, false>(t, at, linear, of);
}

/// Texel of the base level by the magnification filter.
template <class R>
[[gnu::always_inline]] inline Color<R> magnified(const TextureSetup& t, const TexCoords<R>& at) {
  const R none(0);
  const int level = t.sampler.base_level;
  const MixedLevels<R, int> base{level, level, none != none, Wide<R>(0)};
  return sample_levels<R>(t, at, t.sampler.mag == MagFilter::linear, base);
}

/// Texel at level of detail `lod`, which is not NaN.
template <class R>
Color<R> sample(const TextureSetup& t, const TexCoords<R>& at, R lod) {
  const Sampler& s = t.sampler;
  const R c(static_cast<float>(t.c));
  const Mask<R> larger = lod <= c, smaller = lod > c;
  if (!any(smaller)) return magnified<R>(t, at);
  const bool linear = s.min == MinFilter::linear || s.min == MinFilter::linear_mipmap_nearest ||
                      s.min == MinFilter::linear_mipmap_linear;
  const Levels<R> of = levels<R>(t, lod);
  const R first = select(larger, R(static_cast<float>(s.base_level)), of.first);
  const Mask<R> two = of.two & smaller;
  const int one = static_cast<int>(greatest_lane(first));  // most often the level of all lanes
  const Color<R> low = [&] {
    if constexpr (Lanes<R>::width > 1) {
      if (!all(first == R(static_cast<float>(one)))) {
        const MixedLevels<R, R> each{first, select(two, first + R(1), first), two, of.k};
        return sample_levels<R>(t, at, linear, each);
      }
    }
    const MixedLevels<R, int> all_lanes{one, std::min(one + 1, t.last), two, of.k};
    return sample_levels<R>(t, at, linear, all_lanes);
  }();
  const bool alike = linear == (s.mag == MagFilter::linear);
  return alike || !any(larger) ? low : select<R>(larger, magnified<R>(t, at), low);
}

/// Stage 8 without the level of detail, which is not computed where all lanes are certainly magnified.
template <class R>
[[gnu::always_inline]] inline Color<R> texel_color(const TextureSetup& t, const TexCoords<R>& at,
                                                   const Gradients<R>& g) {
  const Wide<R> q2 = g.q * g.q;
  if (t.magnified_rho2 > 0 && all(longer_squared<R>(t, g) <= q2 * q2 * t.magnified_rho2)) return magnified<R>(t, at);
  return sample<R>(t, at, level_of_detail<R>(t, g));
}

/// Stage 8: the filtered texel and its level of detail.
template <class R>
FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& gradients) {
  const R lod = level_of_detail<R>(t, gradients);
  return {sample<R>(t, at, lod), lod};
}

}  // namespace plumbline::pipeline
