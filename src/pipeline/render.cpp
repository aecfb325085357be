#include "pipeline/render.h"

namespace plumbline::pipeline {

Stages production_stages() { return {geometry_stages(), fragment_functions<FragmentStages>()}; }

Frame render(const Scene& scene) { return render(scene, production_stages()); }

Frame render(const Scene& scene, const Stages& stages) {
  const Geometry geometry = run_geometry(scene, stages.geometry);
  Frame frame(scene.frame);
  NoTap tap;
  const std::vector<Surface> surfaces = surfaces_of(scene, geometry.records);
  stages.fragment.draw({geometry.records.triangles, geometry.first_triangle, scene.draws, surfaces}, scene.frame, frame,
                       tap);
  return frame;
}

}  // namespace plumbline::pipeline
