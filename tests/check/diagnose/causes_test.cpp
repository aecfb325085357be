// Likely causes: each is named for the bug that it is, and for no other.

#include <algorithm>
#include <map>
#include <set>

#include "check/diagnose/diagnose.h"
#include "check/diagnose/known_causes.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/stage_copy.h"
#include "faults/faults.h"
#include "renderers/pipeline_renderer.h"
#include "scene/antialias.h"
#include "tests/check/fixtures.h"
#include "tests/extent.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

std::string_view name_by_words(const std::string& words) {
  for (const KnownCause& h : all_causes()) {
    if (words.starts_with(h.words)) return h.name;
  }
  return "no such cause";
}

// The causes that diagnose() names of a fault.
std::set<std::string_view> causes_of(const std::string& fault_name, const std::string& scene) {
  const auto candidate = pipeline::make_pipeline(faults::named(fault_name).stages());
  const auto exact = exact::make_exact();
  const Reference references[] = {{"exact", exact.get()}};
  std::set<std::string_view> out;
  for (const Finding& f : diagnose(suite_scene(scene), *candidate, references).findings) {
    for (const std::string& cause : f.causes) out.insert(name_by_words(cause));
  }
  return out;
}

struct Proof {
  const char *fault, *scene, *cause;
};
constexpr Proof kProofs[] = {
    {"attributes.affine", "fog/cut", "attributes.affine"},
    {"attributes.wrong_corners", "texture/borders_at_centres", "attributes.outer_corners_swapped"},
    {"attributes.first_corners_swapped", "texture/borders_at_centres", "attributes.first_corners_swapped"},
    {"attributes.last_corners_swapped", "texture/borders_at_centres", "attributes.last_corners_swapped"},
    {"depth.of_first_corner", "depth/interpenetrating", "depth.of_first_corner"},
    {"notes.004.delete_behind_view_plane", "phong/separate_on_a_floor", "clip.cut_dropped"},
    {"clip.no_far_plane", "antialias/taps_fog_cut", "clip.far_not_cut"},
    {"clip.first_vertex_provokes", "notes/gzrender_on_centres", "clip.first_vertex_provokes"},
    {"clip.no_near_plane", "clip/corners_on_planes", "clip.near_not_cut"},
    {"clip.attributes_not_cut", "alpha_test/bands", "clip.not_interpolated"},
    {"clip.corner_lost", "alpha_test/bands", "clip.vertex_lost"},
    {"coverage.box_one_short", "notes/games101_on_centres", "coverage.box_one_short"},
    {"coverage.at_corner", "alpha_test/bands", "coverage.half_pixel_more"},
    {"coverage.inclusive_edges", "antialias/samples_ties", "coverage.inclusive_edges"},
    {"coverage.scissor_inclusive", "scissor/rows_from_top", "coverage.scissor_inclusive"},
    {"notes.000.strict_edges", "alpha_test/functions_rgba12", "coverage.strict_edges"},
    {"coverage.small_dropped", "coverage/dots", "coverage.small_dropped"},
    {"coverage.top_for_bottom", "antialias/samples_ties", "coverage.wrong_corner"},
    {"depth.of_centre", "antialias/samples_cut", "depth.of_centre"},
    {"depth.offset_sign", "polygon_offset/clamped", "depth.offset_negated"},
    {"depth.offset_without_slope", "polygon_offset/clamped", "depth.offset_without_slope"},
    {"depth.truncated", "alpha_test/bands", "depth.truncated"},
    {"light.no_attenuation", "light/all_at_once", "light.attenuation_left_out"},
    {"light.no_color_material", "light/all_at_once", "light.color_material_ignored"},
    {"light.cones_ignored", "light/all_at_once", "light.cones_ignored"},
    {"notes.000.no_clamp_of_n_l", "light/turned_away", "light.negative_not_clamped"},
    {"light.reflection_for_half_vector", "lines/flat_and_lit", "light.reflection_for_half_vector"},
    {"light.far_viewer", "light/all_at_once", "light.viewer_turned"},
    {"light.world_space", "lines/flat_and_lit", "light.world_space"},
    {"matrices.degrees_for_radians", "light/turned_away", "matrices.degrees_for_radians"},
    {"matrices.depth_range_not_mapped", "depth_range/clamped", "matrices.depth_range_not_mapped"},
    {"matrices.fov_horizontal", "alpha_test/bands", "matrices.fov_horizontal"},
    {"matrices.near_far_swapped", "alpha_test/bands", "matrices.near_far_swapped"},
    {"matrices.rotation_sign", "light/turned_away", "matrices.rotations_reversed"},
    {"matrices.transforms_reversed", "light/turned_away", "matrices.transforms_reversed"},
    {"merge.color_mask_ignored", "stencil/funcs", "merge.color_mask_ignored"},
    {"merge.factors_swapped", "alpha_test/before_blending", "merge.factors_swapped"},
    {"merge.logic_op_sides", "logic_op/gradients", "merge.logic_op_sides"},
    {"merge.blue_first", "alpha_test/bands", "merge.red_blue_swapped"},
    {"merge.truncated", "alpha_test/bands", "merge.truncated"},
    {"resolve.truncated", "antialias/samples_beyond_rgba8", "resolve.truncated"},
    {"shade.no_color_sum", "light/separate_reflection", "shade.no_color_sum"},
    {"texture.bias_left_out", "texture/floor_bias_up", "texture.bias_left_out"},
    {"texture.clamp_for_repeat", "texture/constant_row", "texture.clamp_for_repeat"},
    {"texture.half_texel_off", "texture/borders_at_centres", "texture.half_texel_off"},
    {"texture.s_for_t", "texture/floor_bias_down", "texture.s_t_swapped"},
    {"texture.t_flipped", "phong/separate_on_a_floor", "texture.t_flipped"},
    {"vertex.normals_by_model_view", "camera/mirrored", "vertex.normals_by_model_view"},
    {"vertex.not_renormalised", "alpha_test/leaves", "vertex.not_renormalised"},
    {"visibility.alpha_at_reference", "alpha_test/bands", "visibility.alpha_at_reference"},
    {"visibility.no_alpha_test", "alpha_test/bands", "visibility.alpha_test_ignored"},
    {"visibility.greater_for_less", "alpha_test/bands", "visibility.depth_reversed"},
    {"visibility.less_equal", "camera/scales_apart", "visibility.less_equal"},
    {"visibility.stencil_ops_swapped", "stencil/sixteen_bit", "visibility.stencil_ops_swapped"},
    {"window.other_side_culled", "blend/together", "window.cull_other_face"},
    {"window.mode_of_other_face", "polygon_mode/blended", "window.mode_of_other_face"},
    {"window.snap_truncates", "alpha_test/bands", "window.snap_truncates"},
    {"window.y_flipped", "alpha_test/bands", "window.y_flipped"},
};

