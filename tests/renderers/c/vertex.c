/* Vertices from model to clip space, and their light: OpenGL's equation (2.1 specification, 2.14.1) in double. */
#include <math.h>

#include "columns.h"
#include "records.h"

typedef struct {
  double p[4], ambient[3], diffuse[3], specular[3], fade[3], spot[3], cutoff, exponent;
} Light;

typedef struct {
  double ambient[4], diffuse[4], specular[4], emission[4], shininess;
} Material;

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void make_unit(double v[3]) {
  const double length = sqrt(dot(v, v));
  int i;
  for (i = 0; i < 3 && length > 0; ++i) v[i] /= length;
}

static double positive(double x) { return x > 0 ? x : 0; }

static Light light_of(const PlScene *s, int i) {
  Light out = {{0}, {0}, {0}, {0}, {0}, {0}, 180, 0};
  pl_numbers(s, out.p, 4, "lights.%d.p_eye", i), pl_numbers(s, out.ambient, 3, "lights.%d.ambient", i);
  pl_numbers(s, out.diffuse, 3, "lights.%d.diffuse", i), pl_numbers(s, out.specular, 3, "lights.%d.specular", i);
  pl_numbers(s, out.fade, 3, "lights.%d.attenuation", i);
  if (pl_has(s, "lights.%d.spot", i)) {
    pl_numbers(s, out.spot, 3, "lights.%d.spot.spot_eye", i), make_unit(out.spot);
    out.cutoff = pl_number(s, "lights.%d.spot.cutoff", i), out.exponent = pl_number(s, "lights.%d.spot.exponent", i);
  }
  return out;
}

static Material material_of(const PlScene *s, int i) {
  Material out;
  pl_numbers(s, out.ambient, 4, "draws.%d.material.ambient", i), pl_numbers(s, out.diffuse, 4, "draws.%d.material.diffuse", i);
  pl_numbers(s, out.specular, 4, "draws.%d.material.specular", i);
  pl_numbers(s, out.emission, 4, "draws.%d.material.emission", i);
  out.shininess = pl_number(s, "draws.%d.material.shininess", i);
  return out;
}

static void add_light(const Light *l, const Material *m, int local, const double p[3], const double n[3], double sum[3]) {
  double to_light[3], half[3] = {0, 0, 1}, share = 1, d = 0;
  int c;
  for (c = 0; c < 3; ++c) to_light[c] = l->p[c] - (l->p[3] != 0 ? p[c] : 0);
  d = sqrt(dot(to_light, to_light));
  make_unit(to_light);
  for (c = 0; c < 3 && local; ++c) half[c] = -p[c];
  make_unit(half);
  for (c = 0; c < 3; ++c) half[c] += to_light[c];
  make_unit(half);
  if (l->p[3] != 0) share = 1 / (l->fade[0] + (l->fade[1] + l->fade[2] * d) * d);
  if (l->cutoff <= 90) {
    const double cosine = -dot(to_light, l->spot);
    if (cosine < cos(l->cutoff * acos(-1) / 180)) return;
    share *= pow(cosine, l->exponent);
  }
  for (c = 0; c < 3; ++c) {
    double bright = l->ambient[c] * m->ambient[c];
    if (dot(n, to_light) > 0) {
      bright += dot(n, to_light) * l->diffuse[c] * m->diffuse[c];
      if (l->specular[c] * m->specular[c] > 0) /* else the power may be infinite, and their product no number */
        bright += pow(positive(dot(n, half)), m->shininess) * l->specular[c] * m->specular[c];
    }
    sum[c] += share * bright;
  }
}

/* out = matrix v: `size` rows and columns, column by column. */
static void transform(const double *matrix, int size, const double *v, double *out) {
  int r, c;
  for (r = 0; r < size; ++r) {
    out[r] = 0;
    for (c = 0; c < size; ++c) out[r] += matrix[size * c + r] * v[c];
  }
}

static void *numbers_of(Column *to, const double *v, int count) {
  float *out = (float *)append(to, (size_t)count * sizeof(float));
  int c;
  for (c = 0; c < count; ++c) out[c] = (float)v[c];
  return out;
}

