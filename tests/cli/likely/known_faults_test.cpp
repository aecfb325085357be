// Known faults that may explain a frame, and what the renderer's conventions say against them.
#include "cli/likely/known_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cli/likely/lookalikes.h"
#include "tests/suite.h"

namespace plumbline::cli {
namespace {

using C = Conventions;

const KnownFault* find(const std::vector<KnownFault>& known, const std::string& name) {
  const auto at = std::ranges::find(known, name, &KnownFault::name);
  return at == known.end() ? nullptr : &*at;
}

std::vector<KnownFault> known_by(const Conventions& conventions) {
  GivenFrame given;
  given.conventions = conventions;
  return known_faults(suite_scene("cull/both_windings"), given);
}

bool is_known(const std::string& fault, const Conventions& conventions) {
  return find(known_by(conventions), fault) != nullptr;
}

bool is_contradicted(const std::string& fault, const Conventions& conventions) {
  return find(known_by(conventions), fault)->is_contradicted;
}

TEST(KnownFaults, OfRowsAndDepthRangesAreContradictedByConventionsThatTellThem) {
  Conventions learned, open;
  open.open = {"rows", "depth_range"};
  for (const char* fault : {"file.rows_reversed", "window.y_flipped", "file.depth_of_ndc", "file.depth_reversed"}) {
    EXPECT_TRUE(is_contradicted(fault, learned)) << fault;
    EXPECT_FALSE(is_contradicted(fault, open)) << fault;
    EXPECT_FALSE(is_contradicted(fault, undeclared())) << fault;
  }
  EXPECT_FALSE(is_contradicted("file.mirrored", learned));
  open.open = {"rows"};
  EXPECT_TRUE(is_contradicted("file.depth_reversed", open));
}

TEST(KnownFaults, OfCodesForNumbersAreThoseOfFramesBeyondOne) {
  const Scene scene = suite_scene("light/emission");
  GivenFrame given{draw_with({}, scene, {}), {}, {}};
  EXPECT_EQ(find(known_faults(scene, given), "file.codes_for_numbers"), nullptr);
  for (glm::vec4& color : given.color.values()) color *= 255.0f;
  EXPECT_NE(find(known_faults(scene, given), "file.codes_for_numbers"), nullptr);
  const Lookalikes found = lookalikes(scene, given);
  EXPECT_EQ(found.likely, "file (fault file.codes_for_numbers)");
  EXPECT_TRUE(found.whole) << found.text;
}

// A channel that is written twice, an edge that is not tested, a bounding box that is filled.
TEST(KnownFaults, OfFirstRasterizersAreNamed) {
  const Scene scene = suite_scene("coverage/shared_edges");
  const std::vector<KnownFault> known = known_faults(scene, {});
  for (const char* name :
       {"file.green_of_red", "file.blue_of_green", "coverage.box_filled", "coverage.first_edge_missing",
        "coverage.second_edge_missing", "coverage.third_edge_missing"}) {
    const Lookalikes found = lookalikes(scene, {draw_with(std::vector{find(known, name)}, scene, {}), {}, {}});
    EXPECT_TRUE(found.likely.ends_with(std::string("(fault ") + name + ")")) << name << '\n' << found.text;
    EXPECT_TRUE(found.whole) << name;
  }
}

// The Pikuma course's depth buffer: 1/w, of which the largest is kept.
TEST(KnownFaults, OfDepthsThatAreNearnessAreNamed) {
  const Scene scene = suite_scene("depth/interpenetrating");
  const std::vector<KnownFault> known = known_faults(scene, {});
  GivenFrame given{draw_with(std::vector{find(known, "depth.of_inv_w")}, scene, {}), {}, {}};
  const Lookalikes found = lookalikes(scene, given);
  EXPECT_EQ(found.likely, "depth (fault depth.of_inv_w)");
  EXPECT_TRUE(found.whole) << found.text;
  // Declared one_to_zero, and turned round as all of the renderer's depths.
  given.conventions.depth_range = C::DepthRange::one_to_zero;
  for (double& z : given.depth.values()) z = 1 - z;
  EXPECT_EQ(lookalikes(scene, given).likely, "depth (fault depth.of_inv_w)");
}

// A renderer whose rows were turned round since its conventions were learned.
TEST(KnownFaults, ThatConventionsContradictAreNamedWhereTheyExplainAll) {
  const Scene scene = suite_scene("light/emission");
  const std::vector<KnownFault> known = known_faults(scene, {});
  GivenFrame given{draw_with(std::vector{find(known, "file.rows_reversed")}, scene, {}), {}, {}};
  const Lookalikes found = lookalikes(scene, given);
  EXPECT_EQ(found.likely, "file (fault file.rows_reversed)");
  EXPECT_TRUE(found.whole);
  EXPECT_NE(found.text.find("the conventions declare otherwise: run plumb learn again"), std::string::npos)
      << found.text;
  given.color(0, 0) = glm::vec4(0.3f, 0.6f, 0.9f, 1);
  EXPECT_EQ(lookalikes(scene, given).likely, "") << "a pixel is left";
  given.conventions.open = {"rows"};
  EXPECT_EQ(lookalikes(scene, given).likely, "file (fault file.rows_reversed)") << "a pixel in a hundred may be left";
}

// Frame of one wall at window z 1/2, which is 1/2 where depths are reversed, too.
TEST(KnownFaults, ThatConventionsContradictComeAfterAllOthers) {
  const Scene scene = suite_scene("texture/wall_repeat");
  const std::vector<KnownFault> known = known_faults(scene, {});
  GivenFrame given{draw_with(std::vector{find(known, "visibility.farthest_kept")}, scene, {}), {}, {}};
  const auto names_reversed = [&] {
    Lookalikes found = lookalikes(scene, given);
    found.ties.push_back(found.likely);
    EXPECT_NE(std::ranges::find(found.ties, "visibility (fault visibility.farthest_kept)"), found.ties.end());
    return std::ranges::find(found.ties, "file (fault file.depth_reversed)") != found.ties.end();
  };
  EXPECT_FALSE(names_reversed());
  given.conventions.open = {"depth_range"};
  EXPECT_TRUE(names_reversed());
}

// A frame that is rounded to the nearest, of a renderer that is said to truncate.
TEST(KnownFaults, AreRoundingsThatConventionsDeclareAndTheRendererDoesNotHave) {
  Conventions declared;
  EXPECT_FALSE(is_known("merge.to_nearest", declared) || is_known("depth.to_nearest", declared));
  declared.color_rounding = declared.depth_rounding = Conventions::Rounding::down;
  EXPECT_TRUE(is_known("merge.to_nearest", declared) && is_known("depth.to_nearest", declared));
  EXPECT_FALSE(is_known("merge.truncated", declared) || is_known("depth.truncated", declared));
  GivenFrame legal;
  legal.conventions = declared;
  legal.is_legal = {2, 1, 1};
  const Scene any = suite_scene("cull/both_windings");
  EXPECT_EQ(find(known_faults(any, legal), "merge.to_nearest"), nullptr) << "what was declared explains all pixels";
  legal.is_legal(1, 0) = 0;
  EXPECT_NE(find(known_faults(any, legal), "merge.to_nearest"), nullptr);
  const Scene scene = suite_scene("light/emission");
  for (const char* fault : {"merge.to_nearest", "depth.to_nearest"}) {
    Conventions of_frame = declared;
    (std::string(fault).starts_with("merge") ? of_frame.color_rounding : of_frame.depth_rounding) =
        Conventions::Rounding::nearest;
    const Lookalikes found = lookalikes(scene, {draw_with({}, scene, of_frame), declared, {}});
    EXPECT_TRUE(found.likely.ends_with(std::string("(fault ") + fault + ")")) << found.text;
    EXPECT_TRUE(found.whole) << found.text;
  }
}

// A grid of 1/16 pixel, rounded down, which no fault draws: pixels that it decides are wrong in our frame, and tell
// nothing. A fault is named by the others.
TEST(KnownFaults, AreSeenWhereOurFrameIsRightByTheConventions) {
  const Scene scene = suite_scene("coverage/shared_edges");
  Scene on_grid = scene;  // model space is the window
  for (Mesh& mesh : on_grid.meshes) {
    for (glm::vec3& p : mesh.positions) p.x = std::floor(16 * p.x) / 16, p.y = std::floor(16 * p.y) / 16;
  }
  C declared;
  declared.subpixel_bits = 4, declared.subpixel_rounding = C::Rounding::down,
  declared.tie_rule = C::TieRule::left_bottom;
  const auto frame = [&](const char* fault) {
    const std::vector<KnownFault> known = known_faults(on_grid, {});
    const KnownFault* drawn = find(known, fault);
    return drawn == nullptr ? draw_with({}, on_grid, {}) : draw_with(std::vector{drawn}, on_grid, {});
  };
  const std::size_t by_default = lookalikes(scene, {frame(""), {}, {}}).apart,
                    by_grid = lookalikes(scene, {frame(""), declared, {}}).apart;
  EXPECT_GT(by_default, 10u);
  EXPECT_LT(by_grid, by_default / 2);
  EXPECT_EQ(lookalikes(scene, {frame("file.mirrored"), declared, {}}).likely, "file (fault file.mirrored)");
}

// Samples at pixels' corners: borders of pixels, moved by half a pixel, are centres.
TEST(KnownFaults, OfWholePixelsAreDeclaredWhereverPixelsAreSampled) {
  C declared;
  declared.subpixel_bits = 0, declared.attribute_corners = C::Corners::snapped;
  for (const glm::dvec2 corner : {glm::dvec2(0), glm::dvec2(0, 1)}) {
    declared.sample = corner;
    EXPECT_FALSE(is_known("window.nearest_centres", declared));
    EXPECT_TRUE(is_known("window.nearest_pixels", declared));
  }
  declared.subpixel_rounding = C::Rounding::down, declared.window_y = C::WindowY::down;
  EXPECT_FALSE(is_known("window.whole_centres_from_top", declared));
  EXPECT_TRUE(is_known("window.whole_centres", declared));
  declared.sample = {0.25, 0};
  EXPECT_TRUE(is_known("window.whole_centres_from_top", declared)) << "no fault has such a grid";
}

// Frames of an affine renderer, of another tie rule or of whole pixels: what the conventions declare is drawn, and is
// no fault.
TEST(KnownFaults, AreDrawnByDeclaredInterpolationFogTiesAndWholePixels) {
  C affine, affine_colors, radial, exclusive, inclusive, left_top, whole_pixels;
  affine.interpolation = C::Interpolation::affine;
  affine_colors.color_interpolation = C::ColorInterpolation::affine;
  radial.fog_distance = C::FogDistance::eye_radial;
  exclusive.tie_rule = C::TieRule::exclusive;
  inclusive.tie_rule = C::TieRule::inclusive;
  left_top.tie_rule = C::TieRule::left_top;
  whole_pixels.subpixel_bits = 0, whole_pixels.subpixel_rounding = C::Rounding::down;
  whole_pixels.attribute_corners = C::Corners::snapped;
  C from_top = whole_pixels, nearest = whole_pixels;
  from_top.window_y = C::WindowY::down, nearest.subpixel_rounding = C::Rounding::nearest;
  struct Case {
    C declared;
    const char *scene, *drawn, *fault;
  };
  for (const auto& [declared, name, drawn, fault] :
       {Case{affine, "interpolation/w_ratio", "attributes.affine", "file.mirrored"},
        {affine_colors, "interpolation/w_ratio", "attributes.affine", "file.mirrored"},
        {radial, "fog/exp", "shade.fog_radial", "file.mirrored"},
        {exclusive, "coverage/shared_edges", "notes.000.strict_edges", "file.mirrored"},
        {inclusive, "coverage/shared_edges", "coverage.inclusive_edges", "file.mirrored"},
        {whole_pixels, "interpolation/tiny", "window.whole_pixels", "file.mirrored"},
        {from_top, "interpolation/tiny", "window.whole_pixels_from_top", "file.mirrored"},
        {nearest, "interpolation/tiny", "window.nearest_pixels", "file.mirrored"},
        {left_top, "notes/gl_on_centres", "coverage.top_for_bottom", "file.mirrored"}}) {
    const Scene scene = suite_scene(name);
    const std::vector<KnownFault> known = known_faults(scene, {});
    const auto frame = [&](std::vector<const KnownFault*> faults) { return draw_with(faults, scene, {}); };
    const ColorAndDepth right = frame({find(known, drawn)}), wrong = frame({find(known, drawn), find(known, fault)});
    EXPECT_EQ(find(known_by(declared), drawn), nullptr);
    EXPECT_EQ(lookalikes(scene, {right, declared, {}}).apart, 0u) << drawn;
    EXPECT_NE(lookalikes(scene, {right, {}, {}}).apart, 0u) << drawn;
    const Lookalikes found = lookalikes(scene, {wrong, declared, {}});
    EXPECT_TRUE(found.likely.ends_with(std::string("(fault ") + fault + ")")) << found.text;
    EXPECT_TRUE(found.whole) << found.text;
  }
}

// A frame of OpenGL's tie rule by conventions that declare another.
TEST(KnownFaults, ATieRuleThatIsDeclaredByMistakeIsNamed) {
  const Scene scene = suite_scene("coverage/on_centres");
  C left_top;
  left_top.tie_rule = C::TieRule::left_top;
  const Lookalikes found = lookalikes(scene, {draw_with({}, scene, {}), left_top, {}});
  EXPECT_EQ(found.likely, "coverage (fault coverage.left_bottom)") << found.text;
  EXPECT_TRUE(found.whole) << found.text;
  EXPECT_EQ(find(known_by({}), "coverage.left_bottom"), nullptr);
}

// Faults are pictures: none is tried in a large scene, which is said.
TEST(KnownFaults, AreNotTriedInLargeScenes) {
  Scene scene = suite_scene("light/emission");
  scene.frame.width = 500, scene.frame.height = 401;
  Capture left;
  left.planes.color = Plane<glm::vec4>(500, 401, glm::vec4(0.5f));
  const std::vector<std::string> said = likely_faults(scene, left, {}, {});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0], "known faults are not tried: over 20,000 primitives or 200,000 pixels");
}

