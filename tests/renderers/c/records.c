#include "columns.h"
#include "records.h"

Column projections, p_eye, p_clip, n_eye, lit;
static Column corner, corner_color, polygon_primitive, polygon_first, polygon_count;
static Column p_win, inv_w, win_color, win_primitive, triangle, column, row, depth, color, drawn_column, winner;
static const PlScene *scene_of;

void *append(Column *to, size_t size) {
  to->size = size;
  if (to->count == to->room) {
    to->room = to->room ? 2 * to->room : 1024;
    to->bytes = (char *)pl_memory(to->bytes, to->room * size);
  }
  return to->bytes + size * to->count++;
}

static void add_numbers(Column *to, const double *v, int count) {
  memcpy(append(to, (size_t)count * sizeof(double)), v, (size_t)count * sizeof(double));
}
static void add_count(Column *to, size_t value) { *(uint32_t *)append(to, sizeof(uint32_t)) = (uint32_t)value; }

static void add_polygon(const Frame *frame, const Vertex *corners, int count) {
  int i;
  add_count(&polygon_primitive, frame->primitive), add_count(&polygon_first, corner.count);
  add_count(&polygon_count, (size_t)count);
  for (i = 0; i < count; ++i) add_numbers(&corner, corners[i].p, 4), add_numbers(&corner_color, corners[i].color, 4);
}

static void add_triangle(const Frame *frame, const double win[3][2], const double z[3], const Vertex *const v[3]) {
  double place[9], over[3], colors[12];
  int k, c;
  for (k = 0; k < 3; ++k) {
    place[3 * k] = win[k][0] + 0.5, place[3 * k + 1] = win[k][1] + 0.5, place[3 * k + 2] = z[k];
    over[k] = 1 / v[k]->p[3];
    for (c = 0; c < 4; ++c) colors[4 * k + c] = v[k]->color[c];
  }
  add_numbers(&p_win, place, 9), add_numbers(&inv_w, over, 3), add_numbers(&win_color, colors, 12);
  add_count(&win_primitive, frame->primitive);
}

static void add_fragment(const Frame *frame, int x, int y, double z, const double rgba[4], int drawn) {
  add_count(&triangle, win_primitive.count - 1);
  *(uint16_t *)append(&column, 2) = (uint16_t)x, *(uint16_t *)append(&row, 2) = (uint16_t)y;
  add_numbers(&depth, &z, 1), add_numbers(&color, rgba, 4);
  *(uint8_t *)append(&drawn_column, 1) = (uint8_t)drawn;
  if (drawn) ((int32_t *)(void *)winner.bytes)[y * frame->width + x] = (int32_t)frame->primitive;
}

const Listener *begin_records(const PlScene *s) {
  static const Listener listener = {add_polygon, add_triangle, add_fragment};
  Column *const all[] = {&corner, &corner_color, &polygon_primitive, &polygon_first, &polygon_count, &p_win,   &inv_w,
                         &win_color, &win_primitive, &triangle, &column, &row, &depth, &color, &drawn_column, &winner};
  size_t i, pixels = (size_t)pl_number(s, "frame.width") * (size_t)pl_number(s, "frame.height");
  for (i = 0; i < sizeof all / sizeof *all; ++i) all[i]->count = 0;
  for (i = 0; i < pixels; ++i) *(int32_t *)append(&winner, sizeof(int32_t)) = -1;
  scene_of = s;
  return &listener;
}

static void put(PlCapture *out, const char *name, const char *dtype, const Column *from, size_t components) {
  pl_records(out, name, dtype, from->bytes, from->count, components);
}

/* Arrays of the export that are this renderer's too. */
static void write_given(PlCapture *out, const char *name, const char *of_export, int rows, int columns) {
  size_t count = 0, shape[3];
  const float *values = pl_floats(scene_of, &count, "%s", of_export);
  const size_t floats_of_each = (size_t)(rows * columns) * (strncmp(of_export, "matrices_f64", 12) == 0 ? 2 : 1);
  shape[0] = count / floats_of_each, shape[1] = (size_t)rows, shape[2] = (size_t)columns;
  pl_array(out, name, floats_of_each > (size_t)(rows * columns) ? "f64" : "f32", values, columns > 1 ? 3 : 2, shape);
}

static void write_picture(const Frame *frame, const char *file) {
  FILE *to = fopen(file, "wb");
  int x, y, c;
  if (to == NULL) pl_fail("%s: cannot be written", file);
  fprintf(to, "P6\n%d %d\n255\n", frame->width, frame->height);
  for (y = frame->height - 1; y >= 0; --y) {
    for (x = 0; x < frame->width; ++x) {
      for (c = 0; c < 3; ++c) fputc((int)(frame->floats[4 * (y * frame->width + x) + c] * 255 + 0.5f), to);
    }
  }
  fclose(to);
}

static void write_vertex_stage(PlCapture *out) {
  const size_t of_matrices[] = {projections.count, 4, 4};
  write_given(out, "matrices.model_view", "matrices_f64.model_view", 4, 4);
  pl_array(out, "matrices.projection", "f64", projections.bytes, 3, of_matrices);
  write_given(out, "matrices.normal", "matrices_f64.normal", 3, 3);
  write_given(out, "matrices.win_scale", "matrices.win_scale", 3, 1);
  write_given(out, "matrices.win_translate", "matrices.win_translate", 3, 1);
  write_given(out, "matrices.light.p_eye", "matrices.light.p_eye", 4, 1);
  write_given(out, "matrices.light.spot_eye", "matrices.light.spot_eye", 3, 1);
  put(out, "vertex.p_eye", "f32", &p_eye, 4), put(out, "vertex.p_clip", "f32", &p_clip, 4);
  put(out, "vertex.n_eye", "f32", &n_eye, 3), put(out, "light.color", "f32", &lit, 4);
}

void write_records(const Frame *frame, PlCapture *out) {
  const size_t shape[] = {p_win.count, 3, 3};
  const size_t of_colors[] = {p_win.count, 3, 4};
  if (getenv("PICTURE") != NULL) write_picture(frame, getenv("PICTURE"));
  if (getenv("PICTURES") != NULL) return;
  if (getenv("GIVEN") == NULL) write_vertex_stage(out);
  put(out, "clip.p_clip", "f64", &corner, 4), put(out, "clip.color", "f64", &corner_color, 4);
  put(out, "clip.polygon.primitive", "u32", &polygon_primitive, 1);
  put(out, "clip.polygon.first", "u32", &polygon_first, 1), put(out, "clip.polygon.count", "u32", &polygon_count, 1);
  pl_array(out, "window.p_win", "f64", p_win.bytes, 3, shape), put(out, "window.inv_w", "f64", &inv_w, 3);
  pl_array(out, "window.color", "f64", win_color.bytes, 3, of_colors);
  put(out, "window.primitive", "u32", &win_primitive, 1);
  put(out, "coverage.triangle", "u32", &triangle, 1), put(out, "coverage.x", "u16", &column, 1);
  put(out, "coverage.y", "u16", &row, 1), put(out, "depth.value", "f64", &depth, 1);
  put(out, "attributes.color", "f64", &color, 4), put(out, "shade.color", "f64", &color, 4);
  put(out, "visibility.drawn", "u8", &drawn_column, 1), pl_plane(out, "planes.id", "i32", winner.bytes, 1);
}
