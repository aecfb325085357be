/* OpenGL's fixed function as plumb runs it: by plumbline's kit, on whatever OSMesa draws with (GALLIUM_DRIVER=softpipe).
   All stages are OpenGL's own: of the export's arrays it takes those of the meshes, the matrices and the textures. */
#include <GL/osmesa.h>
#include <GL/glext.h>

#include "kit/plumbline.h"

static const GLenum compares[] = {GL_NEVER, GL_LESS, GL_EQUAL, GL_LEQUAL, GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
static const char *const compare_words = "never|less|equal|less_equal|greater|not_equal|greater_equal|always";

static void floats_at(const PlScene *s, float out[4], int count, const char *path) {
  double numbers[4] = {0, 0, 0, 1};
  int c;
  pl_numbers(s, numbers, count, "%s", path);
  for (c = 0; c < 4; ++c) out[c] = (float)numbers[c];
}

/* "draws.3.fog.color": valid until the next call. */
static const char *at(const char *group, int i, const char *rest) {
  static char path[PL_PATH];
  snprintf(path, sizeof path, "%s.%d.%s", group, i, rest);
  return path;
}

static void enable(GLenum what, int wanted) { wanted ? glEnable(what) : glDisable(what); }

static void set_lights(const PlScene *s) {
  float v[4];
  int i;
  glMatrixMode(GL_MODELVIEW), glLoadIdentity(); /* lights are in eye space */
  floats_at(s, v, 3, "light_model.ambient"), glLightModelfv(GL_LIGHT_MODEL_AMBIENT, v);
  glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, (int)pl_number(s, "light_model.local_viewer"));
  glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, pl_choice(s, "one|two", "light_model.sides"));
  glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL,
                pl_number(s, "light_model.separate_specular") != 0 ? GL_SEPARATE_SPECULAR_COLOR : GL_SINGLE_COLOR);
  for (i = 0; i < 8; ++i) enable(GL_LIGHT0 + i, i < (int)pl_number(s, "lights"));
  for (i = 0; i < (int)pl_number(s, "lights"); ++i) {
    const GLenum light = GL_LIGHT0 + i;
    const int spot = pl_has(s, "lights.%d.spot", i);
    pl_choice(s, "half_vector", "light_model.specular");
    floats_at(s, v, 4, at("lights", i, "p_eye")), glLightfv(light, GL_POSITION, v);
    floats_at(s, v, 3, at("lights", i, "ambient")), glLightfv(light, GL_AMBIENT, v);
    floats_at(s, v, 3, at("lights", i, "diffuse")), glLightfv(light, GL_DIFFUSE, v);
    floats_at(s, v, 3, at("lights", i, "specular")), glLightfv(light, GL_SPECULAR, v);
    floats_at(s, v, 3, at("lights", i, "attenuation"));
    glLightf(light, GL_CONSTANT_ATTENUATION, v[0]);
    glLightf(light, GL_LINEAR_ATTENUATION, v[1]), glLightf(light, GL_QUADRATIC_ATTENUATION, v[2]);
    glLightf(light, GL_SPOT_CUTOFF, spot ? (float)pl_number(s, "lights.%d.spot.cutoff", i) : 180);
    glLightf(light, GL_SPOT_EXPONENT, spot ? (float)pl_number(s, "lights.%d.spot.exponent", i) : 0);
    if (spot) floats_at(s, v, 3, at("lights", i, "spot.spot_eye")), glLightfv(light, GL_SPOT_DIRECTION, v);
  }
}

static void set_material(const PlScene *s, int i, GLenum face, const char *which) {
  static const char *const names[] = {"ambient", "diffuse", "specular", "emission"};
  static const GLenum terms[] = {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION};
  char path[PL_PATH];
  float v[4];
  int k;
  for (k = 0; k < 4; ++k) {
    snprintf(path, sizeof path, "draws.%d.%s.%s", i, which, names[k]);
    floats_at(s, v, 4, path), glMaterialfv(face, terms[k], v);
  }
  glMaterialf(face, GL_SHININESS, (float)pl_number(s, "draws.%d.%s.shininess", i, which));
}

