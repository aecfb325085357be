// Lines about pixels of a frame that lack a surface, or have one too many.
#include "cli/likely/holes.h"

#include <gtest/gtest.h>

#include <utility>

#include "cli/likely/known_faults.h"
#include "tests/suite.h"

namespace plumbline::cli {
namespace {

struct Holes : testing::Test {
  Scene scene = suite_scene("light/sphere_gouraud");
  GivenFrame given{draw_with({}, scene, {}), {}, {}};

  bool is_cleared(std::size_t i) const { return given.depth.values()[i] == scene.frame.clear_depth; }
  // Clears pixels that show a surface, and draws on pixels that show none.
  void change(std::size_t holes, std::size_t drawn) {
    for (std::size_t i = 0; i < given.color.size(); ++i) {
      const bool was_cleared = is_cleared(i);
      if (!was_cleared && holes > 0) {
        given.color.values()[i] = scene.frame.clear_color, given.depth.values()[i] = scene.frame.clear_depth, --holes;
      } else if (was_cleared && drawn > 0) {
        given.color.values()[i] = {0.9f, 0.2f, 0.7f, 1}, given.depth.values()[i] = 0.25, --drawn;
      }
    }
  }
};

TEST_F(Holes, AreCounted) {
  EXPECT_EQ(holes_text(scene, given), "");
  change(7, 2);
  EXPECT_TRUE(
      holes_text(scene, given)
          .starts_with(
              "of 9 wrong pixels, 7 are as cleared where a surface is to be seen, 2 show one where none is: coverage"));
}

TEST_F(Holes, AreToldOfAFrameWithoutDepthsToo) {
  change(3, 0);
  given.depth = {};
  EXPECT_TRUE(holes_text(scene, given).starts_with("of 3 wrong pixels, 3 are as cleared"));
}

TEST_F(Holes, ThatLieBeyondAPlaneAreToldSo) {
  change(0, 3);
  EXPECT_EQ(holes_text(scene, given).find("plane"), std::string::npos);
  double z = 1.25;
  for (std::size_t i = 0; i < given.color.size(); ++i) {
    if (given.depth.values()[i] == 0.25) given.depth.values()[i] = std::exchange(z, -0.5);
  }
  const std::string text = holes_text(scene, given);
  EXPECT_NE(text.find("depths beyond the near plane, where all is clipped: 2 of"), std::string::npos) << text;
  EXPECT_NE(text.find("depths beyond the far plane, where all is clipped: 1 of"), std::string::npos) << text;
  scene.draws[0].depth_range = {1, 0};
  EXPECT_EQ(holes_text(scene, given).find("where all is clipped"), std::string::npos) << "another depth is the plane's";
}

TEST_F(Holes, OfLegalPixelsAreNone) {
  change(4, 0);
  given.is_legal = Plane<std::uint8_t>(scene.frame.width, scene.frame.height, 1);
  EXPECT_EQ(holes_text(scene, given), "");
}

TEST_F(Holes, AreNotToldWhereMostPixelsAreWrongOtherwise) {
  for (std::size_t i = 0; i < given.color.size(); ++i) {
    if (!is_cleared(i)) given.color.values()[i].g = 1;
  }
  change(5, 0);
  EXPECT_EQ(holes_text(scene, given), "");
}

}  // namespace
}  // namespace plumbline::cli
