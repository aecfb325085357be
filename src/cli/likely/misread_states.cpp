#include "cli/likely/misread_states.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace plumbline::cli {

namespace {

// Gives a scene's state another value, and returns whether that changes the scene.
using Change = std::function<bool(Scene&)>;

template <class T>
bool reset(T& state, const T& to) {
  return std::exchange(state, to) != to;
}
template <class T>
bool reset(std::optional<T>& state) {
  return std::exchange(state, std::nullopt).has_value();
}

// Changes each of the scene's `items`: its draws, for instance.
template <auto items, class ResetItem>
Change of_each(ResetItem reset_item) {
  return [reset_item](Scene& scene) {
    bool changed = false;
    for (auto& item : scene.*items) changed |= reset_item(item);
    return changed;
  };
}
template <class ResetDraw>
Change of_draws(ResetDraw reset_draw) {
  return of_each<&Scene::draws>(reset_draw);
}
template <class ResetLight>
Change of_lights(ResetLight reset_light) {
  return of_each<&Scene::lights>(reset_light);
}
template <class ResetSampler>
Change of_samplers(ResetSampler reset_sampler) {
  return of_each<&Scene::textures>([reset_sampler](Texture& texture) { return reset_sampler(texture.sampler); });
}
template <class ResetMaterial>
Change of_materials(ResetMaterial reset_material) {
  return of_draws([reset_material](Draw& d) {
    const bool front = d.lit && reset_material(d.material);
    return (d.lit && d.back_material && reset_material(*d.back_material)) || front;
  });
}

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

bool reset_equation(Draw& draw) {
  if (!draw.merge.blend) return false;
  const bool rgb = reset(draw.merge.blend->rgb.equation, BlendEquation::add);
  return reset(draw.merge.blend->alpha.equation, BlendEquation::add) || rgb;
}

// Fragments are lit with `change`; of draws that are lit at their vertices, plumb list faults has the fault.
Change of_lit_fragments(std::function<bool(Scene&)> change) {
  return [change](Scene& scene) { return std::ranges::any_of(scene.draws, is_lit_per_fragment) && change(scene); };
}

bool reset_ambient(Scene& scene) {
  bool changed = reset(scene.light_model.ambient, glm::vec3(0));
  for (Light& light : scene.lights) changed |= reset(light.ambient, glm::vec3(0));
  return changed;
}

constexpr auto kSwapsExponents = [](Draw& d) {
  if (!d.fog || d.fog->mode == Fog::Mode::linear) return false;
  d.fog->mode = d.fog->mode == Fog::Mode::exp ? Fog::Mode::exp2 : Fog::Mode::exp;
  return true;
};

constexpr auto kBlendsByAlpha = [](Draw& d) {
  if (!d.merge.blend) return false;
  bool changed = false;
  for (BlendTerm* term : {&d.merge.blend->rgb, &d.merge.blend->alpha}) {
    changed |= reset(term->source, BlendFactor::source_alpha);
    changed |= reset(term->destination, BlendFactor::one_minus_source_alpha);
  }
  return changed;
};

template <auto factor>
bool becomes_one(Draw& d) {
  if (!d.merge.blend) return false;
  const bool rgb = reset(d.merge.blend->rgb.*factor, BlendFactor::one);
  return reset(d.merge.blend->alpha.*factor, BlendFactor::one) || rgb;
}

template <Normals from, Normals to>
constexpr auto kNormals = [](Draw& d) { return d.lit && d.normals == from && reset(d.normals, to); };

// Shininess times `factor`, in [0, 128].
auto shines_by(float factor) {
  return of_materials([factor](Material& m) {
    return m.specular != glm::vec4(0, 0, 0, m.specular.a) && reset(m.shininess, std::min(m.shininess * factor, 128.0f));
  });
}

template <Wrap to>
constexpr auto kWraps = [](Wrap from) {
  return of_samplers([from](Sampler& s) {
    bool changed = false;
    for (Wrap* wrap : {&s.wrap_s, &s.wrap_t}) changed |= *wrap == from && reset(*wrap, to);
    return changed;
  });
};

// Scissor box of which width and height are taken for its right and its upper side.
bool end_at_size(Draw& d) {
  if (!d.scissor) return false;
  const bool is_narrower = reset(d.scissor->width, std::max(d.scissor->width - d.scissor->x, 0));
  return reset(d.scissor->height, std::max(d.scissor->height - d.scissor->y, 0)) || is_narrower;
}

bool scissor_from_other_side(Scene& scene) {
  return of_draws([height = scene.frame.height](Draw& d) {
    if (!d.scissor) return false;
    const int low = height - d.scissor->y - d.scissor->height;
    const bool is_lower = reset(d.scissor->height, std::max(d.scissor->height + std::min(low, 0), 0));
    return reset(d.scissor->y, std::max(low, 0)) || is_lower;
  })(scene);
}

template <class T>
bool is_set(const std::optional<T>& state) {
  return state.has_value();
}
bool is_set(const PolygonOffset& offset) { return offset != PolygonOffset(); }
bool is_set(Cull cull) { return cull != Cull::none; }
bool is_set(DepthFunc func) { return func != DepthFunc::less; }
bool is_set(const DepthRange& range) { return range != DepthRange(); }
bool is_set(bool writes_depth) { return !writes_depth; }
bool is_set(const glm::bvec4& written) { return written != glm::bvec4(true); }

// Member of a draw, or of its merge state.
template <auto member>
auto& member_of(Draw& draw) {
  if constexpr (requires { draw.*member; }) {
    return draw.*member;
  } else {
    return draw.merge.*member;
  }
}

// Member that persists: a draw that does not set it has that of the draw before.
template <auto member>
Change stays() {
  return [](Scene& scene) {
    bool changed = false;
    for (std::size_t i = 1; i < scene.draws.size(); ++i) {
      auto &before = member_of<member>(scene.draws[i - 1]), &here = member_of<member>(scene.draws[i]);
      if (is_set(here) || !is_set(before)) continue;
      here = before;
      changed = true;
    }
    return changed;
  };
}

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

bool swap_texels_red_and_blue(Scene& scene) {
  bool changed = false;
  for (Texture& texture : scene.textures) {
    for (TextureLevel& level : texture.levels) {
      for (glm::vec4& texel : level.texels) {
        changed |= texel.r != texel.b;
        std::swap(texel.r, texel.b);
      }
    }
  }
  return changed;
}

/// A state, and how a renderer misreads it: `change` returns whether the scene is another by it.
struct MisreadState {
  const char *stage, *name, *says;
  Change change;
  /// Whether the stage is shade where fragments are lit, and no vertices.
  bool is_of_light_equation = false;
};

constexpr bool kOfLightEquation = true;

bool are_fragments_lit_alone(const Scene& scene) {
  return std::ranges::any_of(scene.draws, is_lit_per_fragment) && std::ranges::none_of(scene.draws, is_lit_per_vertex);
}

// In the order of the stages.
std::vector<MisreadState> all_states() {
  const glm::vec4 black(0, 0, 0, 1);
  return {
      {"matrices", "depth_range_ignored", "depths are mapped to [0, 1], whatever the depth range",
       of_draws([](Draw& d) { return reset(d.depth_range, DepthRange()); })},
      {"matrices", "depth_range_stays", "a draw without a depth range has that of the draw before",
       stays<&Draw::depth_range>()},
      {"matrices", "transforms_ignored", "draws are not moved, turned or scaled",
       of_draws([](Draw& d) { return !std::exchange(d.transforms, {}).empty(); })},
      {"vertex", "normals_normalized", "normals are brought to unit length, though they are to stay as they are",
       of_draws(kNormals<Normals::as_they_are, Normals::normalize>)},
      {"vertex", "rescale_ignored", "normals stay as they are, though they are to be scaled back",
       of_draws(kNormals<Normals::rescale, Normals::as_they_are>)},
      {"light", "lighting_ignored", "draws are not lit", of_draws([](Draw& d) { return reset(d.lit, false); })},
      {"light", "lights_ignored", "no light shines but the ambient one",
       [](Scene& s) { return !std::exchange(s.lights, {}).empty(); }, kOfLightEquation},
      {"light", "ambient_ignored", "no ambient light is added", reset_ambient, kOfLightEquation},
      {"light", "ambient_without_material", "ambient light is not multiplied by the material's ambient colour",
       of_materials([](Material& m) { return reset(m.ambient, glm::vec4(1, 1, 1, m.ambient.a)); }), kOfLightEquation},
      {"light", "colors_ignored", "meshes' colours are not used: the material's diffuse colour is",
       of_each<&Scene::meshes>([](Mesh& m) { return !std::exchange(m.colors, {}).empty(); })},
      {"light", "point_as_direction", "a point light's position is taken for the direction to the light",
       of_lights(
           [](Light& l) { return !l.spot && l.vector != glm::dvec3(0) && reset(l.kind, Light::Kind::directional); })},
      {"light", "specular_ignored", "there are no highlights",
       of_materials([=](Material& m) { return reset(m.specular, black); }), kOfLightEquation},
      {"light", "shininess_doubled", "highlights have twice their shininess", shines_by(2), kOfLightEquation},
      {"light", "shininess_halved", "highlights have half their shininess", shines_by(0.5f), kOfLightEquation},
      {"light", "emission_ignored", "materials do not shine by themselves",
       of_materials([=](Material& m) { return reset(m.emission, black); }), kOfLightEquation},
      {"light", "two_sides_ignored", "back faces are lit as front faces",
       [](Scene& s) { return reset(s.light_model.sides, LightModel::Sides::one); }, kOfLightEquation},
      {"light", "phong_shading_ignored", "draws are lit at their vertices, not at their fragments",
       of_draws([](Draw& d) { return d.shading == Shading::phong && reset(d.shading, Shading::gouraud); })},
      {"clip", "flat_shading_ignored", "flat triangles have the colours of all corners",
       of_draws([](Draw& d) { return d.shading == Shading::flat && reset(d.shading, Shading::gouraud); })},
      {"clip", "depth_clamp_ignored", "near and far planes cut, though depths are to be clamped",
       [](Scene& s) { return reset(s.depth_clamp, false); }},
      {"window", "cull_ignored", "no face is culled", of_draws([](Draw& d) { return reset(d.cull, Cull::none); })},
      {"window", "cull_stays", "a draw that culls no face culls as the draw before", stays<&Draw::cull>()},
      {"window", "polygon_mode_ignored", "triangles are filled, whatever their mode", of_draws([](Draw& d) {
         const bool front = reset(d.front_mode, PolygonMode::fill);
         return reset(d.back_mode, PolygonMode::fill) || front;
       })},
      {"window", "line_width_ignored", "lines are one pixel wide",
       of_draws([](Draw& d) { return reset(d.line_width, 1); })},
      {"window", "point_size_ignored", "points are one pixel large",
       of_draws([](Draw& d) { return reset(d.point_size, 1); })},
      {"coverage", "scissor_ignored", "scissor boxes hide nothing", of_draws([](Draw& d) { return reset(d.scissor); })},
      {"coverage", "scissor_by_corners", "a scissor box's width and height are taken for its right and upper side",
       of_draws(end_at_size)},
      {"coverage", "scissor_from_other_side", "scissor boxes are counted from the other side of the frame",
       scissor_from_other_side},
      {"coverage", "scissor_stays", "a draw without a scissor box has that of the draw before",
       stays<&Draw::scissor>()},
      {"depth", "polygon_offset_ignored", "depths are not offset",
       of_draws([](Draw& d) { return reset(d.polygon_offset, PolygonOffset()); })},
      {"depth", "offset_without_units", "depths are offset by their slope alone",
       of_draws([](Draw& d) { return reset(d.polygon_offset.units, 0.0f); })},
      {"depth", "polygon_offset_stays", "a draw without a polygon offset has that of the draw before",
       stays<&Draw::polygon_offset>()},
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
      {"texture", "blue_first", "textures' red and blue change places", swap_texels_red_and_blue},
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
      {"shade", "fog_stays", "a draw without fog has that of the draw before", stays<&Draw::fog>()},
      {"shade", "fog_exponents_swapped", "fog by exp is by exp2, and the other way round", of_draws(kSwapsExponents)},
      {"visibility", "depth_func_ignored", "all depth tests are less",
       of_draws([](Draw& d) { return reset(d.depth_func, DepthFunc::less); })},
      {"visibility", "depth_test_ignored", "every depth passes: what is drawn last is seen",
       of_draws([](Draw& d) { return reset(d.depth_func, DepthFunc::always); })},
      {"visibility", "depth_mask_ignored", "depths are written, though they are masked",
       of_draws([](Draw& d) { return reset(d.merge.depth_mask, true); })},
      {"visibility", "depth_func_stays", "a draw of depth function less has that of the draw before",
       stays<&Draw::depth_func>()},
      {"visibility", "depth_mask_stays", "depth writes stay off after a draw without them",
       stays<&Merge::depth_mask>()},
      {"visibility", "alpha_test_stays", "a draw without an alpha test has that of the draw before",
       stays<&Draw::alpha_test>()},
      {"visibility", "clear_depth_ignored", "the depth is cleared to 1",
       [](Scene& s) { return reset(s.frame.clear_depth, 1.0); }},
      {"visibility", "stencil_ignored", "stencil values hide nothing",
       of_draws([](Draw& d) { return reset(d.stencil); })},
      {"visibility", "stencil_back_ignored", "back faces have the front faces' stencil test",
       of_draws([](Draw& d) { return d.stencil && reset(d.stencil->back, d.stencil->front); })},
      {"visibility", "depth_fail_as_fail", "depth_fail is taken for fail in stencil ops", of_draws([](Draw& d) {
         if (!d.stencil) return false;
         const bool front = reset(d.stencil->front.depth_fail, d.stencil->front.fail);
         return reset(d.stencil->back.depth_fail, d.stencil->back.fail) || front;
       })},
      {"visibility", "stencil_stays", "a draw without a stencil test has that of the draw before",
       stays<&Draw::stencil>()},
      {"merge", "blend_ignored", "colours replace what is stored, and are not blended with it",
       of_draws([](Draw& d) { return reset(d.merge.blend); })},
      {"merge", "blend_stays", "a draw that does not blend blends as the draw before", stays<&Merge::blend>()},
      {"merge", "logic_op_stays", "a draw without a logic op has that of the draw before", stays<&Merge::logic_op>()},
      {"merge", "color_mask_stays", "a draw that writes all channels writes those of the draw before",
       stays<&Merge::color_mask>()},
      {"merge", "mask_blue_first", "the mask of red is taken for that of blue, and the other way round",
       of_draws([](Draw& d) {
         std::swap(d.merge.color_mask.r, d.merge.color_mask.b);
         return d.merge.color_mask.r != d.merge.color_mask.b;
       })},
      {"merge", "blend_factors_ignored", "blending is by the source's alpha, whatever the factors",
       of_draws(kBlendsByAlpha)},
      {"merge", "source_factor_of_one", "blending adds the source's colour as it is, whatever its factor",
       of_draws(becomes_one<&BlendTerm::source>)},
      {"merge", "destination_factor_of_one", "blending adds to the stored colour as it is, whatever its factor",
       of_draws(becomes_one<&BlendTerm::destination>)},
      {"merge", "blend_equation_ignored", "blended colours are added, whatever the equation", of_draws(reset_equation)},
      {"merge", "logic_op_ignored", "logic ops are not applied",
       of_draws([](Draw& d) { return reset(d.merge.logic_op); })},
      {"merge", "clear_color_ignored", "the frame is cleared to black",
       [=](Scene& s) { return reset(s.frame.clear_color, black); }},
  };
}

}  // namespace

std::vector<KnownFault> misread_states() {
  std::vector<KnownFault> out;
  for (const MisreadState& state : all_states()) {
    out.push_back({.stage = state.stage,
                   .name = std::string(state.stage) + "." + state.name,
                   .says = state.says,
                   .of_scene = [change = state.change](Scene& s) { change(s); }});
  }
  return out;
}

std::vector<KnownFault> misread_states(const Scene& scene) {
  std::vector<KnownFault> out;
  const std::vector<MisreadState> states = all_states();
  std::vector<KnownFault> all = misread_states();
  for (std::size_t i = 0; i < states.size(); ++i) {
    Scene changed = scene;
    if (!states[i].change(changed)) continue;
    if (states[i].is_of_light_equation && are_fragments_lit_alone(scene)) all[i].stage = "shade";
    out.push_back(std::move(all[i]));
  }
  return out;
}

}  // namespace plumbline::cli
