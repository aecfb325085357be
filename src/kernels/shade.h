// Stage 9: the fragment's colour from its attributes: light per fragment, texture environment, sum of colours, fog.
#pragma once

#include <array>
#include <optional>

#include "capture/stages.h"
#include "kernels/attributes.h"
#include "kernels/light_equation.h"
#include "kernels/texture.h"
#include "scene/fixed_vector.h"
#include "scene/scene.h"
#include "scene/texture.h"

namespace plumbline::pipeline {

/// Per-draw state of stages 7 to 9. Points into the scene, which must outlive it.
struct Surface {
  const Scene* scene = nullptr;
  const Draw* draw = nullptr;
  std::optional<FragmentLight> light;       ///< none: lit at the vertices, or not at all
  FixedVector<Varying, kVaryings> carried;  ///< varyings of the draw's fragments, in the enum's order
  std::optional<TextureSetup> texture;
  const void* program = nullptr;  ///< a user's fragment program (program.h)
};
/// Surface of the draw. `lights`: stage 0's.
inline Surface surface_of(const Scene& scene, const Draw& draw, Lights lights) {
  Surface surface{&scene, &draw, {}, {}, {}};
  if (draw.texture) {
    const Texture& texture = scene.textures.at(draw.texture->texture);
    surface.texture = texture_setup(texture, texture.sampler);
  }
  if (is_lit_per_fragment(draw)) surface.light = fragment_light(scene, draw, lights);
  for (const Varying v : kAllVaryings) {
    if (!is_back(v) && carries(scene, draw, v)) surface.carried.push_back(v);
  }
  return surface;
}

/// Input of stage 9: a fragment's attributes and texel. Never read are varyings that the surface does not carry, the
/// texel of a surface without a texture, and any texel's lod: the definition sets these to 0, the painter leaves these
/// unset.
template <class R>
struct SurfaceAttributes {
  Color<R> color;
  std::array<Color<R>, kVaryings> varyings;
  FilteredTexel<R> texel;
  const Color<R>& operator[](Varying v) const { return varyings[index_of(v)]; }
  Color<R>& operator[](Varying v) { return varyings[index_of(v)]; }
};

/// Texture environment (OpenGL 2.1 spec, tables 3.22 and 3.23). `f`: the fragment's colour, `s`: the texture source,
/// both rgba. A sum is clamped to [0,1].
template <class R>
Color<R> apply_environment(TextureFormat format, const DrawTexture& state, const Color<R>& f, const Color<R>& s) {
  using E = TextureEnvironment;
  const bool has_color = format != TextureFormat::alpha;
  const bool has_alpha = format != TextureFormat::luminance && format != TextureFormat::rgb;
  const bool intensity = format == TextureFormat::intensity;
  const auto rgb = [&](R cf, R cs, float constant) -> R {
    if (!has_color) return cf;
    switch (state.environment) {
      case E::replace: return cs;
      case E::modulate: return cf * cs;
      case E::decal: return format == TextureFormat::rgb ? cs : cf * (R(1) - s.a) + cs * s.a;
      case E::blend: return cf * (R(1) - cs) + constant * cs;
      case E::add: return clamp01(cf + cs);
    }
    return cf;
  };
  const auto alpha = [&]() -> R {
    if (!has_alpha || state.environment == E::decal) return f.a;
    if (state.environment == E::replace) return s.a;
    if (intensity && state.environment == E::blend) return f.a * (R(1) - s.a) + state.color.a * s.a;
    if (intensity && state.environment == E::add) return clamp01(f.a + s.a);
    return f.a * s.a;
  };
  return {rgb(f.r, s.r, state.color.r), rgb(f.g, s.g, state.color.g), rgb(f.b, s.b, state.color.b), alpha()};
}

/// Fog factor f (OpenGL 2.1 spec 3.10), [0,1]: the share of the fragment's own colour at the distance c = |z_eye|,
/// which the specification allows in place of the distance from the eye. In double, rounded once.
template <class R>
R fog_factor(const Fog& fog, R z_eye) {
  using W = Wide<R>;
  constexpr double kLog2OfE = 1.4426950408889634;
  const W z = to_wide(z_eye), c = select(z < 0.0, -z, z);
  const W x = c * static_cast<double>(fog.density);
  switch (fog.mode) {
    case Fog::Mode::linear: return to_float(clamp01((W(fog.end) - c) / (W(fog.end) - W(fog.start))));
    case Fog::Mode::exp: return to_float(exp2_of(-x * kLog2OfE));
    case Fog::Mode::exp2: return to_float(exp2_of(-(x * x) * kLog2OfE));
  }
  return R(1);
}

/// Fogged colour f c + (1 - f) c_fog; alpha as it is.
template <class R>
Color<R> fogged(const Fog& fog, const Color<R>& color, R z_eye) {
  const R f = fog_factor<R>(fog, z_eye), rest = R(1) - f;
  return {f * Vec3<R>(color) + rest * Vec3<R>(fog.color), color.a};
}

/// Colour sum (OpenGL 2.1 spec 3.9): primary.rgb + secondary.rgb, and primary's alpha; clamped to [0,1].
template <class R>
Color<R> color_sum(const Color<R>& primary, const Color<R>& secondary) {
  const Color<R> sum = primary + secondary;
  return {clamp01(sum.r), clamp01(sum.g), clamp01(sum.b), clamp01(primary.a)};
}

/// Stage 9 in OpenGL's order (2.1, figure 3.1): light, where it is per fragment, texture environment, sum of colours,
/// fog. `front`: the triangle's facing; chooses the material where light has two sides.
template <class R>
Color<R> shade(const Surface& surface, bool front, const SurfaceAttributes<R>& attributes) {
  const LightModel& model = surface.scene->light_model;
  const auto lit_part = [&](bool specular) {
    const bool back = !front && model.sides == LightModel::Sides::two;
    return lit_fragment(*surface.light, {back, specular}, attributes.color, attributes[Varying::normal],
                        attributes[Varying::position]);
  };
  Color<R> color = surface.light ? lit_part(false) : attributes.color;
  if (surface.texture) {
    color =
        apply_environment<R>(surface.texture->texture->format, *surface.draw->texture, color, attributes.texel.color);
  }
  if (surface.draw->lit && model.separate_specular) {
    color = color_sum<R>(color, surface.light ? lit_part(true) : attributes[Varying::secondary]);
  }
  if (surface.draw->fog) color = fogged<R>(*surface.draw->fog, color, attributes[Varying::position].b);
  return color;
}

}  // namespace plumbline::pipeline
