// What the renderers are timed on.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace plumbline::bench {

struct BenchScene {
  std::string name;
  std::function<Scene(int size)> make;  ///< for a frame of size x size pixels
};
/// Each at 1024 x 1024, clear included.
std::vector<BenchScene> bench_scenes();

/// A lit sphere of about so many triangles, Gouraud, its back faces culled: the first of them.
Scene sphere_scene(int triangles, int size);

}  // namespace plumbline::bench
