#include "pipeline/stages.h"

#include "kernels/coverage.h"
#include "kernels/merge.h"
#include "kernels/shade.h"
#include "kernels/visibility.h"
#include "pipeline/geometry.h"

namespace plumbline::pipeline {

Stages production_stages() {
  Stages s{};
  s.matrices = matrices;
  s.lights = light_sources;
  s.vertex = transform;
  s.light = light;
  s.assemble = assemble;
  s.clip = clip;
  s.window = to_window;
  s.sample_offsets = [](glm::ivec2 sample) { return SampleOffsets{sample, sample, {0, 0}}; };
  s.scissor = scissored;
  s.coverage = covered_pixels;
  s.depth_setup = depth_setup;
  s.depth = [](const TriangleSetup& t, const Pixels<float>& p) {
    return depth<float>(t.depth_plane, from_anchor<float>(t.planes, p));
  };
  s.attributes = [](const TriangleSetup& t, const AttributeSetup& of, const Pixels<float>& p) {
    return mean<float>(of, weights<float>(t.perspective, from_anchor<float>(t.planes, p)));
  };
  s.texture = texture<float>;
  s.shade = [](const Surface& surface, bool front, const SurfaceAttributes<float>& attributes) {
    return Shaded{shade<float>(surface, front, attributes)};
  };
  s.depth_passes = compares<float, float>;
  s.alpha_passes = alpha_passes<float>;
  s.stencil_test = stencil_test<float>;
  s.writes_depth = [](bool, bool drawn) { return drawn; };
  s.merge_state = [](const Merge& of_draw) { return of_draw; };
  s.merge = merge<float>;
  s.blend = blend<float>;
  s.logic = logic<float>;
  return s;
}

}  // namespace plumbline::pipeline