// Order of faults that explain all wrong pixels: first one that draws the legal pixels that are unlike ours, too,
// wherever it stands in the list.
TEST(KnownFaults, ThatDrawLegalPixelsToo) {
  const Scene scene = suite_scene("coverage/shared_edges");
  const std::vector<KnownFault> known = known_faults(scene, {});
  const auto frame = [&](const std::string& fault) {
    return draw_with(std::vector{&*std::ranges::find(known, fault, &KnownFault::name)}, scene, {});
  };
  using Faults = std::pair<std::string, std::string>;  // one that draws all, one that draws the wrong pixels alone
  for (const auto& [whole, part] : {Faults("coverage.box_one_short", "coverage.last_column_lost"),
                                    {"coverage.box_one_short", "coverage.last_row_lost"},
                                    {"window.one_pixel_off", "coverage.first_column_lost"}}) {
    GivenFrame given{frame(whole), {}, {}};
    const ColorAndDepth drawn = frame(part);
    given.is_legal = Plane<std::uint8_t>(given.color.width(), given.color.height(), 0);
    for (std::size_t i = 0; i < given.color.size(); ++i)
      given.is_legal.values()[i] = given.color.values()[i] == drawn.color.values()[i] ? 0 : 1;
    given.is_legal_color = given.is_legal;
    given.depth = {};
    const Lookalikes found = lookalikes(scene, given);
    EXPECT_TRUE(found.likely.ends_with("(fault " + whole + ")")) << part << '\n' << found.text;
    for (const std::string& tie : found.ties) EXPECT_EQ(tie.find(part), std::string::npos) << tie;
  }
}

}  // namespace
}  // namespace plumbline::cli
