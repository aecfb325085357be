// A small rasterizer: triangles in window space, with depth test less, or without one, into floats.
#pragma once

#include <vector>

struct Corner {
  double x, y, z, inv_w;  // window space [pixel, pixel, 0 to 1]; 1 / w_clip
  double color[4];
};

struct Image {
  Image(int width, int height, const double (&clear)[4], double clear_depth = 1);
  int width, height;
  std::vector<float> color;   // rgba, row 0 at the bottom
  std::vector<double> depth;  // of 24 bits
  bool depth_test = true;
};

void draw(Image& image, const Corner (&corners)[3]);