static void set_texture(const PlScene *s, int k) {
  static const GLenum of_8_bits[] = {GL_ALPHA8, GL_LUMINANCE8, GL_LUMINANCE8_ALPHA8, GL_INTENSITY8, GL_RGB8, GL_RGBA8};
  static const GLenum of_floats[] = {GL_ALPHA32F_ARB,     GL_LUMINANCE32F_ARB, GL_LUMINANCE_ALPHA32F_ARB,
                                     GL_INTENSITY32F_ARB, GL_RGB32F,           GL_RGBA32F};
  static const GLint mins[] = {GL_NEAREST, GL_LINEAR, GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_NEAREST,
                               GL_NEAREST_MIPMAP_LINEAR, GL_LINEAR_MIPMAP_LINEAR};
  static const GLint wraps[] = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER};
  static const char *const wrap_words = "repeat|mirrored_repeat|clamp_to_edge|clamp_to_border";
  const int format = pl_choice(s, "alpha|luminance|luminance_alpha|intensity|rgb|rgba", "textures.%d.format", k);
  const GLenum in = (pl_is(s, "float32", "textures.%d.texels", k) ? of_floats : of_8_bits)[format];
  float border[4];
  int level;
  glBindTexture(GL_TEXTURE_2D, (GLuint)k + 1);
  floats_at(s, border, 4, at("textures", k, "border"));
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                  mins[pl_choice(s, "nearest|linear|nearest_mipmap_nearest|linear_mipmap_nearest|nearest_mipmap_linear|"
                                    "linear_mipmap_linear", "textures.%d.min", k)]);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, mins[pl_choice(s, "nearest|linear", "textures.%d.mag", k)]);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wraps[pl_choice(s, wrap_words, "textures.%d.wrap_s", k)]);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wraps[pl_choice(s, wrap_words, "textures.%d.wrap_t", k)]);
  glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, (float)pl_number(s, "textures.%d.lod_bias", k));
  glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MIN_LOD, (float)pl_number(s, "textures.%d.min_lod", k));
  glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_LOD, (float)pl_number(s, "textures.%d.max_lod", k));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, (int)pl_number(s, "textures.%d.base_level", k));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, (int)pl_number(s, "textures.%d.max_level", k));
  for (level = 0; level < (int)pl_number(s, "textures.%d.levels", k); ++level) {
    glTexImage2D(GL_TEXTURE_2D, level, (GLint)in, (int)pl_number(s, "textures.%d.levels.%d.0", k, level),
                 (int)pl_number(s, "textures.%d.levels.%d.1", k, level), 0, GL_RGBA, GL_FLOAT,
                 pl_floats(s, NULL, "textures.%d.%d", k, level));
  }
}

