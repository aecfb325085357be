#include "pipeline/render.h"

#include "pipeline/painter.h"

namespace plumbline::pipeline {

Stages production_stages() { return {geometry_stages(), fragment_functions<FragmentStages>()}; }

Frame render(const Scene& scene) { return std::move(Painter().draw(scene)); }

std::vector<Frame> render_passes(const Scene& scene, const Stages& stages) {
  std::vector<Frame> frames;
  for (const Scene& pass : passes_of(scene)) frames.push_back(render(pass, stages));
  return frames;
}

Frame render(const Scene& scene, const Stages& stages) {
  if (scene.frame.antialias.kind != Antialias::Kind::none) {
    return resolve(stages.resolve, scene.frame, render_passes(scene, stages));
  }
  const Geometry geometry = run_geometry(scene, stages.geometry);
  Frame frame(scene.frame);
  NoTap tap;
  const std::vector<Surface> surfaces = surfaces_of(scene, geometry.records);
  stages.fragment.draw({geometry.records.triangles, geometry.first_triangle, scene.draws, surfaces, scene.depth_clamp},
                       scene.frame, frame, tap);
  return frame;
}

}  // namespace plumbline::pipeline