TEST(Causes, AFaultOfThePipelineIsNamedAndNoOther) {
  std::set<std::string_view> proven;
  for (std::size_t i = 0; i < std::size(kProofs); i += one_of(3)) {
    const Proof& p = kProofs[i];
    EXPECT_EQ(causes_of(p.fault, p.scene), std::set<std::string_view>{p.cause}) << p.fault << " on " << p.scene;
    proven.insert(p.cause);
  }
  EXPECT_GE(proven.size(), 54u / one_of(3));
}

TEST(Causes, SayNothingWhereNoPatternFits) {
  for (const Proof& p : {Proof{"shade.fogged_alpha", "fog/cut", ""},
                         Proof{"texture.levels_swapped", "texture/floor_nearest_mipmap_linear", ""},
                         Proof{"depth.at_corner", "notes/tinyrenderer_floor", ""},
                         Proof{"clip.winding_reversed", "clip/corners_on_planes", ""}}) {
    EXPECT_EQ(causes_of(p.fault, p.scene), std::set<std::string_view>{}) << p.fault;
  }
}

// A bug that a known cause puts into the stage is found again, and on some scene it alone is.
TEST(Causes, EachThatCanBeMadeIsTold) {
  const auto exact = exact::make_exact();
  const auto ours = pipeline::make_pipeline();
  std::set<std::string_view> open, alone;
  for (const KnownCause& h : all_causes()) {
    if (h.shows == nullptr) open.insert(h.name);
  }
  for (const char* name : {"camera/transform_chain",
                           "cull/both_windings",
                           "texture/wall_clamp_to_edge",
                           "texture/wall_clamp_to_border",
                           "texture/wall_mirrored_repeat",
                           "texture/wall_mirrored_nearest",
                           "texture/floor_bias_up",
                           "alpha_test/cutout",
                           "texture/dialect_gzrender",
                           "depth_range/halves_z16",
                           "interpolation/w_ratio",
                           "light/all_at_once",
                           "light/eight_spots",
                           "light/separate_two_sided",
                           "light/color_material",
                           "antialias/samples_blend",
                           "polygon_mode/each_face",
                           "polygon_offset/decals_z16",
                           "coverage/shared_edges",
                           "texture/floor_bias_down",
                           "texture/environment_rgba",
                           "antialias/samples_textured",
                           "fog/backwards",
                           "light/separate_specular",
                           "depth/ties",
                           "depth/functions",
                           "depth/on_clear",
                           "light/emission",
                           "light/two_sided_gouraud",
                           "light/local_viewer",
                           "light/highlight_reflection",
                           "fog/exp2",
                           "scissor/windows",
                           "masks/no_depth",
                           "alpha_test/functions_rgba8",
                           "alpha_test/bands",
                           "stencil/everything",
                           "blend/equations",
                           "logic_op/gradients",
                           "masks/sixteen"}) {
    const Scene scene = passes_of(suite_scene(name))[0];
    const Capture in = ours->capture(scene, {.records = StageSet::all()});
    for (const KnownCause& h : all_causes()) {
      if (alone.contains(h.name) || h.shows != nullptr || (h.stage == Stage::texture && !textured(scene))) continue;
      Capture wrong = in;
      copy_stage(h.stage, {}, wrong);
      try {
        Capture made = made_with(h, scene, wrong, *exact);
        round_to_formats(scene, h.stage, made);
        copy_stage(h.stage, made, wrong);
      } catch (const std::exception&) {
        continue;  // exact refuses it on this scene
      }
      const Capture expected = exact->run_stage(scene, h.stage, wrong);
      const std::vector<Cause> causes = likely_causes({scene, h.stage, wrong, expected, exact.get()});
      if (causes.empty()) continue;  // changes nothing here
      EXPECT_EQ(std::ranges::count(causes, h.name, &Cause::name), 1) << h.name << " on " << name;
      open.erase(h.name);
      if (causes.size() == 1) alone.insert(h.name);
    }
  }
  for (const std::string_view name : open) ADD_FAILURE() << name << " is never told";
  for (const KnownCause& h : all_causes()) {
    EXPECT_TRUE(h.shows != nullptr || alone.contains(h.name)) << h.name << " is nowhere told from others";
  }
}

