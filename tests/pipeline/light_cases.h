// One vertex under one light, and the colour that the OpenGL 2.1 specification, section 2.14.1, gives it, or note 000:
// worked out by hand in numbers that come out round. Eye space is the world.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace plumbline::test {

struct LightCase {
  std::string name;
  std::function<void(Light&, LightModel&, Draw&)> change;  ///< from a black material under a white light from +z
  glm::dvec3 p_eye, n_eye;
  double red;
  double alpha = 1;
};

/// A scene of the case, its one draw of `mesh` 0, which has the colour (1/2, 1/4, 1, 1/2) at each vertex.
inline Scene scene_of(const LightCase& of) {
  Scene scene;
  scene.name = "light/" + of.name;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.meshes.resize(1);
  scene.meshes[0].positions.assign(3, glm::vec3(of.p_eye));
  scene.meshes[0].normals.assign(3, glm::vec3(of.n_eye));
  scene.meshes[0].colors.assign(3, {0.5f, 0.25f, 1, 0.5f});
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.lights.resize(1);
  Draw draw;
  const glm::vec4 black(0, 0, 0, 1);
  draw.material = {black, black, black, black, 0};
  draw.normals = Normals::as_they_are;
  of.change(scene.lights[0], scene.light_model, draw);
  scene.draws = {draw};
  return scene;
}