static const double *matrix_of(const PlScene *s, const char *name, int draw, int size) {
  return (const double *)(const void *)pl_floats(s, NULL, "matrices_f64.%s", name) + size * size * draw;
}

static const double *projection_of(const PlScene *s, int draw) {
  double *out = (double *)append(&projections, 16 * sizeof(double));
  memcpy(out, matrix_of(s, "projection", draw, 4), 16 * sizeof *out);
  return out;
}

static void add_vertex(const PlScene *s, int draw, int mesh, size_t v, const Material *of_draw,
                       const double *projection) {
  static const char *const terms = "none|ambient|diffuse|ambient_and_diffuse|specular|emission";
  const double *model_view = matrix_of(s, "model_view", draw, 4);
  const double *by = matrix_of(s, "normal", draw, 3);
  const float *position = pl_floats(s, NULL, "meshes.%d.positions", mesh) + 3 * v;
  const float *normals = pl_floats(s, NULL, "meshes.%d.normals", mesh), *colors = pl_floats(s, NULL, "meshes.%d.colors", mesh);
  const int normal_mode = pl_choice(s, "normalize|rescale|as_they_are", "draws.%d.normals", draw);
  const int term = pl_choice(s, terms, "draws.%d.color_material", draw), local = pl_number(s, "light_model.local_viewer") != 0;
  Material m = *of_draw;
  double p[4] = {position[0], position[1], position[2], 1}, eye[4], clip[4], n[3] = {0, 0, 1}, color[4], normal[3];
  int c, i;
  for (c = 0; c < 3 && normals != NULL; ++c) n[c] = normals[3 * v + (size_t)c];
  transform(model_view, 4, p, eye), transform(projection, 4, eye, clip), transform(by, 3, n, normal);
  if (normal_mode == 0) make_unit(normal);
  if (normal_mode == 1) {
    const double scale = sqrt(by[6] * by[6] + by[7] * by[7] + by[8] * by[8]);
    for (c = 0; c < 3; ++c) normal[c] /= scale;
  }
  for (c = 0; c < 4; ++c) {
    const double own = colors != NULL ? colors[4 * v + (size_t)c] : m.diffuse[c];
    if (colors != NULL && (term == 1 || term == 3)) m.ambient[c] = own;
    if (colors != NULL && (term == 2 || term == 3)) m.diffuse[c] = own;
    if (colors != NULL && term == 4) m.specular[c] = own;
    if (colors != NULL && term == 5) m.emission[c] = own;
    color[c] = own;
  }
  if (pl_number(s, "draws.%d.lit", draw) != 0) {
    for (c = 0; c < 3; ++c) color[c] = m.emission[c] + m.ambient[c] * pl_number(s, "light_model.ambient.%d", c);
    for (i = 0; i < (int)pl_number(s, "lights"); ++i) {
      const Light light = light_of(s, i);
      add_light(&light, &m, local, eye, normal, color);
    }
    color[3] = m.diffuse[3];
  }
  for (c = 0; c < 4; ++c) color[c] = positive(color[c]) < 1 ? positive(color[c]) : 1;
  numbers_of(&p_eye, eye, 4), numbers_of(&p_clip, clip, 4), numbers_of(&n_eye, normal, 3), numbers_of(&lit, color, 4);
}

const float *vertices_of(const PlScene *s, const float **colors) {
  int i;
  size_t v;
  projections.count = p_eye.count = p_clip.count = n_eye.count = lit.count = 0;
  if (getenv("GIVEN") != NULL) {
    *colors = pl_floats(s, NULL, "light.color");
    return pl_floats(s, NULL, "vertex.p_clip");
  }
  pl_choice(s, "half_vector", "light_model.specular");
  for (i = 0; i < (int)pl_number(s, "draws"); ++i) {
    const Material material = material_of(s, i);
    const double *projection = projection_of(s, i);
    const int mesh = (int)pl_number(s, "draws.%d.mesh", i);
    for (v = 0; v < (size_t)pl_number(s, "draws.%d.vertices", i); ++v) add_vertex(s, i, mesh, v, &material, projection);
  }
  *colors = (const float *)(const void *)lit.bytes;
  return (const float *)(const void *)p_clip.bytes;
}