static void set_surface(const PlScene *s, int i) {
  static const GLint environments[] = {GL_REPLACE, GL_MODULATE, GL_DECAL, GL_BLEND, GL_ADD};
  static const GLint fogs[] = {GL_LINEAR, GL_EXP, GL_EXP2};
  static const GLenum terms[] = {0, GL_AMBIENT, GL_DIFFUSE, GL_AMBIENT_AND_DIFFUSE, GL_SPECULAR, GL_EMISSION};
  const int term = pl_choice(s, "none|ambient|diffuse|ambient_and_diffuse|specular|emission", "draws.%d.color_material", i);
  const int lit = pl_number(s, "draws.%d.lit", i) != 0, normals = pl_choice(s, "normalize|rescale|as_they_are", "draws.%d.normals", i);
  const int colored = pl_floats(s, NULL, "meshes.%d.colors", (int)pl_number(s, "draws.%d.mesh", i)) != NULL;
  const int textured = pl_has(s, "draws.%d.texture", i), fog = pl_has(s, "draws.%d.fog", i);
  float v[4];
  enable(GL_LIGHTING, lit), enable(GL_NORMALIZE, normals == 0), enable(GL_RESCALE_NORMAL, normals == 1);
  glShadeModel(pl_is(s, "flat", "draws.%d.shading", i) ? GL_FLAT : GL_SMOOTH);
  if (lit) pl_choice(s, "flat|gouraud", "draws.%d.shading", i);
  glDisable(GL_COLOR_MATERIAL);
  set_material(s, i, GL_FRONT_AND_BACK, "material");
  if (pl_has(s, "draws.%d.back_material", i)) set_material(s, i, GL_BACK, "back_material");
  if (lit && colored && term != 0) glColorMaterial(GL_FRONT_AND_BACK, terms[term]), glEnable(GL_COLOR_MATERIAL);
  enable(GL_TEXTURE_2D, textured);
  if (textured) {
    const int environment = pl_choice(s, "replace|modulate|decal|blend|add", "draws.%d.texture.environment", i);
    glBindTexture(GL_TEXTURE_2D, (GLuint)pl_number(s, "draws.%d.texture.texture", i) + 1);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, environments[environment]);
    floats_at(s, v, 4, at("draws", i, "texture.color")), glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, v);
  }
  enable(GL_FOG, fog);
  if (fog) {
    glFogi(GL_FOG_MODE, fogs[pl_choice(s, "linear|exp|exp2", "draws.%d.fog.mode", i)]);
    floats_at(s, v, 3, at("draws", i, "fog.color")), glFogfv(GL_FOG_COLOR, v);
    glFogf(GL_FOG_DENSITY, (float)pl_number(s, "draws.%d.fog.density", i));
    glFogf(GL_FOG_START, (float)pl_number(s, "draws.%d.fog.start", i));
    glFogf(GL_FOG_END, (float)pl_number(s, "draws.%d.fog.end", i));
  }
}

static void set_raster(const PlScene *s, int i, int width, int height) {
  static const GLenum modes[] = {GL_FILL, GL_LINE, GL_POINT}, culls[] = {0, GL_BACK, GL_FRONT};
  const int cull = pl_choice(s, "none|back|front", "draws.%d.cull", i);
  double box[4] = {0, 0, 0, 0};
  box[2] = width, box[3] = height;
  if (pl_has(s, "draws.%d.scissor", i)) pl_numbers(s, box, 4, "draws.%d.scissor", i);
  glEnable(GL_SCISSOR_TEST), glScissor((int)box[0], (int)box[1], (int)box[2], (int)box[3]);
  enable(GL_CULL_FACE, cull != 0);
  if (cull != 0) glCullFace(culls[cull]);
  glPolygonMode(GL_FRONT, modes[pl_choice(s, "fill|line|point", "draws.%d.front_mode", i)]);
  glPolygonMode(GL_BACK, modes[pl_choice(s, "fill|line|point", "draws.%d.back_mode", i)]);
  glLineWidth((float)pl_number(s, "draws.%d.line_width", i));
  glPointSize((float)pl_number(s, "draws.%d.point_size", i));
  enable(GL_DEPTH_CLAMP, pl_number(s, "frame.depth_clamp") != 0);
  glDepthRange(pl_number(s, "draws.%d.depth_range.0", i), pl_number(s, "draws.%d.depth_range.1", i));
  glEnable(GL_POLYGON_OFFSET_FILL), glEnable(GL_POLYGON_OFFSET_LINE), glEnable(GL_POLYGON_OFFSET_POINT);
  glPolygonOffset((float)pl_number(s, "draws.%d.polygon_offset.factor", i),
                  (float)pl_number(s, "draws.%d.polygon_offset.units", i));
}

static GLenum stencil_op(const PlScene *s, int i, const char *side, const char *when) {
  static const GLenum ops[] = {GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_INCR_WRAP, GL_DECR, GL_DECR_WRAP, GL_INVERT};
  return ops[pl_choice(s, "keep|zero|replace|increment|increment_wrap|decrement|decrement_wrap|invert",
                       "draws.%d.stencil.%s.%s", i, side, when)];
}

