// Known faults of frames in which the renderer approximates, too: a fault counts where its frame is four times as near
// as ours.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/likely/known_faults.h"
#include "cli/likely/lookalikes.h"
#include "tests/suite.h"

namespace plumbline::cli {
namespace {

// Frame of the fault. Where its colours are more than 40/255 from ours, they go up and down by `codes` [1/255] from
// pixel to pixel.
GivenFrame rippled(const Scene& scene, const std::string& fault, int codes) {
  const std::vector<KnownFault> known = known_faults(scene, {});
  const auto of_name = std::ranges::find(known, fault, &KnownFault::name);
  const ColorAndDepth ours = draw_with({}, scene, undeclared());
  GivenFrame out{draw_with(std::vector{&*of_name}, scene, undeclared()), undeclared(), {}};
  for (std::size_t i = 0; i < out.color.size(); ++i) {
    if (!colors_apart(out.color.values()[i], ours.color.values()[i], 40)) continue;
    out.color.values()[i] += glm::vec4(glm::vec3(static_cast<float>(i % 2 == 0 ? codes : -codes) / 255), 0);
  }
  return out;
}

TEST(Nearness, NamesAFaultBeneathApproximations) {
  const std::string fault = "texture.levels_too_coarse";
  const Scene scene = suite_scene("texture/floor_nearest_mipmap_nearest");
  const Lookalikes as_drawn = lookalikes(scene, rippled(scene, fault, 0)),
                   near = lookalikes(scene, rippled(scene, fault, 6)),
                   far = lookalikes(scene, rippled(scene, fault, 60));
  EXPECT_FALSE(as_drawn.by_nearness);
  EXPECT_TRUE(as_drawn.whole) << as_drawn.text;
  EXPECT_TRUE(near.by_nearness);
  EXPECT_TRUE(near.by_color);
  EXPECT_FALSE(near.whole);
  EXPECT_EQ(near.likely, "texture (fault " + fault + ")") << near.text;
  EXPECT_NE(near.text.find("four times as near"), std::string::npos) << near.text;
  EXPECT_EQ(far.likely, "") << far.text;
}

// A frame whose depths tell that nothing was moved.
TEST(Nearness, IsOfNoFaultThatPutsRightDepthsOff) {
  const Scene scene = suite_scene("texture/floor_nearest_mipmap_nearest");
  GivenFrame given = rippled(scene, "window.one_pixel_off", 6);
  given.depth = {};
  const Lookalikes by_color = lookalikes(scene, given);
  given.depth = draw_with({}, scene, undeclared()).depth;
  EXPECT_EQ(by_color.likely, "window (fault window.one_pixel_off)") << by_color.text;
  EXPECT_EQ(lookalikes(scene, given).likely.find("one_pixel_off"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::cli
