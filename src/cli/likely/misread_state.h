// A state of the scene that a renderer ignores, or takes for another, and the parts of which the tables of such states
// are made.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace plumbline::cli {

/// Gives a scene's state another value, and returns whether that changes the scene.
using Change = std::function<bool(Scene&)>;

/// A state, and how a renderer misreads it: `change` returns whether the scene is another by it.
struct MisreadState {
  const char *stage, *name, *says;
  Change change;
  /// Whether the stage is shade where fragments are lit, and no vertices.
  bool is_of_light_equation = false;
};

inline constexpr bool kOfLightEquation = true;

std::vector<MisreadState> states_of_geometry();  ///< stages matrices to depth
std::vector<MisreadState> states_of_textures();  ///< texture, shade
std::vector<MisreadState> states_of_merge();     ///< visibility, merge

template <class T>
bool reset(T& state, const T& to) {
  return std::exchange(state, to) != to;
}
template <class T>
bool reset(std::optional<T>& state) {
  return std::exchange(state, std::nullopt).has_value();
}

/// Changes each of the scene's `items`: its draws, for instance.
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

template <class T>
bool is_set(const std::optional<T>& state) {
  return state.has_value();
}
inline bool is_set(const PolygonOffset& offset) { return offset != PolygonOffset(); }
inline bool is_set(Cull cull) { return cull != Cull::none; }
inline bool is_set(DepthFunc func) { return func != DepthFunc::less; }
inline bool is_set(const DepthRange& range) { return range != DepthRange(); }
inline bool is_set(bool writes_depth) { return !writes_depth; }
inline bool is_set(const glm::bvec4& written) { return written != glm::bvec4(true); }

/// Member of a draw, or of its merge state.
template <auto member>
auto& member_of(Draw& draw) {
  if constexpr (requires { draw.*member; }) {
    return draw.*member;
  } else {
    return draw.merge.*member;
  }
}

/// Member that persists: a draw that does not set it has that of the draw before.
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

}  // namespace plumbline::cli
