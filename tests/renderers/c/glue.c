/* The rasterizer as plumb runs it: by plumbline's kit, each primitive of a scene becomes a call of draw_triangle(). */
#include "records.h"

static State state_of(const PlScene *s, int i, const Frame *frame) {
  static const char *const unable[] = {"alpha_test", "stencil", "fog", "blend", "logic_op", "texture"};
  State state = {0};
  double box[4] = {0, 0, 16384, 16384};
  int k, cull = pl_choice(s, "none|back|front", "draws.%d.cull", i);
  for (k = 0; k < 6; ++k) pl_none(s, "draws.%d.%s", i, unable[k]);
  pl_choice(s, "triangles", "draws.%d.topology", i);
  pl_choice(s, "fill", "draws.%d.front_mode", i), pl_choice(s, "fill", "draws.%d.back_mode", i);
  if (pl_number(s, "draws.%d.lit", i) != 0) pl_choice(s, "flat|gouraud", "draws.%d.shading", i);
  if (pl_has(s, "draws.%d.scissor", i)) pl_numbers(s, box, 4, "draws.%d.scissor", i);
  for (k = 0; k < 2; ++k) state.box[k] = (int)box[k];
  state.box[2] = (int)(box[0] + box[2]) < frame->width ? (int)(box[0] + box[2]) : frame->width;
  state.box[3] = (int)(box[1] + box[3]) < frame->height ? (int)(box[1] + box[3]) : frame->height;
  state.cull_back = cull == 1, state.cull_front = cull == 2, state.depth_clamp = (int)pl_number(s, "frame.depth_clamp");
  state.depth_func = (Compare)pl_choice(s, COMPARES, "draws.%d.depth_func", i);
  state.near = pl_number(s, "draws.%d.depth_range.0", i), state.far = pl_number(s, "draws.%d.depth_range.1", i);
  state.offset_factor = pl_number(s, "draws.%d.polygon_offset.factor", i);
  state.offset_units = pl_number(s, "draws.%d.polygon_offset.units", i);
  if (state.offset_units != 0 && frame->depth_codes == 0) pl_unsupported("polygon offset of float depth");
  if (state.offset_units != 0) state.offset_units *= 2 / frame->depth_codes;
  state.write_depth = (int)pl_number(s, "draws.%d.depth_mask", i);
  for (k = 0; k < 4; ++k) state.write_color[k] = (int)pl_number(s, "draws.%d.color_mask.%d", i, k);
  return state;
}

static void draw(const PlScene *s, PlCapture *out) {
  static const double codes[] = {255, 4095, 65535, 0, 255, 65535, 16777215, 0};
  const float *colors, *p = vertices_of(s, &colors);
  static Frame frame;
  double clear[4];
  int i, n, k, c;
  frame.width = out->width, frame.height = out->height;
  frame.color_codes = codes[pl_choice(s, "rgba8|rgba12|rgba16|rgba32f", "frame.color")];
  frame.depth_codes = codes[4 + pl_choice(s, "z8|z16|z24|z32f", "frame.depth")];
  pl_choice(s, "one", "light_model.sides"), pl_numbers(s, clear, 4, "frame.clear_color");
  if (pl_number(s, "light_model.separate_specular") != 0 || pl_number(s, "frame.sample.0") != 0) pl_unsupported("this frame");
  clear_frame(&frame, clear, pl_number(s, "frame.clear_depth"));
  frame.listener = begin_records(s), frame.primitive = 0;
  for (i = 0; i < (int)pl_number(s, "draws"); ++i) {
    const State state = state_of(s, i, &frame);
    const uint32_t *at = pl_uints(s, NULL, "meshes.%d.indices", (int)pl_number(s, "draws.%d.mesh", i));
    const size_t first = (size_t)pl_number(s, "draws.%d.first_vertex", i);
    const int flat = pl_is(s, "flat", "draws.%d.shading", i);
    for (n = 0; n < (int)pl_number(s, "draws.%d.primitives", i); ++n, at += 3, ++frame.primitive) {
      Vertex corners[3];
      for (k = 0; k < 12; ++k) c = k % 4, corners[k / 4].p[c] = p[4 * (first + at[k / 4]) + c];
      for (k = 0; k < 12; ++k) c = k % 4, corners[k / 4].color[c] = colors[4 * (first + at[flat ? 2 : k / 4]) + c];
      draw_triangle(&frame, &state, corners);
    }
  }
  finish_frame(&frame);
  pl_color(out, frame.floats), pl_depth(out, frame.depth), write_records(&frame, out);
}

int main(int argc, char **argv) { return pl_main(argc, argv, "a small rasterizer in C", draw); }
