// Scenes of the benchmarks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace plumbline::bench {

struct BenchScene {
  std::string name;
  std::function<Scene(int size)> make;  ///< for a frame of size x size pixels
  int size = 0;                         ///< of its frame; 0: as asked for
  bool is_read = false;                 ///< its colours are read after each frame
  bool is_of_layers = false;            ///< a hundred layers, of which ours paints the nearest alone
};
std::vector<BenchScene> bench_scenes();

/// Lit Gouraud sphere of about `triangles` triangles, its back faces culled.
Scene sphere_scene(int triangles, int size);

}  // namespace plumbline::bench
