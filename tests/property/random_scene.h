// Random scenes of triangles for property tests: all formats, state without textures, fog, polygon modes and
// antialiasing, and vertices where pipelines break: on planes of the view volume and on pixel centres, in line, far
// apart in size, at the eye and behind it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <rapidcheck.h>

#include "scene/scene.h"
#include "tests/property/random_state.h"

namespace plumbline::test {

/// Uniform in [least, most). (inRange alone stays near `least` in its first cases.)
template <class T>
rc::Gen<T> evenly(T least, T most) {
  return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(least, most));
}

/// A coordinate: of ten, six are multiples of 1/1024 and three multiples of 1/2 in [-4, 4]; one is of any size up to
/// 2^20.
inline rc::Gen<float> coordinate() {
  using namespace rc;
  return gen::weightedOneOf<float>(
      {{6, gen::map(evenly(-4096, 4097), [](int i) { return static_cast<float>(i) / 1024; })},
       {3, gen::map(evenly(-8, 9), [](int i) { return static_cast<float>(i) / 2; })},
       {1, gen::map(gen::pair(evenly(-1000, 1001), evenly(-30, 21)),
                    [](std::pair<int, int> p) { return std::ldexp(static_cast<float>(p.first) / 1000, p.second); })}});
}

/// A finite float of up to ten bits, of any size up to 1000 * 2^117.
inline rc::Gen<float> any_float() {
  return rc::gen::map(rc::gen::pair(evenly(-1000, 1001), evenly(-140, 118)),
                      [](std::pair<int, int> p) { return std::ldexp(static_cast<float>(p.first), p.second); });
}

inline rc::Gen<glm::vec3> point(const rc::Gen<float>& of) {
  return rc::gen::map(rc::gen::tuple(of, of, of),
                      [](const auto& t) { return glm::vec3(std::get<0>(t), std::get<1>(t), std::get<2>(t)); });
}

inline rc::Gen<glm::vec3> unit_vector() {
  return rc::gen::map(point(rc::gen::map(evenly(-4, 5), [](int i) { return static_cast<float>(i); })),
                      [](glm::vec3 v) { return v == glm::vec3(0) ? glm::vec3(0, 0, 1) : glm::normalize(v); });
}

inline rc::Gen<glm::vec4> color() {
  const auto channel = rc::gen::map(evenly(0, 256), [](int i) { return static_cast<float>(i) / 255; });
  return rc::gen::map(rc::gen::tuple(channel, channel, channel, channel), [](const auto& t) {
    return glm::vec4(std::get<0>(t), std::get<1>(t), std::get<2>(t), std::get<3>(t));
  });
}

/// 1 to `most` triangles, each of any three of the mesh's vertices (at least 3; repeats are allowed). Coordinates by
/// `of`; normals of unit length; colours in half of the meshes.
inline Mesh random_mesh(int most, const rc::Gen<float>& of) {
  using namespace rc;
  Mesh mesh;
  mesh.positions =
      *gen::suchThat(gen::container<std::vector<glm::vec3>>(point(of)), [](const auto& v) { return v.size() >= 3; });
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.normals = *gen::container<std::vector<glm::vec3>>(n, unit_vector());
  if (*gen::arbitrary<bool>()) mesh.colors = *gen::container<std::vector<glm::vec4>>(n, color());
  const int count = *evenly(1, most + 1);
  const auto corner = evenly<std::uint32_t>(0, n);
  for (int i = 0; i < count; ++i) mesh.triangles.push_back({*corner, *corner, *corner});
  return mesh;
}

template <class E>
E one_of(int count) {
  return static_cast<E>(*evenly(0, count));
}

/// Sets the scene's dialect, and one of the dialect's projections.
inline void speak(Scene& scene) {
  using namespace rc;
  scene.dialect = *gen::weightedElement<Dialect>(
      {{3, Dialect::gl}, {1, Dialect::gzrender}, {1, Dialect::games101}, {1, Dialect::tinyrenderer}});
  const double fov = *gen::elementOf(std::vector<int>{30, 60, 90, 150});
  const bool orthographic = *evenly(0, 3) == 0;
  switch (scene.dialect) {
    case Dialect::gl:
      scene.projection = orthographic ? Projection(Orthographic{-2, 2, -2, 2, 1, 8}) : Perspective{fov, 1, 8};
      break;
    case Dialect::games101:
      scene.projection = orthographic ? Projection(Orthographic{-2, 2, -2, 2, -1, -8}) : Perspective{fov, -1, -8};
      break;
    case Dialect::gzrender: scene.projection = ViewPlane{fov}; break;
    case Dialect::tinyrenderer:
      scene.projection = Pinhole{*gen::elementOf(std::vector<double>{0.5, 3, 4, 20})};
      scene.depth_clamp = true;
      break;
  }
}

