#include "rasterizer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CORNERS = 9 + 3, SUBPIXELS = 256 };

static double min(double a, double b) { return a < b ? a : b; }
static double max(double a, double b) { return a > b ? a : b; }
static double clamp(double x, double low, double high) { return min(max(x, low), high); }
static double as_code(double x, double codes) { return codes > 0 ? nearbyint(clamp(x, 0, 1) * codes) : (float)x; }

void clear_frame(Frame *frame, const double color[4], double depth) {
  const size_t pixels = (size_t)frame->width * (size_t)frame->height;
  size_t i, c;
  frame->color = realloc(frame->color, 4 * pixels * sizeof(double));
  frame->floats = realloc(frame->floats, 4 * pixels * sizeof(float));
  frame->depth = realloc(frame->depth, pixels * sizeof(double));
  for (i = 0; i < pixels; ++i) {
    for (c = 0; c < 4; ++c) frame->color[4 * i + c] = as_code(color[c], frame->color_codes);
    frame->depth[i] = as_code(depth, frame->depth_codes);
  }
}

void finish_frame(Frame *frame) {
  const size_t pixels = (size_t)frame->width * (size_t)frame->height;
  size_t i;
  for (i = 0; i < 4 * pixels; ++i) frame->floats[i] = (float)(frame->color[i] / max(frame->color_codes, 1));
  for (i = 0; i < pixels; ++i) frame->depth[i] /= max(frame->depth_codes, 1);
}

/* Of a plane of the view volume: left, right, bottom, top, near, far; inside is not negative. */
static double inside(const double p[4], int plane) { return plane % 2 == 0 ? p[3] + p[plane / 2] : p[3] - p[plane / 2]; }

static Vertex between(const Vertex *a, const Vertex *b, double share) {
  Vertex out;
  int i;
  for (i = 0; i < 4; ++i) out.p[i] = a->p[i] + share * (b->p[i] - a->p[i]);
  for (i = 0; i < 4; ++i) out.color[i] = a->color[i] + share * (b->color[i] - a->color[i]);
  return out;
}

static int clip(Vertex *polygon, int count, int planes) {
  int plane, i;
  for (plane = 0; plane < planes; ++plane) {
    Vertex out[MOST_CORNERS];
    int kept = 0;
    for (i = 0; i < count; ++i) {
      const Vertex *a = &polygon[i], *b = &polygon[(i + 1) % count];
      const double at_a = inside(a->p, plane), at_b = inside(b->p, plane);
      if (at_a >= 0) out[kept++] = *a;
      if ((at_a >= 0) != (at_b >= 0)) out[kept++] = between(a, b, at_a / (at_a - at_b));
    }
    count = kept;
    for (i = 0; i < count; ++i) polygon[i] = out[i];
  }
  return count;
}

static int passes(Compare func, double mine, double held) {
  switch (func) {
    case NEVER: return 0;
    case LESS: return mine < held;
    case EQUAL: return mine == held;
    case LESS_EQUAL: return mine <= held;
    case GREATER: return mine > held;
    case NOT_EQUAL: return mine != held;
    case GREATER_EQUAL: return mine >= held;
    case ALWAYS: return 1;
  }
  return 0;
}

static void write_pixel(Frame *frame, const State *state, int x, int y, double z, const double color[4]) {
  const long i = (long)y * frame->width + x;
  int c, drawn;
  z = as_code(z, frame->depth_codes);
  drawn = passes(state->depth_func, z, frame->depth[i]);
  if (frame->listener) frame->listener->fragment(frame, x, y, z / max(frame->depth_codes, 1), color, drawn);
  if (!drawn) return;
  if (state->write_depth) frame->depth[i] = z;
  for (c = 0; c < 4; ++c) {
    if (state->write_color[c]) frame->color[4 * i + c] = as_code(color[c], frame->color_codes);
  }
}

