#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "faults/lists.h"
#include "faults/variants.h"
#include "kernels/shade.h"

namespace plumbline::faults {

namespace {

using pipeline::FilteredTexel;
using pipeline::Gradients;
using pipeline::TexCoords;
using pipeline::TextureSetup;

// 8. Texture.

FilteredTexel<float> flipped_t(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  return pipeline::texture<float>(t, {at.s, 1 - at.t}, g);
}

FilteredTexel<float> s_for_t(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  return pipeline::texture<float>(t, {at.t, at.s}, {g.dt_dx, g.ds_dx, g.dt_dy, g.ds_dy, g.q});
}

FilteredTexel<float> half_texel_off(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const auto half = [](double texels) { return static_cast<float>(0.5 / texels); };
  return pipeline::texture<float>(t, {at.s + half(t.width), at.t + half(t.height)}, g);
}

FilteredTexel<float> scaled_by_size_less_one(const TextureSetup& t, const TexCoords<float>& at,
                                             const Gradients<float>& g) {
  const auto scaled = [](float v, double texels) { return static_cast<float>(v * (texels - 1) / texels); };
  return pipeline::texture<float>(t, {scaled(at.s, t.width), scaled(at.t, t.height)}, g);
}

// Texel coordinates of which the first and the last texel's centre are 0 and 1.
FilteredTexel<float> corners_aligned(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const auto aligned = [](float v, double texels) { return static_cast<float>((v * (texels - 1) + 0.5) / texels); };
  return pipeline::texture<float>(t, {aligned(at.s, t.width), aligned(at.t, t.height)}, g);
}

// Repeat wraps |s| and |t|.
FilteredTexel<float> negative_mirrored(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const auto repeated = [](Wrap wrap, float v) { return wrap == Wrap::repeat ? std::abs(v) : v; };
  return pipeline::texture<float>(t, {repeated(t.sampler.wrap_s, at.s), repeated(t.sampler.wrap_t, at.t)}, g);
}

// Whether a filter without levels takes a linear mean at that level of detail.
bool is_linear_at_base(const TextureSetup& t, float lod) {
  return lod <= t.c ? t.sampler.mag == MagFilter::linear : t.sampler.min == MinFilter::linear;
}

// Nearest texel (int) u for floor(u), where u is below 0.
FilteredTexel<float> truncated_towards_zero(const TextureSetup& t, const TexCoords<float>& at,
                                            const Gradients<float>& g) {
  const FilteredTexel<float> right = pipeline::texture<float>(t, at, g);
  const bool magnified = right.lod <= t.c;
  if (magnified ? t.sampler.mag != MagFilter::nearest : t.sampler.min != MinFilter::nearest) return right;
  const auto next = [](float v, double texels) { return v < 0 ? v + static_cast<float>(1 / texels) : v; };
  return {pipeline::sample<float>(t, {next(at.s, t.width), next(at.t, t.height)}, right.lod), right.lod};
}

// Mirrored repeat that begins with the mirror image.
FilteredTexel<float> mirrored_first(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const auto turned = [](Wrap wrap, float v) { return wrap == Wrap::mirrored_repeat ? v + 1 : v; };
  return pipeline::texture<float>(t, {turned(t.sampler.wrap_s, at.s), turned(t.sampler.wrap_t, at.t)}, g);
}

// Texels (int) u and (int) u + 1 of a linear filter for floor(u) and floor(u) + 1, where u is below 0, at the base
// level.
FilteredTexel<float> linear_truncated(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const FilteredTexel<float> right = pipeline::texture<float>(t, at, g);
  if (!is_linear_at_base(t, right.lod)) return right;
  const auto next = [](float v, double texels) {
    const double u = static_cast<double>(v) * texels - 0.5;
    return u < 0 && u != std::floor(u) ? v + static_cast<float>(1 / texels) : v;
  };
  return {pipeline::sample<float>(t, {next(at.s, t.width), next(at.t, t.height)}, right.lod), right.lod};
}

// Stage texture under a sampler that `change` altered.
template <auto change>
FilteredTexel<float> texture_under(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  TextureSetup wrong = t;
  change(wrong);
  return pipeline::texture<float>(wrong, at, g);
}

void wrap_otherwise(TextureSetup& t, Wrap from, Wrap to) {
  for (Wrap* wrap : {&t.sampler.wrap_s, &t.sampler.wrap_t}) *wrap = *wrap == from ? to : *wrap;
}
constexpr auto kClampForRepeat = [](TextureSetup& t) { wrap_otherwise(t, Wrap::repeat, Wrap::clamp_to_edge); };
constexpr auto kEdgeForBorder = [](TextureSetup& t) { wrap_otherwise(t, Wrap::clamp_to_border, Wrap::clamp_to_edge); };
// Repeat of coordinates alone: texels beyond an edge are those of that edge, not of the opposite one.
FilteredTexel<float> seam_clamped(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  TextureSetup wrong = t;
  kClampForRepeat(wrong);
  const auto repeated = [](Wrap wrap, float v) { return wrap == Wrap::repeat ? v - std::floor(v) : v; };
  return pipeline::texture<float>(wrong, {repeated(t.sampler.wrap_s, at.s), repeated(t.sampler.wrap_t, at.t)}, g);
}
constexpr auto kNoBias = [](TextureSetup& t) { t.sampler.lod_bias = 0; };
constexpr auto kAllLevels = [](TextureSetup& t) { t.last = static_cast<int>(t.texture->levels.size()) - 1; };
constexpr auto kMagnifiedAlways = [](TextureSetup& t) {
  t.sampler.min = t.sampler.mag == MagFilter::linear ? MinFilter::linear : MinFilter::nearest;
};

// The level of detail by x alone, as a scan line's stepping knows it.
FilteredTexel<float> levels_by_row(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  return pipeline::texture<float>(t, at, {g.ds_dx, g.dt_dx, g.ds_dx, g.dt_dx, g.q});
}

// Level of detail log2(rho^2) in place of log2(rho).
FilteredTexel<float> levels_doubled(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  TextureSetup unlimited = t;
  unlimited.sampler.lod_bias = 0;
  unlimited.sampler.min_lod = -1000;
  unlimited.sampler.max_lod = 1000;
  const float lambda = 2 * pipeline::level_of_detail<float>(unlimited, g) + t.sampler.lod_bias;
  const float lod = pipeline::clamped(lambda, t.sampler.min_lod, t.sampler.max_lod);
  return {pipeline::sample<float>(t, at, lod), lod};
}

// Texel of that level by the minification filter, whatever lambda is.
Color<float> minified(const TextureSetup& t, const TexCoords<float>& at, float level) {
  TextureSetup never_magnified = t;
  never_magnified.c = -1;
  return pipeline::sample<float>(never_magnified, at, level);
}

bool mixes_levels(const TextureSetup& t) {
  return t.sampler.min == MinFilter::nearest_mipmap_linear || t.sampler.min == MinFilter::linear_mipmap_linear;
}

// Two levels mixed with each other's shares.
FilteredTexel<float> levels_swapped(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  FilteredTexel<float> out = pipeline::texture<float>(t, at, g);
  const float whole = std::floor(out.lod);
  if (mixes_levels(t) && out.lod > t.c && out.lod != whole) out.color = minified(t, at, 2 * whole + 1 - out.lod);
  return out;
}

// Level below lambda, where the minification filter is one of `filters`.
template <MinFilter... filters>
FilteredTexel<float> level_below(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  FilteredTexel<float> out = pipeline::texture<float>(t, at, g);
  const bool by_filter = ((t.sampler.min == filters) || ...);
  if (by_filter && out.lod > t.c) out.color = minified(t, at, std::floor(out.lod));
  return out;
}
constexpr auto one_level = level_below<MinFilter::nearest_mipmap_linear, MinFilter::linear_mipmap_linear>;
constexpr auto levels_floored = level_below<MinFilter::nearest_mipmap_nearest, MinFilter::linear_mipmap_nearest>;

// A linear filter's weights along s and t exchanged, at the base level.
FilteredTexel<float> weights_exchanged(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const FilteredTexel<float> right = pipeline::texture<float>(t, at, g);
  if (!is_linear_at_base(t, right.lod)) return right;
  const double u = static_cast<double>(at.s) * t.width - 0.5, v = static_cast<double>(at.t) * t.height - 0.5;
  const double i = std::floor(u), j = std::floor(v);
  const auto s = static_cast<float>((i + (v - j) + 0.5) / t.width),
             r = static_cast<float>((j + (u - i) + 0.5) / t.height);
  return {pipeline::sample<float>(t, {s, r}, right.lod), right.lod};
}

// A linear filter's weights, each texel's for its neighbour, at the base level.
FilteredTexel<float> weights_reversed(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const FilteredTexel<float> right = pipeline::texture<float>(t, at, g);
  if (!is_linear_at_base(t, right.lod)) return right;
  const auto reversed = [](float v, double texels) {
    const double u = static_cast<double>(v) * texels - 0.5, i = std::floor(u);
    return static_cast<float>((i + 1 - (u - i) + 0.5) / texels);
  };
  return {pipeline::sample<float>(t, {reversed(at.s, t.width), reversed(at.t, t.height)}, right.lod), right.lod};
}

// 9. Shade.

using TexturedAttributes = pipeline::SurfaceAttributes<float>;

// Stage shade under a draw that `change` altered.
template <auto change>
pipeline::Shaded shaded_under(const pipeline::Surface& surface, bool front, const TexturedAttributes& attributes) {
  Draw wrong = *surface.draw;
  change(wrong);
  pipeline::Surface with_it = surface;
  with_it.draw = &wrong;
  return {pipeline::shade<float>(with_it, front, attributes)};
}

constexpr auto kModulateForReplace = [](Draw& draw) {
  if (draw.texture && draw.texture->environment == TextureEnvironment::replace) {
    draw.texture->environment = TextureEnvironment::modulate;
  }
};
constexpr auto kReplaceForDecal = [](Draw& draw) {
  if (draw.texture && draw.texture->environment == TextureEnvironment::decal) {
    draw.texture->environment = TextureEnvironment::replace;
  }
};
constexpr auto kNoEnvironmentColor = [](Draw& draw) {
  if (draw.texture) draw.texture->color = glm::vec4(0);
};
pipeline::Shaded texel_alpha_ignored(const pipeline::Surface& surface, bool front,
                                     const TexturedAttributes& attributes) {
  TexturedAttributes opaque = attributes;
  opaque.texel.color.a = 1;
  return {pipeline::shade<float>(surface, front, opaque)};
}

pipeline::Shaded decal_turned_round(const pipeline::Surface& surface, bool front,
                                    const TexturedAttributes& attributes) {
  TexturedAttributes turned = attributes;
  const bool is_decal = surface.draw->texture && surface.draw->texture->environment == TextureEnvironment::decal;
  if (is_decal) turned.texel.color.a = 1 - turned.texel.color.a;
  return {pipeline::shade<float>(surface, front, turned)};
}

constexpr std::array kTextures = {
    stage_fault("texture.t_flipped", "textures are upside down", put<&Stages::texture, flipped_t>),
    stage_fault("texture.s_for_t", "s and t change places", put<&Stages::texture, s_for_t>),
    stage_fault("texture.half_texel_off", "texels are taken for points at their lower left corners",
                put<&Stages::texture, half_texel_off>),
    stage_fault("texture.scaled_by_size_less_one", "texel coordinates are s (width - 1) and t (height - 1)",
                put<&Stages::texture, scaled_by_size_less_one>),
    stage_fault("texture.corners_aligned", "0 and 1 are the centres of a texture's first and last texel",
                put<&Stages::texture, corners_aligned>),
    stage_fault("texture.clamp_for_repeat", "textures are not repeated, but drawn out from their edges",
                put<&Stages::texture, texture_under<kClampForRepeat>>),
    stage_fault("texture.negative_mirrored", "repeated textures are mirrored where coordinates are negative",
                put<&Stages::texture, negative_mirrored>, "dolphin-emu/dolphin#9921"),
    stage_fault("texture.truncated_towards_zero",
                "of negative coordinates the next texel is taken: (int) u for floor(u)",
                put<&Stages::texture, truncated_towards_zero>),
    stage_fault("texture.linear_truncated",
                "of negative coordinates a linear filter takes the next texels: (int) u for floor(u)",
                put<&Stages::texture, linear_truncated>),
    stage_fault("texture.mirrored_first", "textures that are mirrored every other time begin with the mirror image",
                put<&Stages::texture, mirrored_first>),
    stage_fault("texture.seam_clamped", "filters do not reach across the seam of a texture that is repeated",
                put<&Stages::texture, seam_clamped>),
    stage_fault("texture.edge_for_border", "a texture's edge is drawn out where its border should be",
                put<&Stages::texture, texture_under<kEdgeForBorder>>, "xemu-project/xemu#1005"),
    stage_fault("texture.bias_left_out", "the texture's level-of-detail bias is not added",
                put<&Stages::texture, texture_under<kNoBias>>),
    stage_fault("texture.max_level_ignored", "levels beyond the last that may be sampled are",
                put<&Stages::texture, texture_under<kAllLevels>>),
    stage_fault("texture.magnified_always", "textures are filtered as where they are magnified",
                put<&Stages::texture, texture_under<kMagnifiedAlways>>),
    stage_fault("texture.levels_by_row", "the level of detail is that along x alone",
                put<&Stages::texture, levels_by_row>),
    stage_fault("texture.levels_doubled", "the level of detail is that of the pixel's area in texels",
                put<&Stages::texture, levels_doubled>, "bochs-emu/Bochs#222"),
    stage_fault("texture.one_level", "of two levels that should be mixed, the finer is taken",
                put<&Stages::texture, one_level>),
    stage_fault("texture.levels_floored", "of two levels the finer is taken where the nearer should be",
                put<&Stages::texture, levels_floored>),
    stage_fault("texture.weights_exchanged", "a linear filter's weights along s and t change places",
                put<&Stages::texture, weights_exchanged>),
    stage_fault("texture.weights_reversed", "of two texels mixed by a linear filter, each gets the other's share",
                put<&Stages::texture, weights_reversed>),
    stage_fault("texture.levels_swapped", "of two levels mixed, each gets the other's share",
                put<&Stages::texture, levels_swapped>),
    stage_fault("shade.modulate_for_replace", "the texture's colour is multiplied in where it should replace",
                put<&Stages::shade, shaded_under<kModulateForReplace>>),
    stage_fault("shade.replace_for_decal", "a decal covers where its alpha should let through",
                put<&Stages::shade, shaded_under<kReplaceForDecal>>),
    stage_fault("shade.decal_turned_round", "a decal covers where its alpha is 0, and lets through where it is 1",
                put<&Stages::shade, decal_turned_round>),
    stage_fault("shade.no_environment_color", "the texture environment's colour is black",
                put<&Stages::shade, shaded_under<kNoEnvironmentColor>>),
    stage_fault("shade.texel_alpha_ignored", "texels' alpha is taken for 1", put<&Stages::shade, texel_alpha_ignored>),
};

}  // namespace

std::span<const Fault> of_textures() { return kTextures; }

}  // namespace plumbline::faults
