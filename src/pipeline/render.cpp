#include "pipeline/render.h"

#include "pipeline/draw_simd.h"

namespace plumbline::pipeline {

Stages production_stages() {
  Stages out{geometry_stages(), fragment_functions<FragmentStages>()};
  out.fragment.draw = [draw_tile = simd_targets().back().draw_tile](const DrawList& list, const FrameFormat& format,
                                                                    Frame& frame, NoTap&) {
    draw_frame(draw_tile, list, format, frame);
  };
  return out;
}

Frame render(const Scene& scene) { return render(scene, production_stages()); }

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
