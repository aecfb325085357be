// Stage 9, with a texture: how the fragment's colour and the texel become one (OpenGL 2.1 spec, tables 3.22 and 3.23).
#pragma once

#include "kernels/attributes.h"
#include "scene/texture.h"

namespace plumbline::pipeline {

/// `f`: the fragment's colour, `s`: the texture source, both rgba. A sum is clamped to [0,1].
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

}  // namespace plumbline::pipeline