// Matrices and vertices in fixed point of 16 fraction bits. Numbers of 20 fraction bits are no sign of it.
TEST(Causes, FixedPointIsToldByItsNumbers) {
  const auto exact = exact::make_exact();
  const auto causes = [&](Stage stage, double unit, const char* name = "camera/transform_chain", double off = 0) {
    const Scene scene = suite_scene(name);
    Capture in = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
    const auto round = [=](auto& v) { v = glm::round(v / unit) * unit; };
    for (Matrices<double>& m : in.records.matrices) {
      for (int column = 0; stage == Stage::matrices && column < 4; ++column)
        round(m.model_view[column]), round(m.projection[column]);
    }
    for (Vertex<double>& v : in.records.vertices) round(v.p_eye), round(v.p_clip), v.p_eye.x += off;
    const Capture expected = exact->run_stage(scene, stage, in);
    std::set<std::string_view> out;
    for (const Cause& c : likely_causes({scene, stage, in, expected, exact.get()})) out.insert(c.name);
    return out;
  };
  using Names = std::set<std::string_view>;
  EXPECT_EQ(causes(Stage::matrices, 0x1p-16), Names{"matrices.fixed_point"});
  EXPECT_EQ(causes(Stage::vertex, 0x1p-16), Names{"vertex.fixed_point"});
  EXPECT_EQ(causes(Stage::matrices, 0x1p-16, "texture/floor_nearest"), Names{"matrices.fixed_point"});
  EXPECT_EQ(causes(Stage::vertex, 0x1p-16, "camera/transform_chain", 0.25), Names{}) << "numbers of another mistake";
  EXPECT_EQ(causes(Stage::matrices, 0x1p-20), Names{});
  EXPECT_EQ(causes(Stage::vertex, 0x1p-20), Names{});
}

