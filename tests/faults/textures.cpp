#include "faults/textures.h"

#include <array>

#include "faults/variants.h"

namespace plumbline::faults {

namespace {

using pipeline::FilteredTexel;
using pipeline::Gradients;
using pipeline::TexCoords;
using pipeline::TextureSetup;

struct FlippedT : pipeline::FragmentStages {
  template <class R>
  static FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& g) {
    return pipeline::texture<R>(t, {at.s, R(1) - at.t}, g);
  }
};

struct HalfTexelOff : pipeline::FragmentStages {
  template <class R>
  static FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& g) {
    const auto half = [](double texels) { return static_cast<float>(0.5 / texels); };
    return pipeline::texture<R>(t, {at.s + half(t.width), at.t + half(t.height)}, g);
  }
};

struct ClampedForRepeated : pipeline::FragmentStages {
  template <class R>
  static FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& g) {
    TextureSetup wrong = t;
    for (Wrap* wrap : {&wrong.sampler.wrap_s, &wrong.sampler.wrap_t}) {
      if (*wrap == Wrap::repeat) *wrap = Wrap::clamp_to_edge;
    }
    return pipeline::texture<R>(wrong, at, g);
  }
};

struct BiasLeftOut : pipeline::FragmentStages {
  template <class R>
  static FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& g) {
    TextureSetup wrong = t;
    wrong.sampler.lod_bias = 0;
    return pipeline::texture<R>(wrong, at, g);
  }
};

/// The level of detail by x alone, as a scan line's stepping knows it.
struct LevelsByRow : pipeline::FragmentStages {
  template <class R>
  static FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& g) {
    return pipeline::texture<R>(t, at, {g.ds_dx, g.dt_dx, g.ds_dx, g.dt_dx});
  }
};

/// Two levels mixed with each other's shares.
struct LevelsSwapped : pipeline::FragmentStages {
  template <class R>
  static FilteredTexel<R> texture(const TextureSetup& t, const TexCoords<R>& at, const Gradients<R>& g) {
    FilteredTexel<R> out = pipeline::texture<R>(t, at, g);
    const auto whole = static_cast<float>(static_cast<int>(out.lod));
    if (out.lod > t.c && out.lod != whole) out.color = pipeline::sample(t, at, whole + (1 - (out.lod - whole)));
    return out;
  }
};

struct ModulateForReplace : pipeline::FragmentStages {
  template <class R>
  static pipeline::Color<R> shade_surface(const pipeline::Surface& surface, bool front,
                                          const pipeline::SurfaceAttributes<R>& attributes) {
    Draw wrong = *surface.draw;
    if (wrong.texture && wrong.texture->environment == TextureEnvironment::replace) {
      wrong.texture->environment = TextureEnvironment::modulate;
    }
    pipeline::Surface with_it = surface;
    with_it.draw = &wrong;
    return pipeline::shade_surface<R>(with_it, front, attributes);
  }
};

constexpr std::array kTextures = {
    Fault{"texture.t_flipped", "textures are upside down", Stage::texture, with_fragment<FlippedT>},
    Fault{"texture.half_texel_off", "texels are taken for points at their lower left corners", Stage::texture,
          with_fragment<HalfTexelOff>},
    Fault{"texture.clamp_for_repeat", "textures are not repeated, but drawn out from their edges", Stage::texture,
          with_fragment<ClampedForRepeated>},
    Fault{"texture.bias_left_out", "the texture's level-of-detail bias is not added", Stage::texture,
          with_fragment<BiasLeftOut>},
    Fault{"texture.levels_by_row", "the level of detail is that along x alone", Stage::texture,
          with_fragment<LevelsByRow>},
    Fault{"texture.levels_swapped", "of two levels mixed, each gets the other's share", Stage::texture,
          with_fragment<LevelsSwapped>},
    Fault{"shade.modulate_for_replace", "the texture's colour is multiplied in where it should replace", Stage::shade,
          with_fragment<ModulateForReplace>},
};

}  // namespace

std::span<const Fault> of_textures() { return kTextures; }

}  // namespace plumbline::faults
