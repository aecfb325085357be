#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "dialect/dialect.h"
#include "faults/lists.h"
#include "faults/variants.h"
#include "kernels/math.h"
#include "kernels/shade.h"
#include "pipeline/geometry.h"

namespace plumbline::faults {

namespace {

using pipeline::LightInput;
using LitVertices = std::vector<pipeline::Attributes>;

// Stage light of the scene that `change` altered, and of its lights.
template <auto change>
void lit_otherwise(const LightInput& in, LitVertices& out) {
  Scene wrong = in.scene;
  Draw wrong_draw = in.draw;
  change(wrong, wrong_draw);
  pipeline::light({wrong, wrong_draw, in.mesh, pipeline::light_sources(wrong), in.vertices}, out);
}

constexpr auto kNoAttenuation = [](Scene& scene, Draw&) {
  for (Light& light : scene.lights) light.attenuation = {1, 0, 0};
};

// Cutoff whose cosine is cos() of the number of degrees; where that is negative, the cone is more than a half space.
constexpr auto kSpotDegreesForRadians = [](Scene& scene, Draw&) {
  for (Light& light : scene.lights) {
    if (light.spot) light.spot->cutoff_degrees = glm::degrees(std::acos(std::cos(light.spot->cutoff_degrees)));
  }
};

constexpr auto kHalfTheCone = [](Scene& scene, Draw&) {
  for (Light& light : scene.lights) {
    if (light.spot) light.spot->cutoff_degrees /= 2;
  }
};

// Each light with a cone gets a twin that shines the other way, up to 8 lights in all.
constexpr auto kConesBothWays = [](Scene& scene, Draw&) {
  const std::vector<Light> lights = scene.lights;
  for (Light light : lights) {
    if (!light.spot || scene.lights.size() == 8) continue;
    light.spot->direction = -light.spot->direction;
    scene.lights.push_back(light);
  }
};

constexpr auto kConesIgnored = [](Scene& scene, Draw&) {
  for (Light& light : scene.lights) light.spot.reset();
};

constexpr auto kReflection = [](Scene& scene, Draw&) { scene.light_model.specular = LightModel::Specular::reflection; };

constexpr auto kFarViewer = [](Scene& scene, Draw&) { scene.light_model.local_viewer = false; };

constexpr auto kNoColorMaterial = [](Scene&, Draw& draw) { draw.color_material = ColorMaterial::none; };

// The scene's ambient light once more for each light.
constexpr auto kAmbientPerLight = [](Scene& scene, Draw&) {
  scene.light_model.ambient *= 1.0f + static_cast<float>(scene.lights.size());
};

// Light in world space: the camera is at the origin and looks down -z.
constexpr auto kWorldSpace = [](Scene& scene, Draw&) {
  scene.dialect = Dialect::gl;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
};

void back_color_is_the_fronts(const LightInput& in, LitVertices& out) {
  const std::size_t first = out.size();
  pipeline::light(in, out);
  if (!carries(in.scene, in.draw, Varying::back_color)) return;
  for (std::size_t i = first; i < out.size(); ++i) out[i][Varying::back_color] = out[i].color();
}

// |z_eye| at the vertices, before clipping: on a primitive that reaches behind the eye, the interpolated distance grows
// towards the vertices.
void positions_by_distance(const LightInput& in, LitVertices& out) {
  const std::size_t first = out.size();
  pipeline::light(in, out);
  for (std::size_t i = first; i < out.size(); ++i) {
    float& z_eye = out[i][Varying::position].z;
    z_eye = std::abs(z_eye);
  }
}

// Light per fragment of the scene that `change` altered. (by_color, read from the mesh, is put back.)
template <auto change>
pipeline::Shaded shaded_in_other_light(const pipeline::Surface& surface, bool front,
                                       const pipeline::SurfaceAttributes<float>& a) {
  if (!surface.light) return {pipeline::shade<float>(surface, front, a)};
  const Scene& scene = *surface.scene;
  Scene wrong;
  wrong.dialect = scene.dialect;
  wrong.camera = scene.camera;
  wrong.projection = scene.projection;
  wrong.light_model = scene.light_model;
  wrong.lights = scene.lights;
  wrong.meshes.resize(1);
  Draw draw = *surface.draw;
  draw.mesh = 0;
  change(wrong, draw);
  pipeline::Surface other = surface;
  other.light = pipeline::fragment_light(wrong, draw, pipeline::light_sources(wrong));
  other.light->by_color = surface.light->by_color;
  return {pipeline::shade<float>(other, front, a)};
}

// Shading without the colour sum.
pipeline::Shaded no_color_sum(const pipeline::Surface& surface, bool front,
                              const pipeline::SurfaceAttributes<float>& a) {
  pipeline::SurfaceAttributes<float> primary = a;
  primary[Varying::secondary] = {float(0), float(0), float(0), float(0)};
  return {pipeline::shade<float>(surface, front, primary)};
}

// Light by the unnormalised interpolated normal. Surfaces with fog, two-sided light, a separate specular colour or
// colour material stay right.
pipeline::Shaded unnormalised_normals(const pipeline::Surface& surface, bool front,
                                      const pipeline::SurfaceAttributes<float>& a) {
  const LightModel& model = surface.scene->light_model;
  const bool simple = model.sides != LightModel::Sides::two && !model.separate_specular && !surface.draw->fog;
  if (!surface.light || surface.light->by_color || !simple) {
    return {pipeline::shade<float>(surface, front, a)};
  }
  const Color<float>&n = a[Varying::normal], &p = a[Varying::position];
  return {pipeline::lit<float>(surface.light->illumination, surface.light->reflectance[0][0], {p.r, p.g, p.b},
                               {n.r, n.g, n.b})};
}

template <auto change>
constexpr Fault of(std::string_view name, std::string_view what, std::string_view report = {}) {
  return stage_fault(name, what, put<&Stages::light, lit_otherwise<change>>, report);
}

template <auto change>
constexpr Fault per_fragment(std::string_view name, std::string_view what) {
  return stage_fault(name, what, put<&Stages::shade, shaded_in_other_light<change>>);
}

constexpr std::array kFaults = {
    of<kWorldSpace>("light.world_space", "lights are not brought to eye space"),
    of<kNoAttenuation>("light.no_attenuation", "lights do not fade with their distance"),
    of<kSpotDegreesForRadians>("light.cutoff_in_degrees", "a cone's angle in degrees is taken for radians"),
    of<kConesIgnored>("light.cones_ignored", "spot lights shine to all sides"),
    of<kHalfTheCone>("light.half_the_cone", "a cone's angle from its axis is taken for that from side to side",
                     "KhronosGroup/glTF#824"),
    of<kConesBothWays>("light.cones_both_ways", "spot lights shine backwards too", "mrdoob/three.js#3291"),
    of<kReflection>("light.reflection_for_half_vector", "highlights are by the mirrored ray, not the half vector"),
    of<kFarViewer>("light.far_viewer", "highlights are seen from infinitely far away, not from the eye"),
    of<kNoColorMaterial>("light.no_color_material", "vertex colours do not stand for the material"),
    of<kAmbientPerLight>("light.ambient_per_light", "the ambient light is added once more for each light"),
    stage_fault("light.back_color_of_front", "back faces are lit by their front's normal and material",
                put<&Stages::light, back_color_is_the_fronts>),
    stage_fault("light.distance_at_vertices", "the distance for fog is taken at the vertices and interpolated",
                put<&Stages::light, positions_by_distance>),
    per_fragment<kWorldSpace>("shade.world_space", "light per fragment: lights are not brought to eye space"),
    per_fragment<kNoAttenuation>("shade.no_attenuation", "light per fragment: lights do not fade with their distance"),
    per_fragment<kSpotDegreesForRadians>("shade.cutoff_in_degrees",
                                         "light per fragment: a cone's angle in degrees is taken for radians"),
    per_fragment<kConesIgnored>("shade.cones_ignored", "light per fragment: spot lights shine to all sides"),
    per_fragment<kHalfTheCone>("shade.half_the_cone",
                               "light per fragment: a cone's angle from its axis is taken for that from side to side"),
    per_fragment<kConesBothWays>("shade.cones_both_ways", "light per fragment: spot lights shine backwards too"),
    per_fragment<kReflection>("shade.reflection_for_half_vector",
                              "light per fragment: highlights are by the mirrored ray, not the half vector"),
    per_fragment<kFarViewer>("shade.far_viewer",
                             "light per fragment: highlights are seen from infinitely far away, not from the eye"),
    per_fragment<kAmbientPerLight>("shade.ambient_per_light",
                                   "light per fragment: the ambient light is added once more for each light"),
    stage_fault("shade.no_color_sum", "the separate specular colour is not added", put<&Stages::shade, no_color_sum>),
    stage_fault("shade.not_renormalised", "interpolated normals are not brought back to unit length",
                put<&Stages::shade, unnormalised_normals>),
};

}  // namespace

std::span<const Fault> of_light() { return kFaults; }

}  // namespace plumbline::faults
