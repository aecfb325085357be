// A triangle over the lower left half of a frame, by the renderer alone.
#include <cstdio>

#include <plumbline/painter/painter.h>

int main() {
  plumbline::Scene scene;
  scene.frame.width = scene.frame.height = 16;
  scene.projection = plumbline::Orthographic{-1, 1, -1, 1, 1, 10};
  plumbline::Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.colors.assign(3, {1, 0, 0, 1});
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  plumbline::Draw draw;
  draw.lit = false;
  scene.draws.push_back(draw);
  const plumbline::pipeline::Frame frame = plumbline::pipeline::paint(scene);
  int red = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) red += frame.color_rgba8(x, y) == glm::u8vec4(255, 0, 0, 255) ? 1 : 0;
  }
  std::printf("%d pixels are red, expected 120: no centre on the upper right edge is covered\n", red);
  return red == 120 ? 0 : 1;
}
