#include "reference/osmesa/scene/light_state.h"

#include <glm/gtc/type_ptr.hpp>

#include "reference/arithmetic/matrices.h"

namespace plumbline::osmesa {
namespace {

// A light's position or direction in world space, homogeneous. A direction is normalised, so that rounding to float
// does not depend on its length.
glm::dvec4 place(const Light& light) {
  if (light.kind == Light::Kind::point) return glm::dvec4(light.vector, 1);
  const double length = glm::length(light.vector);
  return glm::dvec4(length > 0 ? light.vector / length : light.vector, 0);
}

void set_reach(const Gl& gl, GLenum name, const Light& light, const glm::dmat4& view) {
  constexpr float kAllSides = 180;
  gl.Lightf(name, GL_CONSTANT_ATTENUATION, light.attenuation[0]);
  gl.Lightf(name, GL_LINEAR_ATTENUATION, light.attenuation[1]);
  gl.Lightf(name, GL_QUADRATIC_ATTENUATION, light.attenuation[2]);
  if (!light.spot) return gl.Lightf(name, GL_SPOT_CUTOFF, kAllSides);
  gl.Lightfv(name, GL_SPOT_DIRECTION,
             glm::value_ptr(glm::vec3(glm::dmat3(view) * glm::normalize(light.spot->direction))));
  gl.Lightf(name, GL_SPOT_CUTOFF, static_cast<float>(light.spot->cutoff_degrees));
  gl.Lightf(name, GL_SPOT_EXPONENT, light.spot->exponent);
}

GLenum gl_color_material(ColorMaterial follows) {
  switch (follows) {
    case ColorMaterial::none: break;
    case ColorMaterial::ambient: return GL_AMBIENT;
    case ColorMaterial::diffuse: return GL_DIFFUSE;
    case ColorMaterial::ambient_and_diffuse: return GL_AMBIENT_AND_DIFFUSE;
    case ColorMaterial::specular: return GL_SPECULAR;
    case ColorMaterial::emission: return GL_EMISSION;
  }
  return GL_NONE;
}

void set_face(const Gl& gl, GLenum face, const Material& m) {
  gl.Materialfv(face, GL_AMBIENT, glm::value_ptr(m.ambient));
  gl.Materialfv(face, GL_DIFFUSE, glm::value_ptr(m.diffuse));
  gl.Materialfv(face, GL_SPECULAR, glm::value_ptr(m.specular));
  gl.Materialfv(face, GL_EMISSION, glm::value_ptr(m.emission));
  gl.Materialf(face, GL_SHININESS, m.shininess);
}

void set_normals(const Gl& gl, Normals normals) {
  gl.Disable(GL_NORMALIZE);
  gl.Disable(GL_RESCALE_NORMAL);
  if (normals == Normals::normalize) gl.Enable(GL_NORMALIZE);
  if (normals == Normals::rescale) gl.Enable(GL_RESCALE_NORMAL);
}

}  // namespace

void set_lights(const Gl& gl, const Scene& scene) {
  const LightModel& model = scene.light_model;
  gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, glm::value_ptr(glm::vec4(model.ambient, 1)));
  gl.LightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, model.local_viewer ? GL_TRUE : GL_FALSE);
  gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, model.sides == LightModel::Sides::two ? GL_TRUE : GL_FALSE);
  gl.LightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, model.separate_specular ? GL_SEPARATE_SPECULAR_COLOR : GL_SINGLE_COLOR);
  // GL multiplies a light's position by the current model-view matrix; positions are passed in eye space.
  gl.MatrixMode(GL_MODELVIEW);
  gl.LoadIdentity();
  const glm::dmat4 view = math::view_matrix(scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const auto name = static_cast<GLenum>(GL_LIGHT0 + i);
    gl.Lightfv(name, GL_POSITION, glm::value_ptr(glm::vec4(view * place(light))));
    gl.Lightfv(name, GL_AMBIENT, glm::value_ptr(glm::vec4(light.ambient, 1)));
    gl.Lightfv(name, GL_DIFFUSE, glm::value_ptr(glm::vec4(light.diffuse, 1)));
    gl.Lightfv(name, GL_SPECULAR, glm::value_ptr(glm::vec4(light.specular, 1)));
    set_reach(gl, name, light, view);
    gl.Enable(name);
  }
}

void set_material(const Gl& gl, const Scene& scene, const Draw& draw) {
  gl.Disable(GL_COLOR_MATERIAL);  // else the material keeps the last vertex colour
  set_face(gl, GL_FRONT, draw.material);
  set_face(gl, GL_BACK, draw.back_material.value_or(draw.material));
  set_normals(gl, draw.normals);
  if (draw.color_material == ColorMaterial::none || scene.meshes[draw.mesh].colors.empty()) return;
  gl.ColorMaterial(GL_FRONT_AND_BACK, gl_color_material(draw.color_material));
  gl.Enable(GL_COLOR_MATERIAL);
}

}  // namespace plumbline::osmesa
