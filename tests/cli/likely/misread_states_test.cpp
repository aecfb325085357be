// Renderers that ignore a state of the scene: the judge names the stage, and the fault draws their frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "check/diagnose/diagnose.h"
#include "cli/likely/known_faults.h"
#include "cli/likely/lookalikes.h"
#include "cli/likely/misread_states.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "tests/suite.h"

namespace plumbline::cli {

namespace {

// Our renderer, which draws the scene as the fault changes it.
class Ignoring : public Renderer {
 public:
  explicit Ignoring(const KnownFault& fault) : fault_(fault) {}
  RendererInfo info() const override { return inner_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    return inner_->capture(changed(scene), request);
  }
  Capture run_stage(const Scene& scene, Stage stage, const Capture& in, const Conventions& conventions) override {
    return inner_->run_stage(changed(scene), stage, in, conventions);
  }

 private:
  Scene changed(Scene scene) const {
    fault_.of_scene(scene);
    return scene;
  }
  const KnownFault& fault_;
  std::unique_ptr<Renderer> inner_ = pipeline::make_pipeline();
};

struct Case {
  std::string fault, scene;
  std::string named = "";  // the stage that the judge names; empty: the fault's own
};

// Without fog or texture, our renderer interpolates no distance or texture coordinates: vertices are lit without them.
// Without cones, lights have no direction, which stage matrices makes.
const std::vector<Case> kStates = {{"matrices.depth_range_ignored", "depth_range/layers"},
                                   {"matrices.depth_range_stays", "depth_range/set_and_unset"},
                                   {"matrices.transforms_ignored", "cull/both_windings"},
                                   {"vertex.normals_normalized", "light/normals_uneven"},
                                   {"vertex.rescale_ignored", "light/normals_grown"},
                                   {"light.lighting_ignored", "light/turned_away"},
                                   {"light.lights_ignored", "light/turned_away"},
                                   {"light.ambient_ignored", "light/turned_away"},
                                   {"light.ambient_without_material", "light/turned_away"},
                                   {"light.colors_ignored", "alpha_test/bands"},
                                   {"light.point_as_direction", "camera/wide", "matrices"},
                                   {"light.specular_ignored", "light/turned_away"},
                                   {"light.shininess_doubled", "light/sphere_gouraud"},
                                   {"light.shininess_halved", "light/sphere_gouraud"},
                                   {"light.shininess_halved", "phong/mirror_floor"},
                                   {"light.emission_ignored", "light/turned_away"},
                                   {"light.material_alpha_ignored", "phong/glass"},
                                   {"light.two_sides_ignored", "light/two_sided_flat"},
                                   {"light.phong_shading_ignored", "phong/reflection"},
                                   {"clip.last_triangle_lost", "depth/interpenetrating"},
                                   {"clip.smooth_shading_ignored", "light/sphere_gouraud"},
                                   {"clip.flat_shading_ignored", "frame/one_pixel"},
                                   {"clip.depth_clamp_ignored", "depth_range/clamped"},
                                   {"window.cull_ignored", "cull/both_windings"},
                                   {"window.cull_stays", "cull/set_and_unset"},
                                   {"window.polygon_mode_ignored", "lines/beneath_points"},
                                   {"window.line_width_ignored", "lines/wide_zero"},
                                   {"window.point_size_ignored", "lines/beneath_points"},
                                   {"coverage.scissor_ignored", "scissor/rows_from_top"},
                                   {"coverage.scissor_by_corners", "scissor/set_and_unset"},
                                   {"coverage.scissor_from_other_side", "scissor/blended"},
                                   {"coverage.scissor_stays", "scissor/set_and_unset"},
                                   {"depth.polygon_offset_ignored", "polygon_offset/beyond_the_near_plane"},
                                   {"depth.offset_without_units", "polygon_offset/clamped"},
                                   {"depth.polygon_offset_stays", "polygon_offset/set_and_unset"},
                                   {"depth.of_16_bits", "depth/interpenetrating"},
                                   {"texture.filters_ignored", "texture/beyond_one_rgba16"},
                                   {"texture.levels_ignored", "texture/constant_row"},
                                   {"texture.minified_as_magnified", "phong/separate_on_a_floor"},
                                   {"texture.magnified_as_minified", "texture/dialect_gzrender"},
                                   {"texture.levels_too_coarse", "phong/separate_on_a_floor"},
                                   {"texture.levels_too_fine", "phong/separate_on_a_floor"},
                                   {"texture.wrap_of_s", "texture/wall_nearest_mixed_wraps"},
                                   {"texture.wraps_swapped", "texture/wall_nearest_mixed_wraps"},
                                   {"texture.repeat_for_clamp", "texture/wall_clamp_to_edge"},
                                   {"texture.repeat_for_mirror", "texture/wall_mirrored_repeat"},
                                   {"texture.blue_first", "texture/file_png"},
                                   {"texture.bytes_reversed", "texture/board_nearest"},
                                   {"texture.srgb_decoded", "texture/file_png"},
                                   {"texture.bias_negated", "texture/floor_bias_up"},
                                   {"texture.lod_limits_ignored", "texture/floor_lod_limits"},
                                   {"texture.border_color_ignored", "texture/wall_clamp_to_border"},
                                   {"shade.attenuation_ignored", "phong/all_at_once"},
                                   {"shade.spot_ignored", "phong/cones_on_a_quad", "matrices"},
                                   {"shade.local_viewer_ignored", "phong/gzrender"},
                                   {"shade.texture_ignored", "texture/borders_at_centres", "light"},
                                   {"shade.texture_stays", "texture/set_and_unset", "light"},
                                   {"shade.fog_ignored", "fog/thick_black", "light"},
                                   {"shade.fog_start_ignored", "fog/linear"},
                                   {"shade.fog_color_ignored", "fog/exp"},
                                   {"shade.fog_density_not_squared", "fog/exp2"},
                                   {"shade.fog_stays", "fog/set_and_unset", "light"},
                                   {"shade.fog_exponents_swapped", "fog/exp"},
                                   {"visibility.depth_func_ignored", "depth/functions"},
                                   {"visibility.depth_func_stays", "depth/set_and_unset"},
                                   {"visibility.equal_depth_left_out", "depth/functions"},
                                   {"visibility.depth_test_ignored", "depth/interpenetrating"},
                                   {"visibility.depth_mask_ignored", "masks/no_depth"},
                                   {"visibility.depth_not_written", "depth/interpenetrating"},
                                   {"visibility.depth_mask_stays", "masks/set_and_unset"},
                                   {"visibility.alpha_test_stays", "alpha_test/set_and_unset"},
                                   {"visibility.equal_alpha_left_out", "alpha_test/functions_rgba8"},
                                   {"visibility.clear_depth_ignored", "depth/clear_z16"},
                                   {"visibility.stencil_ignored", "stencil/funcs"},
                                   {"visibility.stencil_back_ignored", "stencil/volume"},
                                   {"visibility.depth_fail_as_fail", "stencil/volume"},
                                   {"visibility.depth_fail_as_pass", "stencil/volume"},
                                   {"visibility.draws_reversed", "first_triangles/draw_order", "vertex"},
                                   {"visibility.stencil_stays", "stencil/set_and_unset"},
                                   {"visibility.stencil_wraps", "stencil/ops"},
                                   {"merge.blend_ignored", "frame/rgba16_blend"},
                                   {"merge.blend_stays", "blend/set_and_unset"},
                                   {"merge.blend_factors_ignored", "blend/factors"},
                                   {"merge.source_factor_of_one", "blend/factors"},
                                   {"merge.destination_factor_of_one", "blend/factors"},
                                   {"merge.blend_equation_ignored", "blend/equations"},
                                   {"merge.subtracted_the_other_way", "blend/equations"},
                                   {"merge.saturate_ignored", "blend/saturate"},
                                   {"merge.blend_color_ignored", "blend/factors"},
                                   {"merge.logic_op_ignored", "logic_op/sixteen_rgba12"},
                                   {"merge.logic_op_stays", "logic_op/set_and_unset"},
                                   {"merge.color_mask_stays", "masks/set_and_unset"},
                                   {"merge.mask_blue_first", "masks/set_and_unset"},
                                   {"merge.clear_color_ignored", "depth/clear_z16"}};

TEST(MisreadStates, AreNamedByTheirStagesAndAsLikelyFaults) {
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  for (const Case& c : kStates) {
    SCOPED_TRACE(c.fault + " in " + c.scene);
    const Scene scene = suite_scene(c.scene);
    const std::vector<KnownFault> set = misread_states(scene);
    const auto fault = std::ranges::find(set, c.fault, &KnownFault::name);
    ASSERT_NE(fault, set.end());
    Ignoring candidate(*fault);
    const check::Diagnosis diagnosis = check::diagnose_in_brief(scene, candidate, references);
    ASSERT_TRUE(diagnosis.first.has_value());
    EXPECT_EQ(name_of(*diagnosis.first), c.named.empty() ? fault->stage : c.named);
    const Capture left = candidate.capture(scene, {});
    const Lookalikes found = lookalikes(scene, frame_of(left, candidate.info(), diagnosis.verdict));
    EXPECT_TRUE(found.whole) << found.text;
    EXPECT_NE(found.text.find(c.fault), std::string::npos) << found.text;
  }
}

// Every state of the table is set in some scene of the suite, and the suite sets no other.
TEST(MisreadStates, OfTheSuiteAreAllTried) {
  std::set<std::string> in_suite, tried;
  for (const Scene& scene : suite_scenes()) {
    for (const KnownFault& fault : misread_states(scene)) in_suite.insert(fault.name);
  }
  for (const Case& c : kStates) tried.insert(c.fault);
  EXPECT_EQ(in_suite, tried);
}

TEST(MisreadStates, AtTheirDefaultsAreNoFaults) {
  Scene scene;
  scene.draws.emplace_back();
  scene.draws[0].lit = false;
  scene.frame.depth = DepthFormat::z16;
  scene.draws[0].depth_func = DepthFunc::always;
  std::vector<std::string> names;
  for (const KnownFault& fault : misread_states(scene)) names.push_back(fault.name);
  const std::vector<std::string> of_always = {"visibility.depth_func_ignored", "visibility.depth_not_written"},
                                 of_less = {"visibility.depth_test_ignored", "visibility.depth_not_written"};
  EXPECT_EQ(names, of_always) << "it is as if always were less";
  scene.draws[0].depth_func = DepthFunc::less;
  names.clear();
  for (const KnownFault& fault : misread_states(scene)) names.push_back(fault.name);
  EXPECT_EQ(names, of_less);
}

}  // namespace

}  // namespace plumbline::cli
