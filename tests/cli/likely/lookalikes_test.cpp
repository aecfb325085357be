// Known faults that draw a frame: by the conventions given, and by the pixels that are not legal.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "capture/by_conventions.h"
#include "cli/likely/lookalikes.h"
#include "cli/options/renderers.h"
#include "scene/file/scene_file.h"

namespace plumbline::cli {

namespace {

Scene scene_of(std::string_view name) {
  return load_scene(std::string(PLUMBLINE_SOURCE_DIR "/tests/scenes/").append(name), {});
}

GivenFrame drawn(const Scene& scene, const std::string& fault, const Conventions& conventions = undeclared(),
                 CutAt cut_at = CutAt::frame_sides) {
  const SceneByConventions seen(scene, conventions);
  Request request;
  request.planes = WantedPlanes::picture;
  const Planes planes = make_candidate(fault, cut_at)->capture(*seen, request).planes;
  return {{planes.color, planes.depth}, conventions, {}};
}

// Marks a part of the picture, and says that it is legal; `is_legal` is 0 elsewhere.
void mark(GivenFrame& given, std::size_t pixels) {
  given.is_legal = Plane<std::uint8_t>(given.color.width(), given.color.height(), 0);
  for (std::size_t i = 0; i < pixels; ++i) {
    given.color.values()[i] = glm::vec4(0.3f, 0.6f, 0.9f, 1);
    given.is_legal.values()[i] = 1;
  }
}

TEST(Lookalikes, NoneOfTheRightFrame) {
  const Scene scene = scene_of("interpolation/w_ratio.json");
  const Lookalikes found = lookalikes(scene, drawn(scene, ""));
  EXPECT_EQ(found.apart, 0u);
  EXPECT_EQ(found.likely, "");
}

TEST(Lookalikes, NameTheFaultThatDrawsTheFrame) {
  const Scene scene = scene_of("interpolation/w_ratio.json");
  for (const char* fault : {"attributes.next_corner", "attributes.corner_before", "attributes.wrong_corners",
                            "attributes.first_corners_swapped", "attributes.last_corners_swapped", "attributes.affine",
                            "depth.in_perspective"}) {
    const Lookalikes found = lookalikes(scene, drawn(scene, fault));
    EXPECT_TRUE(found.likely.ends_with(std::string("(fault ") + fault + ")")) << fault << "\n" << found.text;
    EXPECT_TRUE(found.whole) << fault;
    for (const std::string& tie : found.ties) EXPECT_NE(tie.find("(fault notes."), tie.npos) << fault << " or " << tie;
  }
}

// Gamma 1/2.2 and sRGB are more than a code apart in dark colours.
TEST(Lookalikes, KnowArraysAndEncodingsThatAFileMayHold) {
  const Scene square = scene_of("depth/ties_less.json"), ramp = scene_of("interpolation/w_ratio.json");
  ASSERT_EQ(square.frame.width, square.frame.height);
  const GivenFrame right = drawn(square, "");
  GivenFrame transposed = right, gamma = drawn(ramp, "");
  for (int y = 0; y < square.frame.height; ++y) {
    for (int x = 0; x < square.frame.width; ++x)
      transposed.color(x, y) = right.color(y, x), transposed.depth(x, y) = right.depth(y, x);
  }
  for (glm::vec4& color : gamma.color.values()) {
    for (int i = 0; i < 3; ++i) color[i] = std::pow(color[i], 1 / 2.2f);
  }
  EXPECT_EQ(lookalikes(square, transposed).likely, "file (fault file.transposed)");
  EXPECT_EQ(lookalikes(ramp, gamma).likely, "file (fault file.gamma)");
}

// Depths between snapped corners, or of another arithmetic, are a little off everywhere.
TEST(Lookalikes, CountByColourAloneWhereDepthsAreLikeNoFaults) {
  const Scene scene = scene_of("light/sphere_gouraud.json");
  for (const char* fault : {"window.y_flipped", "light.ambient_per_light"}) {
    GivenFrame given = drawn(scene, fault);
    EXPECT_FALSE(lookalikes(scene, given).by_color) << fault;
    for (double& z : given.depth.values()) z += z < 1 ? 1e-4 : 0;
    const Lookalikes found = lookalikes(scene, given);
    EXPECT_TRUE(found.likely.ends_with(std::string("(fault ") + fault + ")")) << fault << "\n" << found.text;
    EXPECT_TRUE(found.by_color) << fault;
  }
}

TEST(Lookalikes, AlphaThatIsNotWrittenIsToldWhereThereIsOne) {
  const Scene scene = scene_of("interpolation/alpha_of_one_corner.json");
  GivenFrame given = drawn(scene, "merge.truncated");
  for (glm::vec4& color : given.color.values()) color.a = scene.frame.clear_color.a;
  given.has_alpha = true;
  EXPECT_EQ(lookalikes(scene, given).likely, "merge (fault merge.alpha_not_written)");
  given.has_alpha = false;
  EXPECT_EQ(lookalikes(scene, given).likely, "merge (fault merge.truncated)");
}

TEST(Lookalikes, SamplesOffTheCentreAreSoToEverySide) {
  const Scene scene = scene_of("coverage/fan.json");
  for (const auto& [by, side] :
       {std::pair(glm::dvec2(0.5, 0.5), "right and up\n"), {glm::dvec2(0, -0.5), "far down\n"}}) {
    Scene off = scene;
    off.frame.pass.shift += by;
    const Lookalikes found = lookalikes(scene, drawn(off, ""));
    EXPECT_EQ(found.likely, "window (fault window.sample_off_centre)") << found.text;
    EXPECT_TRUE(found.whole);
    EXPECT_NE(found.text.find(side), std::string::npos) << found.text;
  }
}

// Either alone leaves more than a tenth of the pixels.
TEST(Lookalikes, OfTwoFaultsAtOnceBothAreNamedInTheStagesOrder) {
  const Scene scene = scene_of("coverage/fan.json");
  const std::vector<std::string> faults = {"depth.one_per_triangle", "coverage.last_row_lost"};
  Request request;
  request.planes = WantedPlanes::picture;
  const Planes planes = make_candidate(faults)->capture(scene, request).planes;
  const Lookalikes found = lookalikes(scene, {{planes.color, planes.depth}, {}, {}});
  EXPECT_TRUE(found.together) << found.text;
  EXPECT_EQ(found.likely, "coverage (fault coverage.last_row_lost) and depth (fault depth.one_per_triangle)")
      << found.text;
  EXPECT_TRUE(found.whole) << found.text;
  EXPECT_FALSE(lookalikes(scene, drawn(scene, "coverage.last_row_lost")).together);
}

TEST(Lookalikes, WhatNoTwoFaultsDrawIsNotNamed) {
  const Scene scene = scene_of("coverage/six_orders.json");
  GivenFrame given = drawn(scene, "attributes.affine");
  mark(given, given.color.size() / 2);
  given.is_legal = {};
  const Lookalikes found = lookalikes(scene, given);
  EXPECT_FALSE(found.together) << found.text;
  EXPECT_EQ(found.likely, "");
}

// Two faults that exchange red and blue: of a triangle with a red, a green and a blue corner.
TEST(Lookalikes, OfSeveralStagesThatDrawOneFrameAllAreNamed) {
  Scene scene = scene_of("interpolation/ramps.json");
  Mesh& mesh = scene.meshes[0];
  mesh.triangles.resize(1);
  mesh.colors.assign(mesh.positions.size(), glm::vec4(0, 0, 0, 1));
  for (int k = 0; k < 3; ++k) mesh.colors[mesh.triangles[0][k]][k] = 1;
  scene.draws.resize(1);
  const Lookalikes found = lookalikes(scene, drawn(scene, "attributes.wrong_corners"));
  std::set<std::string> causes(found.ties.begin(), found.ties.end());
  causes.insert(found.likely);
  EXPECT_TRUE(causes.contains("attributes (fault attributes.wrong_corners)")) << found.text;
  EXPECT_GT(causes.size(), 1u) << found.text;
}

TEST(Lookalikes, AnEmptyFrameIsAsByAnyStage) {
  const Scene scene = scene_of("coverage/fan.json");
  Capture left;
  left.planes.color = Plane<glm::vec4>(scene.frame.width, scene.frame.height, scene.frame.clear_color);
  EXPECT_EQ(likely_faults(scene, left, {}, {}), std::vector<std::string>{"nothing of the scene is seen"});
  left.planes.color = drawn(scene, "").color;
  EXPECT_TRUE(likely_faults(scene, left, {}, {}).empty());
}

TEST(Lookalikes, APictureOnePixelOffIsSoToEverySide) {
  const Scene scene = scene_of("coverage/fan.json");
  const GivenFrame right = drawn(scene, "");
  for (const auto& [by, says] : {std::pair(glm::ivec2(-1, -1), "one pixel too far left and down"),
                                 {glm::ivec2(1, 0), "one pixel too far right\n"},
                                 {glm::ivec2(0, 1), "one pixel too far up\n"}}) {
    GivenFrame given = right;
    for (int y = 0; y < given.color.height(); ++y) {
      for (int x = 0; x < given.color.width(); ++x) {
        const int from_x = x - by.x, from_y = y - by.y;
        const bool inside = from_x >= 0 && from_y >= 0 && from_x < given.color.width() && from_y < given.color.height();
        given.color(x, y) = inside ? right.color(from_x, from_y) : scene.frame.clear_color;
        given.depth(x, y) = inside ? right.depth(from_x, from_y) : scene.frame.clear_depth;
      }
    }
    const Lookalikes found = lookalikes(scene, given);
    EXPECT_EQ(found.likely, "window (fault window.one_pixel_off)") << found.text;
    EXPECT_NE(found.text.find(says), std::string::npos) << found.text;
  }
}

TEST(Lookalikes, ADepthTestTurnedRoundWithItsClearDepth) {
  const Scene scene = scene_of("depth/interpenetrating.json");
  Scene turned = scene;
  turned.frame.clear_depth = 1 - turned.frame.clear_depth;
  for (Draw& draw : turned.draws) {
    ASSERT_EQ(draw.depth_func, DepthFunc::less);
    draw.depth_func = DepthFunc::greater;
  }
  EXPECT_EQ(lookalikes(scene, drawn(turned, "")).likely, "visibility (fault visibility.farthest_kept)");
}

TEST(Lookalikes, AreDrawnByTheConventions) {
  const Scene scene = scene_of("interpolation/w_ratio.json");
  Conventions at_corner;
  at_corner.sample = glm::dvec2(0);
  GivenFrame given = drawn(scene, "attributes.affine", at_corner);
  EXPECT_TRUE(lookalikes(scene, given).whole);
  EXPECT_EQ(lookalikes(scene, given).likely, "attributes (fault attributes.affine)");
  EXPECT_EQ(lookalikes(scene, drawn(scene, "", at_corner)).apart, 0u);
  given.conventions = {};
  EXPECT_FALSE(lookalikes(scene, given).whole);
}

// Faults by which nothing is drawn come near a picture of a few pixels, and are not its cause.
TEST(Lookalikes, DrawSomethingWhereSomethingIsDrawn) {
  const Scene scene = scene_of("interpolation/w_ratio.json");
  GivenFrame given = drawn(scene, "");
  std::size_t left = 0;
  for (std::size_t i = 0; i < given.color.size(); ++i) {
    const bool is_drawn = given.depth.values()[i] < scene.frame.clear_depth;
    if (!is_drawn || ++left <= 5) continue;
    given.color.values()[i] = scene.frame.clear_color;
    given.depth.values()[i] = scene.frame.clear_depth;
  }
  ASSERT_GT(left, 100u);
  const Lookalikes found = lookalikes(scene, given);
  EXPECT_EQ(found.text.find("window.facing_turned"), std::string::npos) << found.text;
}

// Truncation moves colours by up to a code: undeclared, it hides affine colours that are a code off.
TEST(Lookalikes, AreTruncatedWhereThatIsDeclared) {
  const std::vector<std::string> faults = {"merge.truncated", "attributes.affine"};
  Request request;
  request.planes = WantedPlanes::picture;
  std::size_t hidden = 0;
  for (const char* name : {"camera/needle.json", "light/emission.json", "light/normals_grown.json"}) {
    const Scene scene = scene_of(name);
    const Planes planes = make_candidate(faults)->capture(scene, request).planes;
    GivenFrame given{{planes.color, planes.depth}, {}, {}};
    hidden += lookalikes(scene, given).whole ? 0 : 1;
    given.conventions.color_rounding = Conventions::Rounding::down;
    const Lookalikes found = lookalikes(scene, given);
    EXPECT_EQ(found.likely, "attributes (fault attributes.affine)") << name << '\n' << found.text;
    EXPECT_TRUE(found.whole) << name;
  }
  EXPECT_GT(hidden, 0u) << "else nothing is tested";
}

// Attributes that are not in perspective are others where a polygon is cut.
TEST(Lookalikes, OfRenderersThatLeaveTheSidesToTheRaster) {
  const Scene scene = scene_of("clip/crowd.json");
  const GivenFrame kept = drawn(scene, "attributes.affine", {}, CutAt::guard_band);
  EXPECT_NE(kept.color.values(), drawn(scene, "attributes.affine").color.values()) << "else nothing is tested";
  const Lookalikes found = lookalikes(scene, kept);
  EXPECT_EQ(found.likely, "attributes (fault attributes.affine)") << found.text;
  EXPECT_TRUE(found.whole) << found.text;
}

TEST(Lookalikes, OfStagesThatAreRightOrOfDeclaredRoundingsAreNone) {
  const Scene scene = scene_of("interpolation/w_ratio.json");
  GivenFrame affine = drawn(scene, "attributes.affine");
  affine.right = {Stage::attributes};
  EXPECT_EQ(lookalikes(scene, affine).text.find("attributes."), std::string::npos) << lookalikes(scene, affine).text;
  // The viewport is a number of stage matrices, which the window stage applies.
  GivenFrame shrunk = drawn(scene, "matrices.viewport_one_short");
  shrunk.right = {Stage::matrices};
  EXPECT_EQ(lookalikes(scene, shrunk).likely, "matrices (fault matrices.viewport_one_short)");
  shrunk.right = {Stage::matrices, Stage::window};
  EXPECT_EQ(lookalikes(scene, shrunk).text.find("matrices."), std::string::npos);
  Conventions down;
  down.color_rounding = down.depth_rounding = Conventions::Rounding::down;
  const std::pair<const char*, const char*> kTruncated[] = {{"merge.truncated", "interpolation/ramps.json"},
                                                            {"depth.truncated", "interpolation/many_sided.json"}};
  for (const auto& [fault, name] : kTruncated) {
    const Scene of = scene_of(name);
    const Lookalikes undeclared = lookalikes(of, drawn(of, fault));
    EXPECT_TRUE(undeclared.likely.ends_with(std::string("(fault ") + fault + ")")) << undeclared.text;
    const Lookalikes declared = lookalikes(of, drawn(of, fault, down));
    EXPECT_EQ(declared.text.find(fault), std::string::npos) << declared.text;
  }
}

// Faults of two stages that draw one frame where depths are constant.
TEST(Lookalikes, OfAStageThatIsWrongByItselfComeFirst) {
  const Scene scene = scene_of("interpolation/ramps.json");
  GivenFrame given = drawn(scene, "window.next_values");
  EXPECT_EQ(lookalikes(scene, given).likely, "attributes (fault attributes.next_corner)");
  given.wrong = {Stage::window};
  EXPECT_EQ(lookalikes(scene, given).likely, "window (fault window.next_values)");
  given.wrong = {Stage::depth};
  EXPECT_EQ(lookalikes(scene, given).likely, "attributes (fault attributes.next_corner)") << "no such fault of depths";
  for (const Stage stage : {Stage::light, Stage::clip, Stage::coverage}) {
    given.wrong = {stage};
    EXPECT_EQ(lookalikes(scene, given).likely, "") << "nor of " << name_of(stage) << ", which is wrong";
  }
}

// Normals of draws with `normalize`: stage vertex judges their direction alone, of a stranger; stage light finds their
// length wrong.
TEST(Lookalikes, OfNormalsThatAreNotUnitAreNamedWhereLightIsWrong) {
  const Scene scene = scene_of("light/squeezed.json");
  GivenFrame given = drawn(scene, "vertex.not_renormalised");
  given.right = {Stage::vertex};
  EXPECT_EQ(lookalikes(scene, given).text.find("vertex."), std::string::npos);
  given.wrong = {Stage::light};
  EXPECT_EQ(lookalikes(scene, given).likely, "vertex (fault vertex.not_renormalised)");
}

// Depths of 16 bits, and a colour that differs legally: no fault of the colour explains the depths.
TEST(Lookalikes, OfLegalColorsExplainNoWrongDepths) {
  const Scene scene = scene_of("coverage/hairlines.json");
  GivenFrame given = drawn(scene, "coverage.top_for_bottom");
  const ColorAndDepth right = drawn(scene, "");
  given.depth = right.depth;
  for (double& z : given.depth.values()) z = std::nearbyint(z * 65535) / 65535;
  given.is_legal = given.is_legal_color = Plane<std::uint8_t>(given.color.width(), given.color.height(), 1);
  for (std::size_t i = 0; i < given.depth.size(); ++i) {
    if (given.depth.values()[i] != right.depth.values()[i]) given.is_legal.values()[i] = 0;
  }
  EXPECT_EQ(lookalikes(scene, given).likely, "") << lookalikes(scene, given).text;
  EXPECT_FALSE(lookalikes(scene, given).by_color);
}

// A fault that explains the colours, and would have put depths off that are right.
TEST(Lookalikes, OfColorsAloneLeaveRightDepthsAlone) {
  const Scene scene = scene_of("cull/closed_mesh.json");
  GivenFrame given = drawn(scene, "window.other_side_culled");
  const ColorAndDepth right = drawn(scene, "");
  EXPECT_NE(lookalikes(scene, given).likely, "");
  given.depth = right.depth;
  EXPECT_EQ(lookalikes(scene, given).likely, "") << lookalikes(scene, given).text;
}

// A stage that is right by itself is not the cause where another is wrong by itself; else its wrong row counts.
TEST(Lookalikes, AreEncodedByTheConventions) {
  const Scene scene = scene_of("interpolation/ramps.json");
  GivenFrame given = drawn(scene, "attributes.next_corner");
  EXPECT_EQ(lookalikes(scene, given).likely, "attributes (fault attributes.next_corner)");
  given.conventions.color_encoding = Conventions::Encoding::srgb;  // which they are not
  EXPECT_EQ(lookalikes(scene, given).likely, "");
}

TEST(Lookalikes, WhatIsLegalCountsAgainstThemWhereItIsMost) {
  const Scene scene = scene_of("interpolation/w_ratio.json");
  GivenFrame given = drawn(scene, "attributes.affine");
  const std::size_t all = lookalikes(scene, given).apart;
  mark(given, given.color.size() / 4);
  const Lookalikes found = lookalikes(scene, given);
  EXPECT_LT(found.apart, all);
  EXPECT_EQ(found.likely, "attributes (fault attributes.affine)") << found.text;
  EXPECT_TRUE(found.whole);
  mark(given, given.color.size() * 3 / 4);
  EXPECT_EQ(lookalikes(scene, given).likely, "");
  given.is_legal = {};
  EXPECT_EQ(lookalikes(scene, given).likely, "");
}

TEST(Lookalikes, AFaultThatChangesWhatIsLegalAndOursCountsLess) {
  const Scene scene = scene_of("interpolation/w_ratio.json");
  GivenFrame given = drawn(scene, "");
  given.color(0, 0) = glm::vec4(1) - given.color(0, 0);
  given.is_legal = Plane<std::uint8_t>(given.color.width(), given.color.height(), 1);
  given.is_legal(0, 0) = 0;
  const Lookalikes found = lookalikes(scene, given);
  EXPECT_EQ(found.apart, 1u);
  EXPECT_EQ(found.likely, "") << found.text;
}

TEST(Lookalikes, DepthsThatAreTruncatedDifferByLessThanAStep) {
  const Scene scene = scene_of("interpolation/many_sided.json");
  const Lookalikes found = lookalikes(scene, drawn(scene, "depth.truncated"));
  EXPECT_EQ(found.likely, "depth (fault depth.truncated)") << found.text;
  EXPECT_EQ(found.codes, 0.5);
}

}  // namespace

}  // namespace plumbline::cli
