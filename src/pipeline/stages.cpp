#include "pipeline/stages.h"

namespace plumbline::pipeline {

DrawInput draw_input(const Scene& scene, const Draw& draw, const Matrices<float>& matrices) {
  return {&draw, scene.meshes[draw.mesh].topology, scene.depth_clamp, carries(scene, draw, Varying::back_color),
          matrices};
}

}  // namespace plumbline::pipeline
