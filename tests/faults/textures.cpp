#include "faults/textures.h"

#include <array>

#include "faults/variants.h"

namespace plumbline::faults {

namespace {

using pipeline::FilteredTexel;
using pipeline::Gradients;
using pipeline::TexCoords;
using pipeline::TextureSetup;

FilteredTexel<float> flipped_t(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  return pipeline::texture<float>(t, {at.s, float(1) - at.t}, g);
}

FilteredTexel<float> half_texel_off(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  const auto half = [](double texels) { return static_cast<float>(0.5 / texels); };
  return pipeline::texture<float>(t, {at.s + half(t.width), at.t + half(t.height)}, g);
}

FilteredTexel<float> clamped_for_repeated(const TextureSetup& t, const TexCoords<float>& at,
                                          const Gradients<float>& g) {
  TextureSetup wrong = t;
  for (Wrap* wrap : {&wrong.sampler.wrap_s, &wrong.sampler.wrap_t}) {
    if (*wrap == Wrap::repeat) *wrap = Wrap::clamp_to_edge;
  }
  return pipeline::texture<float>(wrong, at, g);
}

FilteredTexel<float> bias_left_out(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  TextureSetup wrong = t;
  wrong.sampler.lod_bias = 0;
  return pipeline::texture<float>(wrong, at, g);
}

/// The level of detail by x alone, as a scan line's stepping knows it.
FilteredTexel<float> levels_by_row(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  return pipeline::texture<float>(t, at, {g.ds_dx, g.dt_dx, g.ds_dx, g.dt_dx});
}

/// Two levels mixed with each other's shares.
FilteredTexel<float> levels_swapped(const TextureSetup& t, const TexCoords<float>& at, const Gradients<float>& g) {
  FilteredTexel<float> out = pipeline::texture<float>(t, at, g);
  const auto whole = static_cast<float>(static_cast<int>(out.lod));
  if (out.lod > t.c && out.lod != whole) out.color = pipeline::sample(t, at, whole + (1 - (out.lod - whole)));
  return out;
}

Color<float> modulate_for_replace(const pipeline::Surface& surface, bool front,
                                  const pipeline::SurfaceAttributes<float>& attributes) {
  Draw wrong = *surface.draw;
  if (wrong.texture && wrong.texture->environment == TextureEnvironment::replace) {
    wrong.texture->environment = TextureEnvironment::modulate;
  }
  pipeline::Surface with_it = surface;
  with_it.draw = &wrong;
  return pipeline::shade_surface<float>(with_it, front, attributes);
}

constexpr std::array kTextures = {
    Fault{"texture.t_flipped", "textures are upside down", Stage::texture, put<&Fragment::texture, flipped_t>},
    Fault{"texture.half_texel_off", "texels are taken for points at their lower left corners", Stage::texture,
          put<&Fragment::texture, half_texel_off>},
    Fault{"texture.clamp_for_repeat", "textures are not repeated, but drawn out from their edges", Stage::texture,
          put<&Fragment::texture, clamped_for_repeated>},
    Fault{"texture.bias_left_out", "the texture's level-of-detail bias is not added", Stage::texture,
          put<&Fragment::texture, bias_left_out>},
    Fault{"texture.levels_by_row", "the level of detail is that along x alone", Stage::texture,
          put<&Fragment::texture, levels_by_row>},
    Fault{"texture.levels_swapped", "of two levels mixed, each gets the other's share", Stage::texture,
          put<&Fragment::texture, levels_swapped>},
    Fault{"shade.modulate_for_replace", "the texture's colour is multiplied in where it should replace", Stage::shade,
          put<&Fragment::shade_surface, modulate_for_replace>},
};

}  // namespace

std::span<const Fault> of_textures() { return kTextures; }

}  // namespace plumbline::faults
