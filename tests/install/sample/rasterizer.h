// A small rasterizer: triangles in window space, with depth test less, into floats.
#pragma once

#include <vector>

struct Corner {
  double x, y, z, inv_w;  // window space [pixel, pixel, 0 to 1]; 1 / w_clip
  double color[4];
};

struct Image {
  Image(int width, int height, const double (&clear)[4]);
  int width, height;
  std::vector<float> color;   // rgba, row 0 at the bottom
  std::vector<double> depth;  // 1 where nothing is drawn
};

void draw(Image& image, const Corner (&corners)[3]);
