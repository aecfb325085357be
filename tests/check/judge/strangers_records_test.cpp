// Records of renderers whose colours are codes before they are merged, or are interpolated otherwise than other
// attributes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "tests/check/judge/frame_verdict.h"
#include "tests/check/judge/row_of.h"
#include "tests/learn/other_colors.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

using C = Conventions;

C in_codes(C::Rounding rounding = C::Rounding::nearest) {
  C out;
  out.fragment_colors = C::ColorNumbers::in_codes;
  out.color_rounding = rounding;
  return out;
}

Capture records_of(const Scene& scene, const pipeline::Stages& stages) {
  return pipeline::make_pipeline(stages)->capture(scene, {.records = StageSet::all()});
}

// Whether the row of a stage is judged and holds where stages_in_codes()' records are changed.
bool holds(const std::string& name, Stage stage, const C& conventions, const std::function<void(Capture&)>& change) {
  const Scene scene = suite_scene(name);
  Capture capture = records_of(scene, test::stages_in_codes());
  change(capture);
  const Comparison row = row_of_stage(scene, capture, stage, conventions);
  EXPECT_TRUE(was_compared(row)) << name;
  return check::holds(row.outcome);
}

// Each colour c becomes whole(255 c + by) / 255.
template <class Whole>
auto rounded(Whole whole, double by) {
  return [=](Vec4<double>& color) {
    for (int k = 0; k < 4; ++k) color[k] = whole(255 * color[k] + by) / 255;
  };
}
constexpr auto kNearest = [](double v) { return std::nearbyint(v); };
constexpr auto kDown = [](double v) { return std::floor(v); };
constexpr auto kNone = [](double v) { return v; };

TEST(StrangersRecords, InterpolatedColorsMayBeCodes) {
  const auto drawn = [](auto to_codes, const C& conventions) {
    return holds("interpolation/ramps", Stage::attributes, conventions, [=](Capture& capture) {
      for (Attributes<double>& a : capture.records.attributes) to_codes(a.color);
    });
  };
  EXPECT_TRUE(drawn(rounded(kNearest, 0), in_codes()));
  EXPECT_TRUE(drawn(rounded(kNone, 0), in_codes())) << "records may come before the rounding";
  EXPECT_TRUE(drawn(rounded(kDown, 0), in_codes(C::Rounding::down)));
  EXPECT_FALSE(drawn(rounded(kNearest, 0), C()));
  EXPECT_FALSE(drawn(rounded(kDown, 0), in_codes()));
  EXPECT_FALSE(drawn(rounded(kNone, 0.51), in_codes()));
  EXPECT_FALSE(drawn(rounded(kNone, 0.01), in_codes(C::Rounding::down)));
  EXPECT_FALSE(drawn(rounded(kNone, -1.01), in_codes(C::Rounding::down)));
  EXPECT_FALSE(drawn([](Vec4<double>& color) { color.x = NAN; }, in_codes()));
}

// Colours of lines that are extrapolated leave [0,1], where codes end.
TEST(StrangersRecords, InterpolatedColorsAreClampedToCodes) {
  const auto drawn = [](double most) {
    return holds("lines/steep_w", Stage::attributes, in_codes(), [=](Capture& capture) {
      for (Attributes<double>& a : capture.records.attributes) {
        rounded(kNearest, 0)(a.color);
        a.color = glm::clamp(a.color, Vec4<double>(0), Vec4<double>(most));
      }
    });
  };
  EXPECT_TRUE(drawn(1));
  EXPECT_FALSE(drawn(0.9));
}

