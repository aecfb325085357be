// The rasterizer as plumb calls it, by plumbline's kit: it begins with triangles in window space (--from window).
#include <plumbline/plumbline.h>

#include "rasterizer.h"

namespace {

// State that the rasterizer does not draw: plumb is told so, and does not judge such scenes.
void require_drawable(const PlScene* scene) {
  pl_choice(scene, "rgba8", "frame.color");
  pl_choice(scene, "z24", "frame.depth");
  if (pl_number(scene, "frame.sample.0") != 0 || pl_number(scene, "frame.sample.1") != 0)
    pl_unsupported("samples beside the pixel's centre");
  if (pl_number(scene, "light_model.separate_specular") != 0) pl_unsupported("a specular colour of its own");
  for (int i = 0; i < static_cast<int>(pl_number(scene, "draws")); ++i) {
    pl_choice(scene, "triangles", "draws.%d.topology", i);
    if (pl_number(scene, "draws.%d.lit", i) != 0) pl_choice(scene, "flat|gouraud", "draws.%d.shading", i);
    for (const char* state : {"scissor", "alpha_test", "stencil", "fog", "blend", "logic_op", "texture"})
      pl_none(scene, "draws.%d.%s", i, state);
    for (const char* offset : {"factor", "units"})
      if (pl_number(scene, "draws.%d.polygon_offset.%s", i, offset) != 0) pl_unsupported("polygon offset");
    if (pl_number(scene, "draws.%d.depth_mask", i) != 1) pl_unsupported("a depth mask");
    for (int c = 0; c < 4; ++c)
      if (pl_number(scene, "draws.%d.color_mask.%d", i, c) != 1) pl_unsupported("a colour mask");
  }
}

void draw_scene(const PlScene* scene, PlCapture* out) {
  require_drawable(scene);
  double clear[4];
  pl_numbers(scene, clear, 4, "frame.clear_color");
  Image image(out->width, out->height, clear, pl_number(scene, "frame.clear_depth"));
  for (int i = 0; i < static_cast<int>(pl_number(scene, "draws")); ++i) {
    const bool depth_test = pl_choice(scene, "less|always", "draws.%d.depth_func", i) == 0;
    if (i > 0 && depth_test != image.depth_test) pl_unsupported("draws of two depth functions");
    image.depth_test = depth_test;
  }
  std::size_t numbers = 0;
  const float* const p_win = pl_floats(scene, &numbers, "window.p_win");
  const float* const inv_w = pl_floats(scene, nullptr, "window.inv_w");
  const float* const color = pl_floats(scene, nullptr, "window.color");
  for (std::size_t i = 0; i < numbers / 9; ++i) {
    Corner corners[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const float* const p = p_win + 9 * i + 3 * k;
      corners[k] = {p[0], p[1], p[2], inv_w[3 * i + k], {}};
      for (std::size_t c = 0; c < 4; ++c) corners[k].color[c] = color[12 * i + 4 * k + c];
    }
    draw(image, corners);
  }
  pl_color(out, image.color.data());
  pl_depth(out, image.depth.data());
}

}  // namespace

int main(int argc, char** argv) { return pl_main(argc, argv, "my rasterizer", draw_scene); }
