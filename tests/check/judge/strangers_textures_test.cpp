// Renderers of others whose textures and polygon offsets go by conventions that OpenGL leaves open, judged by their
// records.
#include <memory>
#include <string>

#include "reference/arithmetic/texture.h"
#include "renderers/pipeline_renderer.h"
#include "scene/draw_index.h"
#include "tests/check/fixtures.h"
#include "tests/check/judge/row_of.h"
#include "tests/learn/drawn_otherwise.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

using C = Conventions;

Capture drawn_by(const Scene& scene, decltype(pipeline::Stages::texture) texture) {
  pipeline::Stages stages = pipeline::production_stages();
  stages.texture = texture;
  return pipeline::make_pipeline(stages)->capture(scene, {.records = StageSet::all()});
}

void lose_levels(Capture& candidate) {
  for (Texel<double>& texel : candidate.records.texels) texel.lod = kNaN;
}

// The candidate with its levels of detail, and without, by the declared convention and by OpenGL's.
void expect_right_if_declared(const Scene& scene, Capture candidate, const C& declared) {
  SCOPED_TRACE(scene.name);
  EXPECT_EQ(row_of_stage(scene, candidate, Stage::texture, C()).outcome, Outcome::different);
  EXPECT_TRUE(holds(row_of_stage(scene, candidate, Stage::texture, declared).outcome));
  lose_levels(candidate);
  EXPECT_TRUE(holds(row_of_stage(scene, candidate, Stage::texture, declared).outcome));
}

TEST(StrangersTextures, ALevelOfDetailMayBeApproximatedWhereThatIsDeclared) {
  C declared;
  declared.level_of_detail = C::LevelOfDetail::approximate;
  for (const char* name : {"texture/floor_linear_mipmap_linear", "texture/floor_nearest"}) {
    const Scene scene = suite_scene(name);
    Capture candidate = drawn_by(scene, test::by_largest_rho);
    expect_right_if_declared(scene, candidate, declared);
    declared.level_of_detail = C::LevelOfDetail::per_square;
    EXPECT_EQ(row_of_stage(scene, candidate, Stage::texture, declared).outcome, Outcome::different)
        << "beyond a square's";
    declared.level_of_detail = C::LevelOfDetail::approximate;
    candidate.records.texels[40].lod += 1.25;
    EXPECT_EQ(row_of_stage(scene, candidate, Stage::texture, declared).outcome, Outcome::different)
        << "beyond OpenGL's limit";
  }
}

TEST(StrangersTextures, MagnificationMayEndAtZeroWhereThatIsDeclared) {
  C declared;
  declared.magnified = C::Magnified::up_to_zero;
  const Scene scene = suite_scene("texture/wall_switch_over");
  expect_right_if_declared(scene, drawn_by(scene, test::magnified_up_to_zero), declared);
}

TEST(StrangersTextures, EitherLevelIsNearestHalfWayWhereThatIsDeclared) {
  C declared;
  declared.half_way_level = C::HalfWay::either;
  const Scene scene = suite_scene("texture/half_way_levels");
  const Capture candidate = drawn_by(scene, test::half_way_up);
  expect_right_if_declared(scene, candidate, declared);
  const Capture ours = drawn_by(scene, pipeline::production_stages().texture);
  EXPECT_TRUE(holds(row_of_stage(scene, ours, Stage::texture, declared).outcome)) << "the finer is either, too";
}

TEST(StrangersTextures, WeightsHaveTheDeclaredBits) {
  C declared;
  declared.texture_bits = 6;
  const Scene scene = suite_scene("texture/board_linear");
  const Capture candidate = drawn_by(scene, test::weights_of_bits<>);
  expect_right_if_declared(scene, candidate, declared);
  declared.texture_bits = 9;
  EXPECT_EQ(row_of_stage(scene, candidate, Stage::texture, declared).outcome, Outcome::different);
}

TEST(StrangersTextures, APolygonOffsetHasTheDeclaredUnit) {
  const Scene scene = suite_scene("polygon_offset/steps");
  const Capture ours = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
  const Capture candidate =
      pipeline::make_pipeline()->capture(test::with_half_of_offsets(scene), {.records = StageSet::all()});
  C declared;
  declared.offset_unit = {1, 1};
  EXPECT_EQ(row_of_stage(scene, candidate, Stage::depth, C()).outcome, Outcome::different);
  EXPECT_TRUE(holds(row_of_stage(scene, candidate, Stage::depth, declared).outcome));
  EXPECT_EQ(row_of_stage(scene, ours, Stage::depth, declared).outcome, Outcome::different);
}

// Texels of the candidate's fragments at texture coordinates that are off by a share of themselves.
Capture sampled_off_by(const Scene& scene, Capture candidate, double share) {
  const DrawIndex draws(scene);
  Records<double>& r = candidate.records;
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    const Draw* draw = draws.draw(r.triangles[r.covered[i].triangle].primitive);
    if (!draw->texture) continue;
    const Vec2<double> st = (1 + share) * Vec2<double>(r.varyings[Varying::texture].fragments[i]);
    r.texels[i].color =
        math::filtered_texel(scene.textures.at(draw->texture->texture), st, r.texels[i].lod, math::level_rules(C()));
  }
  return candidate;
}

// t = 0.145833328 of 48 rows is 7 in float, 6.99999974 in double: another row.
TEST(StrangersTextures, TexelCoordinatesMayBeComputedInFloat) {
  for (const char* name : {"texture/borders_at_centres", "texture/wall_repeat"}) {
    SCOPED_TRACE(name);
    const Scene scene = suite_scene(name);
    const Capture ours = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
    for (const double share : {3 * kU, -3 * kU})
      EXPECT_NE(row_of_stage(scene, sampled_off_by(scene, ours, share), Stage::texture, C()).outcome,
                Outcome::different);
    EXPECT_EQ(row_of_stage(scene, sampled_off_by(scene, ours, 1e-4), Stage::texture, C()).outcome, Outcome::different);
    Capture lost = sampled_off_by(scene, ours, 3 * kU);
    lose_levels(lost);
    EXPECT_TRUE(holds(row_of_stage(scene, lost, Stage::texture, C()).outcome));
  }
}

TEST(StrangersTextures, ALevelOfDetailMayBeComputedInFloat) {
  const Scene scene = suite_scene("texture/floor_linear");
  const auto off_by = [&](double lod) {
    Capture out = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
    for (Texel<double>& texel : out.records.texels) texel.lod += lod;
    return row_of_stage(scene, sampled_off_by(scene, out, 0), Stage::texture, C()).outcome;
  };
  EXPECT_NE(off_by(16 * kU), Outcome::different);
  EXPECT_EQ(off_by(0.01), Outcome::different);
}

}  // namespace
}  // namespace plumbline::check