// Colours of vertices become codes after the records of corners, or before.
TEST(StrangersRecords, InterpolatedColorsMayBeBetweenCodes) {
  C vertices;
  vertices.vertex_colors = C::ColorNumbers::in_codes;
  const Scene scene = suite_scene("light/sphere_gouraud");
  const Capture drawn = test::make_vertices_in_codes()->capture(scene, {.records = StageSet::all()});
  Capture before = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
  before.records.attributes = drawn.records.attributes;
  const auto is_held = [&](const Capture& capture, double off, const C& conventions) {
    Capture moved = capture;
    for (Attributes<double>& a : moved.records.attributes) a.color.x += off / 255;
    return check::holds(row_of_stage(scene, moved, Stage::attributes, conventions).outcome);
  };
  EXPECT_TRUE(is_held(drawn, 0, vertices));
  EXPECT_FALSE(is_held(drawn, 0.1, vertices)) << "corners that are codes are not rounded again";
  EXPECT_TRUE(is_held(before, 0, vertices));
  EXPECT_FALSE(is_held(before, 0, C()));
  EXPECT_FALSE(is_held(before, 1.1, vertices));
}

TEST(StrangersRecords, TexelsMayBeCodes) {
  const auto drawn = [](const char* scene, double by, const C& conventions) {
    return holds(scene, Stage::texture, conventions, [=](Capture& capture) {
      for (Texel<double>& texel : capture.records.texels) rounded(kNone, by)(texel.color);
    });
  };
  EXPECT_TRUE(drawn("texture/floor_modulated", 0, in_codes())) << "codes already";
  EXPECT_FALSE(drawn("texture/floor_modulated", 0, C()));
  EXPECT_FALSE(drawn("texture/floor_modulated", 1.01, in_codes()));
  EXPECT_FALSE(drawn("texture/floor_modulated", -1.01, in_codes()));
  EXPECT_TRUE(drawn("texture/board_nearest", 0, in_codes()));
  EXPECT_FALSE(drawn("texture/board_nearest", 0.1, in_codes())) << "texels that are codes are not rounded";
  EXPECT_TRUE(drawn("texture/board_nearest", -1, in_codes(C::Rounding::down))) << "a code less float's error";
  EXPECT_FALSE(drawn("texture/board_nearest", 1, in_codes(C::Rounding::down)));
}

TEST(StrangersRecords, ShadedColorsMayBeCodes) {
  const auto drawn = [](const char* scene, double by, const C& conventions) {
    return holds(scene, Stage::shade, conventions, [=](Capture& capture) {
      for (Shaded<double>& shaded : capture.records.shaded) rounded(kNone, by)(shaded.color);
    });
  };
  for (const char* scene : {"texture/floor_modulated", "texture/vertex_colors_flat", "fog/exp", "blend/halves"})
    EXPECT_TRUE(drawn(scene, 0, in_codes())) << scene;
  EXPECT_FALSE(drawn("texture/floor_modulated", 0, C()));
  EXPECT_FALSE(drawn("texture/floor_modulated", 2, in_codes()));
  EXPECT_FALSE(drawn("texture/floor_modulated", -2, in_codes()));
  EXPECT_FALSE(drawn("blend/halves", 1.01, in_codes())) << "rounded once";
  EXPECT_FALSE(holds("fog/exp", Stage::shade, in_codes(), [](Capture& capture) {
    for (Shaded<double>& shaded : capture.records.shaded) shaded.color.a -= 1.1 / 255;
  })) << "fog leaves alpha as it is";
}

TEST(StrangersRecords, ColorsAloneMayBeAffine) {
  C affine;
  affine.color_interpolation = C::ColorInterpolation::affine;
  Scene scene = test::narrow_floor();
  scene.meshes[0].colors = {{1, 0.2f, 0.2f, 1}, {1, 0.2f, 0.2f, 1}, {0.2f, 1, 1, 1}, {0.2f, 1, 1, 1}};
  pipeline::Stages stages = pipeline::production_stages();
  stages.attributes = test::affine_in_part<true>;
  const auto is_held = [&](const pipeline::Stages& drawn, const C& conventions) {
    const Comparison row = row_of_stage(scene, records_of(scene, drawn), Stage::attributes, conventions);
    EXPECT_TRUE(was_compared(row));
    return check::holds(row.outcome);
  };
  EXPECT_TRUE(is_held(stages, affine));
  EXPECT_FALSE(is_held(stages, C()));
  EXPECT_FALSE(is_held(pipeline::production_stages(), affine));
}

}  // namespace
}  // namespace plumbline::check
