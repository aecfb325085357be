// Conventions: their file, their words, and what they make of captures and scenes.
#include <filesystem>

#include <gtest/gtest.h>

#include "capture/by_conventions.h"
#include "capture/files/conventions_file.h"
#include "scene/json/json_tree.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

using C = Conventions;

class ConventionsFile : public TestFolder {
 protected:
  C declared(const std::string& text) {
    const std::filesystem::path file = root_ / "conventions.json";
    test::write_text(file, text);
    return read_conventions(file);
  }
  std::string refusal(const std::string& text) {
    try {
      declared(text);
    } catch (const JsonError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(ConventionsFile, WhatIsWrittenIsReadBack) {
  C c;
  c.sample = {0, 0.25};
  c.offset_unit = {1, 1.01}, c.float_offset_unit = 0x1p-23;
  c.subpixel_bits = C::kFloat, c.texture_bits = 8, c.edge_bits = 16;
  c.rows = C::Rows::from_top, c.tie_rule = C::TieRule::right_top, c.depth_range = C::DepthRange::one_to_zero;
  c.level_of_detail = C::LevelOfDetail::approximate, c.blending = C::Blending::in_codes;
  c.open = {"sample", "blending"}, c.unexplained = {"one scene \"drawn\" twice differs"};
  EXPECT_EQ(declared(conventions_text(c)), c);
  EXPECT_EQ(declared(conventions_text({})), C());
  c.unexplained = {"a program's\nwords, \x01 and \xff"};
  EXPECT_EQ(declared(conventions_text(c)).unexplained,
            std::vector<std::string>{"a program's words,   and \xEF\xBF\xBD"});
  EXPECT_EQ(declared(R"({"format": "plumbline conventions", "version": 1})"), C()) << "what is left out is OpenGL's";
}

TEST_F(ConventionsFile, WhatIsWrongIsRefusedWithItsPlace) {
  const std::string head = R"({"format": "plumbline conventions", "version": 1, )";
  EXPECT_NE(refusal(head + R"("colour": 1})").find("colour"), std::string::npos);
  EXPECT_NE(refusal(head + R"("rows": "upwards"})").find("at \"/rows\": expected"), std::string::npos);
  EXPECT_NE(refusal(head + R"("sample": [0.5, 1.5]})").find("/sample/1"), std::string::npos);
  EXPECT_NE(refusal(head + R"("sample": [0.5]})").find("/sample"), std::string::npos);
  EXPECT_NE(refusal(head + R"("subpixel_bits": 17})").find("/subpixel_bits"), std::string::npos);
  for (const char* bits : {"17", "-1", "0.5", "\"none\""}) {
    const std::string said = refusal(head + R"("subpixel_bits": )" + bits + "}");
    EXPECT_NE(said.find("or \"float\""), std::string::npos) << said;
  }
  EXPECT_NE(refusal(head + R"("open": ["colour"]})").find("at \"/open/0\": expected the name of a convention"),
            std::string::npos);
  for (const char* line : {"1", "\"a\\nb\"", "\"\\u001b[31m\""}) {
    EXPECT_NE(refusal(head + R"("unexplained": [)" + line + "]}").find("/unexplained/0"), std::string::npos) << line;
  }
  EXPECT_NE(refusal(head + R"("offset_unit": [2, -1]})").find("/offset_unit/1"), std::string::npos);
  for (const auto& [key, word] : {std::pair("attribute_corners", "snapped"), std::pair("depth_corners", "snapped"),
                                  std::pair("subpixel_rounding", "down"), std::pair("subpixel_rounding", "up")}) {
    const std::string said = refusal(fmt::format(R"({}"subpixel_bits": "float", "{}": "{}"}})", head, key, word));
    EXPECT_NE(said.find(fmt::format("/{}\": expected another value than {}", key, word)), said.npos) << said;
  }
  EXPECT_NE(refusal(R"({"format": "plumbline goldens", "version": 1})").find("/format"), std::string::npos);
  EXPECT_NE(refusal(R"({"format": "plumbline conventions", "version": 2})").find("/version"), std::string::npos);
  EXPECT_NE(refusal(R"({"camera": {}})").find("\"format\": \"plumbline conventions\", found no such key"),
            std::string::npos);
  EXPECT_THROW(read_conventions(root_ / "nothing.json"), JsonError);
}

TEST(Conventions, OnlyMistakesAreNamed) {
  C free;
  free.subpixel_bits = 4, free.offset_unit = {1, 1}, free.tie_rule = C::TieRule::right_top,
  free.depth_rounding = C::Rounding::down;
  free.edge_bits = 14, free.depth_format = C::Depth::z32f, free.blending = C::Blending::in_codes;
  EXPECT_TRUE(mistaken(free).empty());
  EXPECT_TRUE(mistaken(undeclared()).empty());
  C wrong;
  wrong.sample = {0, 0}, wrong.subpixel_bits = 3, wrong.edge_bits = 11, wrong.offset_unit = {1, 0.5};
  wrong.rows = C::Rows::from_top, wrong.tie_rule = C::TieRule::exclusive, wrong.depth_format = C::Depth::z16;
  wrong.unexplained = {"one scene drawn twice differs"};
  const std::vector<std::string> lines = mistaken(wrong);
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines[0], "convention sample: 0, 0, expected 0.5, 0.5 (the sample's place in its pixel)");
  EXPECT_EQ(lines[1],
            "convention rows: from_top, expected from_bottom (the order of the picture's rows, or y turned round)");
  EXPECT_EQ(lines[4], "convention subpixel_bits: 3, expected 4 or more (OpenGL 2.1: the least SUBPIXEL_BITS)");
  EXPECT_EQ(
      lines[5],
      "convention edge_bits: 11, expected 14 or more: over 1,024 rows an edge errs by 0.5 pixel, beyond 1/16, that "
      "of the least SUBPIXEL_BITS (OpenGL 2.1)");
  EXPECT_EQ(lines[6],
            "convention offset_unit: 1, 0.5, expected 1 or more: a unit makes depths differ (OpenGL 2.1, 3.5.5)");
  EXPECT_EQ(lines[7], "no convention: one scene drawn twice differs");
}

TEST(Conventions, RoundingsMakeWholeNumbers) {
  using enum C::Rounding;
  EXPECT_EQ(rounded(nearest, 1.75), 2);
  EXPECT_EQ(rounded(nearest, 1.25), 1);
  EXPECT_EQ(middle_of(nearest), 0);
  EXPECT_EQ(rounded(down, 1.75), 1);
  EXPECT_EQ(rounded(down, 1), 1);
  EXPECT_EQ(middle_of(down), 0.5);
  EXPECT_EQ(rounded(up, 1.25), 2);
  EXPECT_EQ(rounded(up, 1), 1);
  EXPECT_EQ(middle_of(up), -0.5);
}

TEST(Conventions, ACaptureBecomesTheDialects) {
  Capture capture;
  capture.width = 2, capture.height = 3;
  capture.planes.color = Plane<glm::vec4>(2, 3);
  capture.planes.color(1, 0) = glm::vec4(1);
  capture.planes.depth = Plane<double>(2, 3, -1);
  capture.planes.depth(0, 2) = 0.5;
  capture.records.covered = {{0, 1, 0}};
  C c;
  c.rows = C::Rows::from_top, c.depth_range = C::DepthRange::minus_one_to_one;
  to_dialect(c, capture);
  EXPECT_EQ(capture.planes.color(1, 2), glm::vec4(1));
  EXPECT_EQ(capture.planes.color(1, 0), glm::vec4(0));
  EXPECT_EQ(capture.planes.depth(0, 0), 0.75);
  EXPECT_EQ(capture.planes.depth(1, 1), 0);
  EXPECT_EQ(capture.records.covered[0].y, 2);
}

// A renderer that samples a pixel at its corner hands out its own window positions.
TEST(Conventions, WindowPositionsAreMovedToCentres) {
  Capture capture;
  capture.records.triangles.resize(1);
  capture.records.triangles[0].v[2].p_win = {3, 4, 0.25};
  capture.records.triangles[0].v[2].snapped = {5, 6};
  C c;
  Capture same = capture;
  to_dialect(c, same);
  EXPECT_EQ(same.records.triangles[0].v[2].p_win, Vec3<double>(3, 4, 0.25));
  c.sample = {0, 1};
  to_dialect(c, capture);
  EXPECT_EQ(capture.records.triangles[0].v[2].p_win, Vec3<double>(3.5, 3.5, 0.25));
  EXPECT_EQ(capture.records.triangles[0].v[2].snapped, glm::ivec2(5 + 128, 6 - 128));
}

TEST(Conventions, ASceneIsAlteredOnlyWhereItMustBe) {
  Scene scene;
  scene.meshes.emplace_back().triangles = {{0, 1, 2}};
  C free;
  free.subpixel_bits = 4, free.depth_range = C::DepthRange::one_to_zero;
  EXPECT_EQ(&*SceneByConventions(scene, free), &scene);
  C other;
  other.sample = {0, 0.25};
  other.provoking_vertex = C::Provoking::first, other.depth_planes = C::DepthPlanes::clamped;
  other.depth_format = C::Depth::z16;
  const SceneByConventions by(scene, other);
  EXPECT_EQ(by->frame.pass.shift, glm::dvec2(0.5, 0.25));
  EXPECT_EQ(by->meshes[0].triangles[0], glm::uvec3(1, 2, 0));
  EXPECT_TRUE(by->depth_clamp);
  EXPECT_EQ(by->frame.depth, DepthFormat::z16);
}

TEST(Conventions, WindowCoordinatesLieOnTheDeclaredGrid) {
  Conventions c;
  const double p_win = 3.5 + 37.4 / 1024;  // of the fourth pixel's centre
  EXPECT_EQ(on_grid(c, 0, 0.5), 128);
  EXPECT_EQ(on_grid(c, 0, p_win), 3 * 256 + 128 + 9);
  EXPECT_EQ(snapped(c, 0, (p_win - 0.5) * 256), 3 * 256 + 9);
  c.subpixel_bits = 10;
  EXPECT_EQ(on_grid(c, 1, p_win), 3 * 1024 + 512 + 37);
  EXPECT_EQ(snapped(c, 1, (p_win - 0.5) * 256), 3 * 256 + 9) << "to 1/256 pixel at the finest";
  c.subpixel_rounding = Conventions::Rounding::up;
  EXPECT_EQ(on_grid(c, 1, p_win), 3 * 1024 + 512 + 38);
  c.subpixel_bits = 4, c.subpixel_rounding = Conventions::Rounding::down;
  EXPECT_EQ(on_grid(c, 0, p_win), 3 * 16 + 8);
  EXPECT_EQ(on_grid(c, 0, -1.0 / 64), -1) << "left of the frame";
  EXPECT_EQ(snapped(c, 0, (p_win - 0.5) * 256), 3 * 256) << "counted in 1/256 pixel still";
}

// Whole pixels are borders. A sample at x 1/4 is moved by 1/4 to the centre, and window x with it.
TEST(Conventions, AGridIsOfTheRenderersOwnWindow) {
  Conventions c;
  c.subpixel_bits = 0;
  EXPECT_EQ(on_grid(c, 0, 3.25), 3);
  EXPECT_EQ(snapped(c, 0, (3.25 - 0.5) * 256), 3 * 256 - 128);
  EXPECT_EQ(snapped(c, 0, (3.75 - 0.5) * 256), 4 * 256 - 128);
  c.sample = {0.25, 0};
  EXPECT_EQ(on_grid(c, 0, 3.5), 3) << "3.25 before it was moved";
  EXPECT_EQ(on_grid(c, 0, 3.875), 4);
  EXPECT_EQ(snapped(c, 0, (3.5 - 0.5) * 256), 3 * 256 - 128 + 64);
  EXPECT_EQ(on_grid(c, 1, 3.5), 3);
  EXPECT_EQ(snapped(c, 1, (3.75 - 0.5) * 256), 3 * 256) << "borders are moved to centres";
}

}  // namespace
}  // namespace plumbline
