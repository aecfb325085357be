#include "cli/likely/ignored_states.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace plumbline::cli {

namespace {

// Puts a scene's state to its default, and returns whether that changes the scene.
using Reset = std::function<bool(Scene&)>;

template <class T>
bool reset(T& state, const T& to) {
  return std::exchange(state, to) != to;
}
template <class T>
bool reset(std::optional<T>& state) {
  return std::exchange(state, std::nullopt).has_value();
}

template <class ResetDraw>
Reset of_draws(ResetDraw reset_draw) {
  return [reset_draw](Scene& scene) {
    bool changed = false;
    for (Draw& draw : scene.draws) changed |= reset_draw(draw);
    return changed;
  };
}
template <class ResetMaterial>
Reset of_materials(ResetMaterial reset_material) {
  return of_draws([reset_material](Draw& d) {
    const bool front = d.lit && reset_material(d.material);
    return (d.lit && d.back_material && reset_material(*d.back_material)) || front;
  });
}

template <class ResetSampler>
Reset of_samplers(ResetSampler reset_sampler) {
  return [reset_sampler](Scene& scene) {
    bool changed = false;
    for (Texture& texture : scene.textures) changed |= reset_sampler(texture.sampler);
    return changed;
  };
}

MinFilter without_levels(MinFilter filter) {
  using enum MinFilter;
  if (!mipmaps(filter)) return filter;
  return filter == nearest_mipmap_nearest || filter == nearest_mipmap_linear ? nearest : linear;
}

bool reset_equation(Draw& draw) {
  if (!draw.merge.blend) return false;
  const bool rgb = reset(draw.merge.blend->rgb.equation, BlendEquation::add);
  return reset(draw.merge.blend->alpha.equation, BlendEquation::add) || rgb;
}

// Fragments are lit with `change`; of draws that are lit at their vertices, plumb list faults has the fault.
Reset of_lit_fragments(std::function<bool(Scene&)> change) {
  return [change](Scene& scene) { return std::ranges::any_of(scene.draws, is_lit_per_fragment) && change(scene); };
}
template <class ResetLight>
Reset of_lights(ResetLight reset_light) {
  return [reset_light](Scene& scene) {
    bool changed = false;
    for (Light& light : scene.lights) changed |= reset_light(light);
    return changed;
  };
}

bool reset_ambient(Scene& scene) {
  bool changed = reset(scene.light_model.ambient, glm::vec3(0));
  for (Light& light : scene.lights) changed |= reset(light.ambient, glm::vec3(0));
  return changed;
}

struct IgnoredState {
  const char *stage, *state, *says;
  Reset reset;
};

// In the order of the stages.
std::vector<IgnoredState> all_states() {
  const glm::vec4 black(0, 0, 0, 1);
  return {
      {"matrices", "transforms", "draws are not moved, turned or scaled",
       of_draws([](Draw& d) { return !std::exchange(d.transforms, {}).empty(); })},
      {"light", "lighting", "draws are not lit", of_draws([](Draw& d) { return reset(d.lit, false); })},
      {"light", "lights", "no light shines but the ambient one",
       [](Scene& s) { return !std::exchange(s.lights, {}).empty(); }},
      {"light", "ambient", "no ambient light is added", reset_ambient},
      {"light", "specular", "there are no highlights",
       of_materials([=](Material& m) { return reset(m.specular, black); })},
      {"light", "emission", "materials do not shine by themselves",
       of_materials([=](Material& m) { return reset(m.emission, black); })},
      {"light", "two_sides", "back faces are lit as front faces",
       [](Scene& s) { return reset(s.light_model.sides, LightModel::Sides::one); }},
      {"light", "phong_shading", "draws are lit at their vertices, not at their fragments",
       of_draws([](Draw& d) { return d.shading == Shading::phong && reset(d.shading, Shading::gouraud); })},
      {"clip", "flat_shading", "flat triangles have the colours of all corners",
       of_draws([](Draw& d) { return d.shading == Shading::flat && reset(d.shading, Shading::gouraud); })},
      {"clip", "depth_clamp", "near and far planes cut, though depths are to be clamped",
       [](Scene& s) { return reset(s.depth_clamp, false); }},
      {"window", "cull", "no face is culled", of_draws([](Draw& d) { return reset(d.cull, Cull::none); })},
      {"window", "polygon_mode", "triangles are filled, whatever their mode", of_draws([](Draw& d) {
         const bool front = reset(d.front_mode, PolygonMode::fill);
         return reset(d.back_mode, PolygonMode::fill) || front;
       })},
      {"window", "line_width", "lines are one pixel wide", of_draws([](Draw& d) { return reset(d.line_width, 1); })},
      {"window", "point_size", "points are one pixel large", of_draws([](Draw& d) { return reset(d.point_size, 1); })},
      {"coverage", "scissor", "scissor boxes hide nothing", of_draws([](Draw& d) { return reset(d.scissor); })},
      {"depth", "polygon_offset", "depths are not offset",
       of_draws([](Draw& d) { return reset(d.polygon_offset, PolygonOffset()); })},
      {"texture", "filters", "the nearest texel is taken, whatever the filters", of_samplers([](Sampler& s) {
         const bool magnified = reset(s.mag, MagFilter::nearest);
         return reset(s.min, MinFilter::nearest) || magnified;
       })},
      {"texture", "levels", "all texels are of the largest level",
       of_samplers([](Sampler& s) { return reset(s.min, without_levels(s.min)); })},
      {"shade", "attenuation", "lights do not fade with their distance",
       of_lit_fragments(of_lights([](Light& l) { return reset(l.attenuation, glm::vec3(1, 0, 0)); }))},
      {"shade", "spot", "spot lights shine to all sides",
       of_lit_fragments(of_lights([](Light& l) { return reset(l.spot); }))},
      {"shade", "local_viewer", "highlights are seen from infinitely far away, not from the eye",
       of_lit_fragments([](Scene& s) { return reset(s.light_model.local_viewer, false); })},
      {"shade", "texture", "textures are left out", of_draws([](Draw& d) { return reset(d.texture); })},
      {"shade", "fog", "there is no fog", of_draws([](Draw& d) { return reset(d.fog); })},
      {"visibility", "depth_func", "all depth tests are less",
       of_draws([](Draw& d) { return reset(d.depth_func, DepthFunc::less); })},
      {"visibility", "depth_test", "every depth passes: what is drawn last is seen",
       of_draws([](Draw& d) { return reset(d.depth_func, DepthFunc::always); })},
      {"visibility", "depth_mask", "depths are written, though they are masked",
       of_draws([](Draw& d) { return reset(d.merge.depth_mask, true); })},
      {"visibility", "clear_depth", "the depth is cleared to 1",
       [](Scene& s) { return reset(s.frame.clear_depth, 1.0); }},
      {"visibility", "stencil", "stencil values hide nothing", of_draws([](Draw& d) { return reset(d.stencil); })},
      {"merge", "blend", "colours replace what is stored, and are not blended with it",
       of_draws([](Draw& d) { return reset(d.merge.blend); })},
      {"merge", "blend_equation", "blended colours are added, whatever the equation", of_draws(reset_equation)},
      {"merge", "logic_op", "logic ops are not applied", of_draws([](Draw& d) { return reset(d.merge.logic_op); })},
      {"merge", "clear_color", "the frame is cleared to black",
       [=](Scene& s) { return reset(s.frame.clear_color, black); }},
  };
}

}  // namespace

std::vector<KnownFault> ignored_states(const Scene& scene) {
  std::vector<KnownFault> out;
  for (const IgnoredState& state : all_states()) {
    Scene changed = scene;
    if (!state.reset(changed)) continue;
    out.push_back({.stage = state.stage,
                   .name = std::string(state.stage) + "." + state.state + "_ignored",
                   .says = state.says,
                   .of_scene = [reset = state.reset](Scene& s) { reset(s); }});
  }
  return out;
}

}  // namespace plumbline::cli
