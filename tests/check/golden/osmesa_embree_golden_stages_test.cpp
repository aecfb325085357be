// A fault in any stage is named by the goldens and by the references (scripts/break_stages: by the program, on more
// scenes).
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "check/diagnose/diagnose.h"
#include "check/golden/golden.h"
#include "faults/faults.h"
#include "reference/embree/embree.h"
#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"
#include "renderers/pipeline_renderer.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

// For each stage a fault, and a small scene that shows it.
struct StageBreak {
  const char *fault, *scene;
};
constexpr StageBreak kStageBreaks[] = {
    {"matrices.rotation_sign", "light/turned_away"},
    {"vertex.w_is_one", "frame/one_pixel_float"},
    {"light.ambient_per_light", "light/turned_away"},
    {"clip.no_near_plane", "clip/corners_on_planes"},
    {"window.snap_truncates", "cull/both_windings"},
    {"coverage.inclusive_edges", "coverage/shared_edges"},
    {"depth.truncated", "depth/functions"},
    {"attributes.affine", "interpolation/w_ratio"},
    {"texture.t_flipped", "texture/borders_at_centres"},
    {"shade.fog_near", "fog/cut"},
    {"visibility.less_equal", "depth/clear_z16"},
    {"merge.truncated", "frame/one_pixel"},
    {"resolve.truncated", "antialias/taps_fog_cut"},
};

TEST(GoldenStages, AFaultInAnyIsNamedByTheGoldensAndByTheReferences) {
  const GoldenSet goldens(PLUMBLINE_SOURCE_DIR "/golden", GoldenSet::Access::read);
  const auto osmesa = make_opengl();
  const auto embree = embree::make_embree();
  const auto exact = exact::make_exact();
  const Reference references[] = {{"osmesa", osmesa.get()}, {"embree", embree.get()}, {"exact", exact.get()}};
  std::set<Stage> stages;
  for (const StageBreak& b : kStageBreaks) {
    const faults::Fault fault = faults::named(b.fault);
    const Scene scene = suite_scene(std::string(b.scene));
    const auto candidate = pipeline::make_pipeline(fault.stages());
    const GoldenDifference difference = compare_golden(scene, *candidate, goldens);
    EXPECT_EQ(difference.why, "") << b.fault;
    ASSERT_FALSE(difference.stages.empty()) << b.fault;
    EXPECT_EQ(difference.stages[0], fault.stage) << b.fault;
    EXPECT_EQ(diagnose(scene, *candidate, references).first, fault.stage) << b.fault;
    stages.insert(fault.stage);
  }
  EXPECT_EQ(stages.size(), kStageNames.size());
}

}  // namespace
}  // namespace plumbline::check
