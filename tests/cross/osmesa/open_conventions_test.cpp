// Renderers of others whose textures and polygon offsets go by conventions that OpenGL leaves open: right by every
// reference where they declare them.
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "check/judge/judge.h"
#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"
#include "renderers/pipeline_renderer.h"
#include "tests/learn/drawn_otherwise.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

using C = Conventions;

// Texture stage, if another than ours, and whether polygon offsets are half of ours.
struct Difference {
  decltype(pipeline::Stages::texture) texture = nullptr;
  bool half_offsets = false;
};

// Our renderer as a foreign one, of the declared conventions.
class ForeignRenderer : public Renderer {
 public:
  ForeignRenderer(pipeline::Stages stages, bool half_offsets, C declared)
      : inner_(pipeline::make_pipeline(stages)), half_offsets_(half_offsets), declared_(declared) {}
  RendererInfo info() const override {
    RendererInfo out = inner_->info();
    out.profile = Profile::foreign;
    out.painters.clear();
    out.conventions = declared_;
    for (Ability& ability : out.stages) ability.runs = false;
    return out;
  }
  Capture capture(const Scene& scene, const Request& request) override {
    return inner_->capture(half_offsets_ ? test::with_half_of_offsets(scene) : scene, request);
  }

 private:
  std::unique_ptr<Renderer> inner_;
  bool half_offsets_;
  C declared_;
};

// Number of rows that fail.
int failures(const std::string& name, const Difference& difference, const C& declared) {
  const Scene scene = suite_scene(name);
  pipeline::Stages stages = pipeline::production_stages();
  if (difference.texture != nullptr) stages.texture = difference.texture;
  ForeignRenderer candidate(stages, difference.half_offsets, declared);
  const auto osmesa = make_opengl();
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"osmesa", osmesa.get()}, {"exact", exact.get()}};
  int failed = 0;
  for (const check::Comparison& c : check::judge(scene, candidate, references).comparisons) {
    failed += check::is_failure(c.outcome);
    if (check::is_failure(c.outcome) && !(declared == C()))
      ADD_FAILURE() << name << ": " << name_of(c.stage) << ", " << title_of(c.judge) << ": " << c.measurement.differing
                    << " differ, worst " << c.measurement.worst.difference << ' ' << c.measurement.unit << ' '
                    << c.note;
  }
  return failed;
}

void expect_right_if_declared(const std::string& name, const Difference& difference, const C& declared) {
  EXPECT_EQ(failures(name, difference, declared), 0) << name;
  EXPECT_GT(failures(name, difference, C()), 0) << name;
}

TEST(OpenConventions, LevelsOfDetailMayBeApproximated) {
  C declared;
  declared.level_of_detail = C::LevelOfDetail::approximate;
  expect_right_if_declared("texture/floor_linear_mipmap_linear", {test::by_largest_rho}, declared);
  expect_right_if_declared("texture/floor_linear_mipmap_nearest", {test::by_largest_rho}, declared);
}

TEST(OpenConventions, MagnificationMayEndAtZero) {
  C declared;
  declared.magnified = C::Magnified::up_to_zero;
  expect_right_if_declared("texture/wall_switch_over", {test::magnified_up_to_zero}, declared);
}

TEST(OpenConventions, EitherLevelMayBeNearestHalfWay) {
  C declared;
  declared.half_way_level = C::HalfWay::either;
  expect_right_if_declared("texture/half_way_levels", {test::half_way_up}, declared);
}

TEST(OpenConventions, WeightsMayHaveFewBits) {
  C declared;
  for (const int bits : {6, 8}) {  // 8 is what plumb learn finds (learn_textures_test.cpp)
    declared.texture_bits = bits;
    expect_right_if_declared("texture/board_linear", {test::weights_of_bits<>}, declared);
  }
}

TEST(OpenConventions, APolygonOffsetsUnitMayBeOneCode) {
  C declared;
  declared.offset_unit = {1, 1};
  expect_right_if_declared("polygon_offset/steps", {nullptr, true}, declared);
}

}  // namespace
}  // namespace plumbline