/// Sets a point light's attenuation and, in half of the cases, its cone.
inline void reach(Light& light) {
  using namespace rc;
  light.attenuation = *gen::elementOf(std::vector<glm::vec3>{{1, 0, 0}, {2, 0, 0}, {0.5f, 0.25f, 0}, {0, 0, 1}});
  if (*gen::arbitrary<bool>()) return;
  light.spot = Spot{glm::dvec3(*unit_vector()), *gen::elementOf(std::vector<double>{0, 20.5, 45, 90}),
                    *gen::elementOf(std::vector<float>{0, 0.5f, 1, 7, 128})};
}

/// A scene of 1 to 3 draws; coordinates by `of`. To be called within a property.
inline Scene random_scene(const rc::Gen<float>& of = coordinate()) {
  using namespace rc;
  Scene scene;
  scene.name = "random";
  scene.frame.width = *evenly(1, 80);
  scene.frame.height = *evenly(1, 80);
  scene.frame.color = one_of<ColorFormat>(4);
  scene.frame.depth = one_of<DepthFormat>(4);
  scene.frame.clear_color = *color();
  scene.frame.clear_depth = *gen::weightedElement<double>({{6, 1.0}, {1, 0.0}, {1, 0.5}, {1, 0.7}});
  scene.camera.eye = glm::dvec3(*gen::elementOf(std::vector<glm::vec3>{{0, 0, 4}, {0, 0, 5}, {3, 1, 4}, {-2, 5, 1}}));
  speak(scene);
  scene.light_model.ambient = glm::vec3(0.125f);
  const int lights = *evenly(0, 3);
  for (int i = 0; i < lights; ++i) {
    Light light;
    light.kind = one_of<Light::Kind>(2);
    light.vector = glm::dvec3(*point(gen::map(evenly(-6, 7), [](int k) { return static_cast<float>(k) / 2; })));
    if (light.vector == glm::dvec3(0) && light.kind == Light::Kind::directional) light.vector.z = 1;
    light.specular = glm::vec3(0.5f);
    if (light.kind == Light::Kind::point) reach(light);
    scene.lights.push_back(light);
  }
  const bool with_state = *evenly(0, 2) == 0;
  if (with_state && *evenly(0, 2) == 0) {
    scene.frame.stencil = StencilFormat::s8;
    scene.frame.clear_stencil = static_cast<std::uint8_t>(*evenly(0, 4));
  }
  scene.light_model.local_viewer = *gen::arbitrary<bool>();
  scene.light_model.specular = one_of<LightModel::Specular>(2);
  scene.light_model.sides = *gen::weightedElement<LightModel::Sides>(
      {{3, LightModel::Sides::one}, {1, LightModel::Sides::two}, {1, LightModel::Sides::flip}});
  scene.light_model.separate_specular = *evenly(0, 4) == 0;
  const int draws = *evenly(1, 4);
  for (int i = 0; i < draws; ++i) {
    scene.meshes.push_back(random_mesh(8, of));
    Draw draw;
    draw.mesh = static_cast<std::uint32_t>(i);
    draw.material.diffuse = *color();
    draw.material.specular = *color();
    draw.material.shininess = static_cast<float>(*gen::elementOf(std::vector<int>{0, 1, 20, 128}));
    draw.lit = *gen::arbitrary<bool>();
    draw.color_material = one_of<ColorMaterial>(6);
    draw.normals = one_of<Normals>(3);
    if (*evenly(0, 3) == 0) draw.back_material = Material{*color(), *color(), *color(), {0, 0, 0, 1}, 20};
    draw.shading = one_of<Shading>(3);
    draw.cull = *gen::weightedElement<Cull>({{3, Cull::none}, {1, Cull::back}, {1, Cull::front}});
    draw.depth_func = *gen::weightedElement<DepthFunc>({{4, DepthFunc::less},
                                                        {1, DepthFunc::less_equal},
                                                        {1, DepthFunc::greater},
                                                        {1, DepthFunc::greater_equal},
                                                        {1, DepthFunc::equal},
                                                        {1, DepthFunc::not_equal},
                                                        {1, DepthFunc::always}});
    if (*evenly(0, 3) == 0) draw.transforms.push_back(Rotate{static_cast<double>(*evenly(-180, 181)), {1, 2, 3}});
    if (*evenly(0, 3) == 0)
      draw.transforms.push_back(
          Scale{glm::dvec3(*point(gen::map(evenly(1, 5), [](int k) { return static_cast<float>(k) / 2; })))});
    if (with_state) randomize_state(scene.frame, draw);
    scene.draws.push_back(draw);
  }
  return scene;
}

}  // namespace plumbline::test
