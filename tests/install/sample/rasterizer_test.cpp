#include "rasterizer.h"

#include <gtest/gtest.h>
#include <plumbline/matches_scene.h>

TEST(Rasterizer, ShowsAFanOfTwoTriangles) {
  const Corner a{8, 8, 0.5, 1, {1, 0, 0, 1}}, b{56, 8, 0.5, 1, {0, 1, 0, 1}}, c{56, 56, 0.5, 1, {0, 0, 1, 1}},
      d{8, 56, 0.5, 1, {1, 1, 0, 1}};
  Image image(64, 64, {0, 0, 0, 0});
  draw(image, {a, b, c});
  draw(image, {a, c, d});
  const plumbline::DrawnFrame frame{64, 64, image.color, image.depth};
  EXPECT_THAT(frame, plumbline::MatchesScene(SCENES "/fan.json"));
}