static void set_stencil(const PlScene *s, int i, GLenum face, const char *side) {
  glStencilFuncSeparate(face, compares[pl_choice(s, compare_words, "draws.%d.stencil.%s.func", i, side)],
                        (int)pl_number(s, "draws.%d.stencil.%s.reference", i, side),
                        (GLuint)pl_number(s, "draws.%d.stencil.%s.mask", i, side));
  glStencilOpSeparate(face, stencil_op(s, i, side, "fail"), stencil_op(s, i, side, "depth_fail"),
                      stencil_op(s, i, side, "pass"));
  glStencilMaskSeparate(face, (GLuint)pl_number(s, "draws.%d.stencil.%s.write_mask", i, side));
}

static GLenum factor(const PlScene *s, int i, const char *of, const char *which) {
  static const GLenum factors[] = {
      GL_ZERO, GL_ONE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR, GL_SRC_ALPHA,
      GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR,
      GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_SRC_ALPHA_SATURATE};
  return factors[pl_choice(
      s, "zero|one|source_color|one_minus_source_color|destination_color|one_minus_destination_color|source_alpha|"
         "one_minus_source_alpha|destination_alpha|one_minus_destination_alpha|constant_color|one_minus_constant_color|"
         "constant_alpha|one_minus_constant_alpha|source_alpha_saturate", "draws.%d.blend.%s.%s", i, of, which)];
}

static GLenum equation(const PlScene *s, int i, const char *of) {
  static const GLenum equations[] = {GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX};
  return equations[pl_choice(s, "add|subtract|reverse_subtract|min|max", "draws.%d.blend.%s.equation", i, of)];
}

static void set_tests(const PlScene *s, int i) {
  const int alpha = pl_has(s, "draws.%d.alpha_test", i), stencil = pl_has(s, "draws.%d.stencil", i),
            blend = pl_has(s, "draws.%d.blend", i), logic = pl_has(s, "draws.%d.logic_op", i);
  double mask[4];
  float v[4];
  enable(GL_ALPHA_TEST, alpha), enable(GL_STENCIL_TEST, stencil), enable(GL_BLEND, blend), enable(GL_COLOR_LOGIC_OP, logic);
  if (alpha) glAlphaFunc(compares[pl_choice(s, compare_words, "draws.%d.alpha_test.func", i)],
                         (float)pl_number(s, "draws.%d.alpha_test.reference", i));
  if (stencil) set_stencil(s, i, GL_FRONT, "front"), set_stencil(s, i, GL_BACK, "back");
  glEnable(GL_DEPTH_TEST), glDepthFunc(compares[pl_choice(s, compare_words, "draws.%d.depth_func", i)]);
  glDepthMask((GLboolean)pl_number(s, "draws.%d.depth_mask", i));
  pl_numbers(s, mask, 4, "draws.%d.color_mask", i);
  glColorMask((GLboolean)mask[0], (GLboolean)mask[1], (GLboolean)mask[2], (GLboolean)mask[3]);
  if (blend) {
    glBlendFuncSeparate(factor(s, i, "rgb", "source"), factor(s, i, "rgb", "destination"),
                        factor(s, i, "alpha", "source"), factor(s, i, "alpha", "destination"));
    glBlendEquationSeparate(equation(s, i, "rgb"), equation(s, i, "alpha"));
    floats_at(s, v, 4, at("draws", i, "blend.color")), glBlendColor(v[0], v[1], v[2], v[3]);
  }
  if (logic) glLogicOp(GL_CLEAR + (GLenum)pl_choice(s, "clear|and|and_reverse|copy|and_inverted|noop|xor|or|nor|equivalent|"
                                                       "invert|or_reverse|copy_inverted|or_inverted|nand|set",
                                                    "draws.%d.logic_op", i));
}

