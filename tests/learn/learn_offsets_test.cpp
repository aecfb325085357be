// Units of polygon offsets, and provoking vertices, that plumb learn finds.
#include <string>
#include <vector>

#include "tests/learn/altered_renderers.h"
#include "tests/learn/drawn_otherwise.h"

namespace plumbline::learn {
namespace {

TEST(LearnOffsets, TheUnitInCodesIsFound) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) { scene = test::with_half_of_offsets(scene); };
  C expected = ours();
  expected.offset_unit = {1, 1};
  expected.open = {"float_offset_unit"};
  EXPECT_EQ(learn(renderer).conventions, expected);
}

// Floats whose unit is the same at all depths, and units of neither kind.
TEST(LearnOffsets, TheUnitOfOffsetsOfFloatsIsTheirStepOrOneNumber) {
  const auto learned_of = [](double of_large, double of_small) {
    OfAlteredScenes renderer;
    renderer.after = [&](const Scene& scene, Capture& c) {
      if (scene.name != "probe/float_offset_unit" || scene.draws[0].polygon_offset.units == 0) return;
      for (double& z : c.planes.depth.values()) z = z > 0.5 ? 0.75 - 0x1p19 * of_large : 0.1875 - 0x1p19 * of_small;
    };
    return learn(renderer).conventions;
  };
  EXPECT_EQ(learned_of(0x1p-24, 0x1p-26), ours());
  const C fixed = learned_of(0x1.00001p-23, 0x1.00001p-23);
  EXPECT_EQ(fixed.float_offset_unit, 0x1p-23) << "but for what depths in float leave of it";
  EXPECT_TRUE(mistaken(fixed).empty());
  EXPECT_NEAR(learned_of(1.5e-7, 1.5e-7).float_offset_unit, 1.5e-7, 1e-11);
  EXPECT_EQ(learned_of(0x1p-24, 0x1p-25).open, std::vector<std::string>{"float_offset_unit"});
  const C none = learned_of(0, 0);
  ASSERT_EQ(none.unexplained.size(), 1u);
  EXPECT_TRUE(none.unexplained[0].starts_with("float_offset_unit: 524288 units move a depth of 3/4 by 0"));
}

// The first corner of counter-clockwise triangles provokes, and the last of clockwise ones.
TEST(LearnProvoking, AVertexOfOneWindingAloneFitsNone) {
  OfAlteredScenes renderer;
  renderer.after = [](const Scene& scene, Capture& c) {
    if (scene.name == "probe/provoking_vertex") c.planes.color(4, 4) = {0.2f, 0.2f, 0.2f, 1};
  };
  const C found = learn(renderer).conventions;
  ASSERT_EQ(found.unexplained.size(), 1u);
  EXPECT_EQ(found.unexplained[0],
            "provoking_vertex: a flat triangle of 0.2, 0.5 and 1 is drawn in 0.2, a clockwise one in 1");
}

TEST(LearnProvoking, IsOpenWhereNoFlatTriangleIsDrawn) {
  OfAlteredScenes renderer;
  renderer.after = [](const Scene& scene, Capture& c) {
    if (scene.name == "probe/provoking_vertex") c.planes.color(4, 4) = c.planes.color(12, 12) = {0, 0, 0, 1};
  };
  const C found = learn(renderer).conventions;
  EXPECT_TRUE(leaves_open(found, "provoking_vertex"));
  EXPECT_TRUE(found.unexplained.empty());
}

}  // namespace
}  // namespace plumbline::learn