inline std::vector<LightCase> light_cases() {
  using M = LightModel;
  constexpr auto diffuse = [](Draw& draw, float red) { draw.material.diffuse.r = red; };
  constexpr auto specular = [](Draw& draw, float red, float shininess) {
    draw.material.specular.r = red;
    draw.material.shininess = shininess;
  };
  constexpr auto place = [](Light& light, glm::dvec3 at) {
    light.kind = Light::Kind::point;
    light.vector = at;
  };
  // From (1.5, 0, -5) it is (-1.5, 0, 2), of length 2.5: cosine .8 to the cone's axis, and to the normal.
  constexpr auto cone = [](Light& light, double cutoff, float exponent) {
    light.kind = Light::Kind::point;
    light.vector = {0, 0, -3};
    light.ambient = glm::vec3(0.5f);
    light.spot = Spot{{0, 0, -7}, cutoff, exponent};
  };
  const glm::dvec3 below(0, 0, -5), aside(1.5, 0, -5), off_axis(3, 0, -4), up(0, 0, 1);
  return {
      {"attenuation: 1 / (1 + 2 d + d^2 / 4), d = 2",
       [=](Light& l, M&, Draw& d) {
         place(l, {0, 0, -3});
         l.attenuation = {1, 2, 0.25f};
         diffuse(d, 0.6f);
       },
       below, up, 0.1},
      {"attenuation of the ambient term, facing away",
       [=](Light& l, M&, Draw& d) {
         place(l, {0, 0, -3});
         l.attenuation = {0, 0, 1};
         l.ambient = glm::vec3(0.5f);
         d.material.ambient.r = 1;
         diffuse(d, 1);
       },
       below, -up, 0.125},
      {"a direction is not attenuated",
       [=](Light& l, M&, Draw& d) {
         l.attenuation = {4, 4, 4};
         diffuse(d, 0.5f);
       },
       below, up, 0.5},
      {"cone, within: .8 of N.L, .8^2 of the cone",
       [=](Light& l, M&, Draw& d) {
         cone(l, 37, 2);
         diffuse(d, 1);
       },
       aside, up, 0.512},
      {"cone, without: cos 36.8 = .8007",
       [=](Light& l, M&, Draw& d) {
         cone(l, 36.8, 2);
         d.material.ambient.r = 1;
         diffuse(d, 1);
       },
       aside, up, 0},
      {"cone of exponent 0: 1 within",
       [=](Light& l, M&, Draw& d) {
         cone(l, 37, 0);
         diffuse(d, 1);
       },
       aside, up, 0.8},
      {"cone of 90 degrees, from behind it",
       [=](Light& l, M&, Draw& d) {
         cone(l, 90, 0);
         l.spot->direction = {0, 0, 1};
         diffuse(d, 1);
       },
       aside, up, 0},
      {"the cone dims the ambient term",
       [=](Light& l, M&, Draw& d) {
         cone(l, 90, 1);
         d.material.ambient.r = 0.5f;
       },
       aside, up, 0.2},
      {"local viewer: H of (0,0,1) and (-.6,0,.8) is (-1,0,3) / sqrt 10",
       [=](Light&, M& m, Draw& d) {
         m.local_viewer = true;
         specular(d, 1, 2);
       },
       off_axis, up, 0.9},
      {"the same from far away", [=](Light&, M&, Draw& d) { specular(d, 0.75f, 2); }, off_axis, up, 0.75},
      {"R of (.6,0,.8) at (0,0,1) is (-.6,0,.8): R.E = .8, squared",
       [=](Light& l, M& m, Draw& d) {
         l.vector = {0.6, 0, 0.8};
         m.specular = M::Specular::reflection;
         specular(d, 0.5f, 2);
       },
       below, up, 0.32},
      {"R with the eye where it is: R = E",
       [=](Light& l, M& m, Draw& d) {
         l.vector = {0.6, 0, 0.8};
         m = {glm::vec3(0), true, M::Specular::reflection, M::Sides::one};
         specular(d, 0.5f, 100);
       },
       off_axis, up, 0.5},
      {"R.E = -.8 has no highlight",
       [=](Light& l, M& m, Draw& d) {
         l.vector = {0.6, 0, 0.8};
         m.specular = M::Specular::reflection;
         specular(d, 1, 2);
       },
       below,
       {1, 0, 0},
       0},
      {"R.E > 0, but the light is behind",
       [=](Light& l, M& m, Draw& d) {
         l.vector = {0, 0, -1};
         m.specular = M::Specular::reflection;
         specular(d, 1, 2);
       },
       below,
       {0.6, 0, 0.8},
       0},
      {"flip: N.L = N.E = -1",
       [=](Light&, M& m, Draw& d) {
         m.sides = M::Sides::flip;
         diffuse(d, 0.5f);
       },
       below, -up, 0.5},
      {"flip: N.L = 1, N.E = -1 does not count, but for ambient light",
       [=](Light& l, M& m, Draw& d) {
         l.vector = {0, 0, -1};
         l.ambient = glm::vec3(1);
         m.sides = M::Sides::flip;
         d.material.ambient.r = 0.25f;
         diffuse(d, 0.5f);
       },
       below, -up, 0.25},
      {"flip: N.L = -1, N.E = 1 does not count",
       [=](Light& l, M& m, Draw& d) {
         l.vector = {0, 0, -1};
         m.sides = M::Sides::flip;
         diffuse(d, 0.5f);
       },
       below, up, 0},
      {"one side: what the eye does not see is lit",
       [=](Light& l, M&, Draw& d) {
         l.vector = {0, 0, -1};
         diffuse(d, 0.5f);
       },
       below, -up, 0.5},
      {"flip by a local viewer: N.E = N.L = -.6",
       [=](Light& l, M& m, Draw& d) {
         l.vector = {-0.6, 0, 0.8};
         m = {glm::vec3(0), true, M::Specular::half_vector, M::Sides::flip};
         diffuse(d, 1);
       },
       off_axis,
       {1, 0, 0},
       0.6},
      {"a normal of length 2: N.L = 2, (N.H)^2 = 4",
       [=](Light&, M&, Draw& d) {
         diffuse(d, 0.25f);
         specular(d, 0.0625f, 2);
       },
       below,
       {0, 0, 2},
       0.75},
      {"a normal of length 2, (N.H)^128: more than a float holds",
       [=](Light&, M&, Draw& d) { specular(d, 0.5f, 128); },
       below,
       {0, 0, 2},
       1},
      {"colour for diffuse, its alpha too", [=](Light&, M&, Draw& d) { d.color_material = ColorMaterial::diffuse; },
       below, up, 0.5, 0.5},
      {"colour for ambient",
       [=](Light& l, M&, Draw& d) {
         l.ambient = glm::vec3(0.5f);
         diffuse(d, 0.125f);
         d.color_material = ColorMaterial::ambient;
       },
       below, up, 0.375},
      {"colour for ambient and diffuse",
       [=](Light& l, M&, Draw& d) {
         l.ambient = glm::vec3(0.5f);
         d.color_material = ColorMaterial::ambient_and_diffuse;
       },
       below, up, 0.75, 0.5},
      {"colour for specular",
       [=](Light&, M&, Draw& d) {
         diffuse(d, 0.125f);
         d.color_material = ColorMaterial::specular;
       },
       below, up, 0.625},
      {"colour for emission",
       [=](Light&, M&, Draw& d) {
         diffuse(d, 0.125f);
         d.color_material = ColorMaterial::emission;
       },
       below, up, 0.625},
  };
}

}  // namespace plumbline::test