/* Twice the area of a triangle, positive where it is counter-clockwise. */
static double area_of(const double a[2], const double b[2], const double c[2]) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* A centre on an edge is in if the interior lies to its right, or, on a horizontal edge, above. */
static int covers(const double at[3][2], double sign, const double centre[2]) {
  int k;
  for (k = 0; k < 3; ++k) {
    const double *from = at[(k + 1) % 3], *to = at[(k + 2) % 3];
    const double d_x = (to[0] - from[0]) * sign, d_y = (to[1] - from[1]) * sign, e = sign * area_of(from, to, centre);
    if (e < 0 || (e == 0 && !(d_y < 0 || (d_y == 0 && d_x > 0)))) return 0;
  }
  return 1;
}

/* Corners inside the view volume to pixels. Coverage goes by corners on a grid, what is interpolated by the corners. */
static void fill(Frame *frame, const State *state, const Vertex *const v[3]) {
  const double size[2] = {frame->width / 2.0, frame->height / 2.0}, depth = (state->far - state->near) / 2;
  double win[3][2], grid[3][2], z[3], slope[2] = {0, 0}, low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9}, area, sign, offset;
  int k, i, x, y, c;
  for (k = 0; k < 3; ++k) {
    const double *p = v[k]->p;
    if (p[3] == 0) return;
    z[k] = p[2] / p[3] * depth + (state->far + state->near) / 2;
    for (i = 0; i < 2; ++i) {
      win[k][i] = p[i] / p[3] * size[i] + size[i] - 0.5;
      grid[k][i] = nearbyint(win[k][i] * SUBPIXELS) / SUBPIXELS;
      low[i] = min(low[i], grid[k][i]), high[i] = max(high[i], grid[k][i]);
    }
  }
  area = area_of(grid[0], grid[1], grid[2]), sign = area > 0 ? 1 : -1;
  if (area == 0 || (area > 0 ? state->cull_front : state->cull_back)) return;
  if (frame->listener) frame->listener->triangle(frame, (const double(*)[2])win, z, v);
  if (sign * area_of(win[0], win[1], win[2]) <= 0) memcpy(win, grid, sizeof win); /* turned over by the grid */
  area = area_of(win[0], win[1], win[2]);
  for (k = 0; k < 3; ++k) {
    const double *from = win[(k + 1) % 3], *to = win[(k + 2) % 3];
    slope[0] += z[k] * (from[1] - to[1]) / area, slope[1] += z[k] * (to[0] - from[0]) / area;
  }
  offset = state->offset_factor * max(fabs(slope[0]), fabs(slope[1])) + state->offset_units;
  for (y = (int)max(ceil(low[1]), state->box[1]); y <= min(floor(high[1]), state->box[3] - 1); ++y) {
    for (x = (int)max(ceil(low[0]), state->box[0]); x <= min(floor(high[0]), state->box[2] - 1); ++x) {
      const double centre[2] = {x, y};
      double here = offset, inv_w = 0, color[4] = {0, 0, 0, 0};
      if (!covers((const double(*)[2])grid, sign, centre)) continue;
      for (k = 0; k < 3; ++k) {
        const double share = area_of(win[(k + 1) % 3], win[(k + 2) % 3], centre) / area, q = share / v[k]->p[3];
        here += share * z[k], inv_w += q;
        for (c = 0; c < 4; ++c) color[c] += q * v[k]->color[c];
      }
      for (c = 0; c < 4; ++c) color[c] /= inv_w;
      here = clamp(here, min(state->near, state->far), max(state->near, state->far));
      write_pixel(frame, state, x, y, here, color);
    }
  }
}

void draw_triangle(Frame *frame, const State *state, const Vertex corners[3]) {
  Vertex polygon[MOST_CORNERS];
  int count = 3, i;
  for (i = 0; i < 3; ++i) polygon[i] = corners[i];
  count = clip(polygon, count, state->depth_clamp ? 4 : 6);
  if (frame->listener && count > 2) frame->listener->polygon(frame, polygon, count);
  for (i = 2; i < count; ++i) {
    const Vertex *v[3] = {&polygon[i - 1], &polygon[i], &polygon[0]};
    fill(frame, state, v);
  }
}
