// Misread states of the stages texture and shade.
#include <algorithm>
#include <cmath>

#include "cli/likely/misread_state.h"

namespace plumbline::cli {

namespace {

MinFilter without_levels(MinFilter filter) {
  using enum MinFilter;
  if (!mipmaps(filter)) return filter;
  return filter == nearest_mipmap_nearest || filter == nearest_mipmap_linear ? nearest : linear;
}
MinFilter minified_as(MagFilter filter) {
  return filter == MagFilter::nearest ? MinFilter::nearest : MinFilter::linear;
}
MagFilter magnified_as(MinFilter filter) {
  return without_levels(filter) == MinFilter::nearest ? MagFilter::nearest : MagFilter::linear;
}

// Fragments are lit with `change`; of draws that are lit at their vertices, plumb list faults has the fault.
Change of_lit_fragments(std::function<bool(Scene&)> change) {
  return [change](Scene& scene) { return std::ranges::any_of(scene.draws, is_lit_per_fragment) && change(scene); };
}

constexpr auto kSwapsExponents = [](Draw& d) {
  if (!d.fog || d.fog->mode == Fog::Mode::linear) return false;
  d.fog->mode = d.fog->mode == Fog::Mode::exp ? Fog::Mode::exp2 : Fog::Mode::exp;
  return true;
};

template <Wrap to>
constexpr auto kWraps = [](Wrap from) {
  return of_samplers([from](Sampler& s) {
    bool changed = false;
    for (Wrap* wrap : {&s.wrap_s, &s.wrap_t}) changed |= *wrap == from && reset(*wrap, to);
    return changed;
  });
};

bool texture_stays(Scene& scene) {
  Scene stayed = scene;
  if (!stays<&Draw::texture>()(stayed)) return false;
  bool changed = false;
  for (std::size_t i = 0; i < scene.draws.size(); ++i) {
    Draw& draw = scene.draws[i];
    if (draw.texture || scene.meshes[draw.mesh].texcoords.empty() || !is_filled(draw)) continue;
    draw.texture = stayed.draws[i].texture;
    changed = changed || draw.texture;
  }
  return changed;
}

template <class To>
Change of_texels(To to) {
  return of_each<&Scene::textures>([to](Texture& texture) {
    bool changed = false;
    for (TextureLevel& level : texture.levels) {
      for (glm::vec4& texel : level.texels) changed |= reset(texel, to(texel));
    }
    return changed;
  });
}

// IEC 61966-2-1; alpha is linear.
glm::vec4 srgb_decoded(const glm::vec4& texel) {
  glm::vec4 out = texel;
  for (int i = 0; i < 3; ++i)
    out[i] = texel[i] <= 0.04045f ? texel[i] / 12.92f : std::pow((texel[i] + 0.055f) / 1.055f, 2.4f);
  return out;
}

bool squares_distance_alone(Draw& d) {
  return d.fog && d.fog->mode == Fog::Mode::exp2 && reset(d.fog->density, std::sqrt(d.fog->density));
}

}  // namespace

std::vector<MisreadState> states_of_textures() {
  return {
      {"texture", "filters_ignored", "the nearest texel is taken, whatever the filters", of_samplers([](Sampler& s) {
         const bool magnified = reset(s.mag, MagFilter::nearest);
         return reset(s.min, MinFilter::nearest) || magnified;
       })},
      {"texture", "levels_ignored", "all texels are of the largest level",
       of_samplers([](Sampler& s) { return reset(s.min, without_levels(s.min)); })},
      {"texture", "minified_as_magnified", "minified textures are filtered as magnified ones",
       of_samplers([](Sampler& s) { return reset(s.min, minified_as(s.mag)); })},
      {"texture", "magnified_as_minified", "magnified textures are filtered as minified ones",
       of_samplers([](Sampler& s) { return reset(s.mag, magnified_as(s.min)); })},
      {"texture", "levels_too_coarse", "textures are taken a level too coarse",
       of_samplers([](Sampler& s) { return reset(s.lod_bias, std::min(s.lod_bias + 1, 16.0f)); })},
      {"texture", "levels_too_fine", "textures are taken a level too fine",
       of_samplers([](Sampler& s) { return reset(s.lod_bias, std::max(s.lod_bias - 1, -16.0f)); })},
      {"texture", "wrap_of_s", "textures wrap in t as in s",
       of_samplers([](Sampler& s) { return reset(s.wrap_t, s.wrap_s); })},
      {"texture", "wraps_swapped", "textures wrap in t as in s, and the other way round", of_samplers([](Sampler& s) {
         std::swap(s.wrap_s, s.wrap_t);
         return s.wrap_s != s.wrap_t;
       })},
      {"texture", "repeat_for_clamp", "textures are repeated, though their edges are to be drawn out",
       kWraps<Wrap::repeat>(Wrap::clamp_to_edge)},
      {"texture", "repeat_for_mirror", "textures are repeated as they are, though every other is to be mirrored",
       kWraps<Wrap::repeat>(Wrap::mirrored_repeat)},
      {"texture", "blue_first", "textures' red and blue change places",
       of_texels([](const glm::vec4& c) { return glm::vec4(c.b, c.g, c.r, c.a); })},
      {"texture", "bytes_reversed", "texels are read from their last byte: alpha is taken for red",
       of_texels([](const glm::vec4& c) { return glm::vec4(c.a, c.b, c.g, c.r); })},
      {"texture", "srgb_decoded", "texels are taken for sRGB, and decoded", of_texels(srgb_decoded)},
      {"texture", "bias_negated", "the texture's level-of-detail bias is subtracted",
       of_samplers([](Sampler& s) { return reset(s.lod_bias, -s.lod_bias); })},
      {"texture", "lod_limits_ignored", "levels of detail have no least and no largest value",
       of_samplers([](Sampler& s) {
         const bool has_least = reset(s.min_lod, Sampler().min_lod);
         return reset(s.max_lod, Sampler().max_lod) || has_least;
       })},
      {"texture", "border_color_ignored", "textures' borders are black, with alpha 0", of_samplers([](Sampler& s) {
         const bool is_seen = s.wrap_s == Wrap::clamp_to_border || s.wrap_t == Wrap::clamp_to_border;
         return is_seen && reset(s.border, glm::vec4(0));
       })},
      {"shade", "attenuation_ignored", "lights do not fade with their distance",
       of_lit_fragments(of_lights([](Light& l) { return reset(l.attenuation, glm::vec3(1, 0, 0)); }))},
      {"shade", "spot_ignored", "spot lights shine to all sides",
       of_lit_fragments(of_lights([](Light& l) { return reset(l.spot); }))},
      {"shade", "local_viewer_ignored", "highlights are seen from infinitely far away, not from the eye",
       of_lit_fragments([](Scene& s) { return reset(s.light_model.local_viewer, false); })},
      {"shade", "texture_ignored", "textures are left out", of_draws([](Draw& d) { return reset(d.texture); })},
      {"shade", "texture_stays", "a draw without a texture has that of the draw before", texture_stays},
      {"shade", "fog_ignored", "there is no fog", of_draws([](Draw& d) { return reset(d.fog); })},
      {"shade", "fog_start_ignored", "linear fog begins at the eye", of_draws([](Draw& d) {
         return d.fog && d.fog->mode == Fog::Mode::linear && d.fog->end != 0 && reset(d.fog->start, 0.0f);
       })},
      {"shade", "fog_color_ignored", "fog is black",
       of_draws([](Draw& d) { return d.fog && reset(d.fog->color, glm::vec3(0)); })},
      {"shade", "fog_density_not_squared", "fog by exp2 squares the distance alone, not its product with the density",
       of_draws(squares_distance_alone)},
      {"shade", "fog_stays", "a draw without fog has that of the draw before", stays<&Draw::fog>()},
      {"shade", "fog_exponents_swapped", "fog by exp is by exp2, and the other way round", of_draws(kSwapsExponents)},
  };
}

}  // namespace plumbline::cli