static void draw_primitives(const PlScene *s, int i) {
  static const GLenum topologies[] = {GL_POINTS, GL_LINES, GL_TRIANGLES};
  const int mesh = (int)pl_number(s, "draws.%d.mesh", i), corners = 1 + pl_choice(s, "points|lines|triangles", "draws.%d.topology", i);
  size_t count, n;
  int k;
  const uint32_t *indices = pl_uints(s, &count, "meshes.%d.indices", mesh);
  const float *p = pl_floats(s, NULL, "meshes.%d.positions", mesh), *normals = pl_floats(s, NULL, "meshes.%d.normals", mesh),
              *colors = pl_floats(s, NULL, "meshes.%d.colors", mesh), *texcoords = pl_floats(s, NULL, "meshes.%d.texcoords", mesh);
  float diffuse[4];
  glMatrixMode(GL_PROJECTION), glLoadMatrixd((const double *)(const void *)pl_floats(s, NULL, "matrices_f64.projection") + 16 * i);
  glMatrixMode(GL_MODELVIEW), glLoadMatrixd((const double *)(const void *)pl_floats(s, NULL, "matrices_f64.model_view") + 16 * i);
  floats_at(s, diffuse, 4, at("draws", i, "material.diffuse"));
  glBegin(topologies[corners - 1]);
  for (n = 0; n < count / 3; ++n) {
    for (k = 0; k < corners; ++k) {
      const uint32_t v = indices[3 * n + (size_t)k];
      glColor4fv(colors != NULL ? colors + 4 * v : diffuse);
      if (normals != NULL) glNormal3fv(normals + 3 * v);
      if (texcoords != NULL) glTexCoord2fv(texcoords + 2 * v);
      glVertex3fv(p + 3 * v);
    }
  }
  glEnd();
}

static void draw(const PlScene *s, PlCapture *out) {
  static const GLenum types[] = {GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_FLOAT};
  const int color = pl_choice(s, "rgba8|rgba16|rgba32f", "frame.color"), depth = pl_choice(s, "z16|z24", "frame.depth");
  const double codes = depth == 0 ? 65535 : 16777215;
  const size_t pixels = (size_t)out->width * (size_t)out->height;
  OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, depth == 0 ? 16 : 24, pl_is(s, "none", "frame.stencil") ? 0 : 8, 0, NULL);
  float *floats = (float *)pl_memory(NULL, 4 * pixels * sizeof(float)), clear[4];
  double *z = (double *)pl_memory(NULL, pixels * sizeof(double));
  void *frame = pl_memory(NULL, 16 * pixels);
  size_t n;
  int i;
  if (pl_number(s, "frame.sample.0") != 0 || pl_number(s, "frame.sample.1") != 0) pl_unsupported("samples off the centre");
  if (context == NULL || !OSMesaMakeCurrent(context, frame, types[color], out->width, out->height)) pl_unsupported("this frame");
  glClampColor(GL_CLAMP_FRAGMENT_COLOR, color == 2 ? GL_FALSE : GL_TRUE), glClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
  set_lights(s);
  for (i = 0; i < (int)pl_number(s, "textures"); ++i) set_texture(s, i);
  floats_at(s, clear, 4, "frame.clear_color"), glClearColor(clear[0], clear[1], clear[2], clear[3]);
  glClearDepth(pl_number(s, "frame.clear_depth")), glClearStencil((int)pl_number(s, "frame.clear_stencil"));
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  for (i = 0; i < (int)pl_number(s, "draws"); ++i) {
    set_surface(s, i), set_raster(s, i, out->width, out->height), set_tests(s, i);
    draw_primitives(s, i);
  }
  glFinish();
  glReadPixels(0, 0, out->width, out->height, GL_RGBA, GL_FLOAT, floats);
  pl_color(out, floats);
  glReadPixels(0, 0, out->width, out->height, GL_DEPTH_COMPONENT, GL_FLOAT, floats);
  for (n = 0; n < pixels; ++n) z[n] = (double)(int)(floats[n] * codes + 0.5) / codes;
  pl_depth(out, z);
  OSMesaDestroyContext(context);
  free(floats), free(z), free(frame);
}

int main(int argc, char **argv) { return pl_main(argc, argv, "OpenGL", draw); }
