#include "reference/osmesa/scene/default_state.h"

#include <initializer_list>

namespace plumbline::osmesa {
namespace {

struct Switch {
  GLenum name;
  bool on;
};
constexpr Switch kSwitches[] = {{GL_ALPHA_TEST, false},
                                {GL_BLEND, false},
                                {GL_COLOR_LOGIC_OP, false},
                                {GL_COLOR_MATERIAL, false},
                                {GL_COLOR_SUM, false},
                                {GL_CULL_FACE, false},
                                {GL_DEPTH_CLAMP, false},
                                {GL_DEPTH_TEST, false},
                                {GL_DITHER, true},
                                {GL_FOG, false},
                                {GL_LIGHTING, false},
                                {GL_NORMALIZE, false},
                                {GL_POLYGON_OFFSET_FILL, false},
                                {GL_RASTERIZER_DISCARD, false},
                                {GL_RESCALE_NORMAL, false},
                                {GL_SCISSOR_TEST, false},
                                {GL_STENCIL_TEST, false},
                                {GL_VERTEX_PROGRAM_TWO_SIDE, false}};
constexpr GLenum kArrays[] = {GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_TEXTURE_COORD_ARRAY,
                              GL_EDGE_FLAG_ARRAY};

constexpr GLfloat kBlack[] = {0, 0, 0, 1}, kWhite[] = {1, 1, 1, 1}, kNone[] = {0, 0, 0, 0};

void set_arrays(const Gl& gl) {
  for (const GLenum array : kArrays) gl.DisableClientState(array);
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
  gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

void set_transformation(const Gl& gl) {
  for (const GLenum mode : std::initializer_list<GLenum>{GL_PROJECTION, GL_MODELVIEW}) {
    gl.MatrixMode(mode);
    gl.LoadIdentity();
  }
  gl.DepthRange(0, 1);
}

void set_light(const Gl& gl, GLenum light) {
  constexpr GLfloat kPlace[] = {0, 0, 1, 0}, kSpotDirection[] = {0, 0, -1};
  const GLfloat* color = light == GL_LIGHT0 ? kWhite : kBlack;
  gl.Disable(light);
  gl.Lightfv(light, GL_AMBIENT, kBlack);
  gl.Lightfv(light, GL_DIFFUSE, color);
  gl.Lightfv(light, GL_SPECULAR, color);
  gl.Lightfv(light, GL_POSITION, kPlace);
  gl.Lightfv(light, GL_SPOT_DIRECTION, kSpotDirection);
  gl.Lightf(light, GL_SPOT_EXPONENT, 0);
  gl.Lightf(light, GL_SPOT_CUTOFF, 180);
  gl.Lightf(light, GL_CONSTANT_ATTENUATION, 1);
  gl.Lightf(light, GL_LINEAR_ATTENUATION, 0);
  gl.Lightf(light, GL_QUADRATIC_ATTENUATION, 0);
}

/// The model-view matrix must be the identity: GL transforms a light's place as it is set.
void set_lighting(const Gl& gl) {
  constexpr GLfloat kAmbient[] = {0.2f, 0.2f, 0.2f, 1}, kDiffuse[] = {0.8f, 0.8f, 0.8f, 1};
  constexpr GLenum kLights = 8;  // most lights of a scene, and fewest of an OpenGL
  for (GLenum i = 0; i < kLights; ++i) set_light(gl, GL_LIGHT0 + i);
  gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, kAmbient);
  gl.LightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, GL_FALSE);
  gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_FALSE);
  gl.LightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SINGLE_COLOR);
  gl.ColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
  gl.Materialfv(GL_FRONT_AND_BACK, GL_AMBIENT, kAmbient);
  gl.Materialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, kDiffuse);
  gl.Materialfv(GL_FRONT_AND_BACK, GL_SPECULAR, kBlack);
  gl.Materialfv(GL_FRONT_AND_BACK, GL_EMISSION, kBlack);
  gl.Materialf(GL_FRONT_AND_BACK, GL_SHININESS, 0);
  gl.ShadeModel(GL_SMOOTH);
  gl.Color4f(1, 1, 1, 1);
}

void set_fog(const Gl& gl) {
  gl.Fogi(GL_FOG_MODE, GL_EXP);
  gl.Fogfv(GL_FOG_COLOR, kNone);
  gl.Fogf(GL_FOG_DENSITY, 1);
  gl.Fogf(GL_FOG_START, 0);
  gl.Fogf(GL_FOG_END, 1);
}

void set_texture_unit(const Gl& gl, GLenum unit) {
  constexpr struct {
    GLenum name;
    GLint value;
  } kEnvironment[] = {{GL_TEXTURE_ENV_MODE, GL_MODULATE}, {GL_COMBINE_RGB, GL_MODULATE},
                      {GL_SOURCE0_RGB, GL_TEXTURE},       {GL_OPERAND0_RGB, GL_SRC_COLOR},
                      {GL_COMBINE_ALPHA, GL_MODULATE},    {GL_SOURCE0_ALPHA, GL_TEXTURE},
                      {GL_OPERAND0_ALPHA, GL_SRC_ALPHA}};
  gl.ActiveTexture(unit);
  gl.Disable(GL_TEXTURE_2D);
  gl.BindTexture(GL_TEXTURE_2D, 0);
  gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
  for (const auto& [name, value] : kEnvironment) gl.TexEnvi(GL_TEXTURE_ENV, name, value);
  gl.TexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, kNone);
}

void set_rasterization(const Gl& gl) {
  gl.RenderMode(GL_RENDER);
  gl.CullFace(GL_BACK);
  gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  gl.PolygonOffset(0, 0);
  gl.LineWidth(1);
  gl.PointSize(1);
}

void set_fragment_operations(const Gl& gl) {
  gl.Scissor(0, 0, 0, 0);  // GL's initial value is the window's size; there is no window here
  gl.AlphaFunc(GL_ALWAYS, 0);
  gl.StencilFuncSeparate(GL_FRONT_AND_BACK, GL_ALWAYS, 0, ~0u);
  gl.StencilOpSeparate(GL_FRONT_AND_BACK, GL_KEEP, GL_KEEP, GL_KEEP);
  gl.StencilMaskSeparate(GL_FRONT_AND_BACK, ~0u);
  gl.DepthFunc(GL_LESS);
  gl.DepthMask(GL_TRUE);
  gl.BlendFuncSeparate(GL_ONE, GL_ZERO, GL_ONE, GL_ZERO);
  gl.BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
  gl.BlendColor(0, 0, 0, 0);
  gl.LogicOp(GL_COPY);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.ClampColor(GL_CLAMP_VERTEX_COLOR, GL_TRUE);
  gl.ClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FIXED_ONLY);
}

void set_pixels(const Gl& gl) {
  gl.ClearColor(0, 0, 0, 0);
  gl.ClearDepth(1);
  gl.ClearStencil(0);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
}

}  // namespace

void set_default_state(const Gl& gl) {
  gl.UseProgram(0);
  for (const Switch& s : kSwitches) s.on ? gl.Enable(s.name) : gl.Disable(s.name);
  set_arrays(gl);
  set_transformation(gl);
  set_lighting(gl);
  set_fog(gl);
  for (const GLenum unit : std::initializer_list<GLenum>{GL_TEXTURE1, GL_TEXTURE0}) set_texture_unit(gl, unit);
  set_rasterization(gl);
  set_fragment_operations(gl);
  set_pixels(gl);
  check(gl, "setting the default state");
}

}  // namespace plumbline::osmesa