// A renderer that declares who owns samples on shared edges: both triangles, and neither has one; or neither, and both
// have them.
TEST(Causes, OfDifferencesOnEdgesGoByTheDeclaredRule) {
  using Rule = Conventions::TieRule;
  const auto exact = exact::make_exact();
  const Scene scene = suite_scene("coverage/on_centres");
  const auto inclusive = pipeline::make_pipeline(faults::named("coverage.inclusive_edges").stages());
  const auto causes = [&](Rule rule, bool is_cracked) {
    Capture mine = inclusive->capture(scene, {.records = StageSet::all()});
    Records<double>& r = mine.records;
    const auto is_tie = [&](const Covered& c) {
      return on_an_edge(r.triangles[c.triangle], {c.x, c.y}, {}) && mine.planes.count(c.x, c.y) == 2;
    };
    if (is_cracked) std::erase_if(r.covered, is_tie);
    FragmentSums sums = fragment_sums(r.covered, r.triangles, mine.width, mine.height);
    mine.planes.count = std::move(sums.count), mine.planes.id_sum = std::move(sums.id_sum);
    Conventions declared;
    declared.tie_rule = rule;
    const Capture expected = run_by_conventions(*exact, scene, Stage::coverage, mine, declared);
    std::set<std::string_view> out;
    for (const Cause& c : likely_causes({scene, Stage::coverage, mine, expected, exact.get(), declared, true}))
      out.insert(c.name);
    return out;
  };
  using Names = std::set<std::string_view>;
  EXPECT_EQ(causes(Rule::inclusive, false), Names{});
  EXPECT_EQ(causes(Rule::inclusive, true), Names{"coverage.unlike_declared_rule"});
  EXPECT_EQ(causes(Rule::exclusive, false), Names{"coverage.unlike_declared_rule"});
  EXPECT_EQ(causes(Rule::left_bottom, false), Names{"coverage.inclusive_edges"});
}

// A frame of one row, out of which several mistakes move all samples.
TEST(Causes, NoneIsNamedWhereNothingIsLeft) {
  const auto exact = exact::make_exact();
  const Scene scene = suite_scene("frame/row");
  Capture wrong = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
  copy_stage(Stage::coverage, {}, wrong);
  wrong.planes.count = Plane<std::uint32_t>(wrong.width, wrong.height, 0);
  wrong.planes.id_sum = Plane<std::uint64_t>(wrong.width, wrong.height, 0);
  const Capture expected = exact->run_stage(scene, Stage::coverage, wrong);
  const std::vector<Cause> causes = likely_causes({scene, Stage::coverage, wrong, expected, exact.get()});
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].name, "nothing_left");
}

}  // namespace
}  // namespace plumbline::check
