// Alpha and stencil test by the tables of the specification, and in their order; polygon offset by its formula.
#include "kernels/visibility.h"

#include <cmath>

#include <gtest/gtest.h>

#include "kernels/depth.h"
#include "pipeline/render.h"
#include "scene/mesh/mesh_shapes.h"
#include "tests/at_weights.h"
#include "tests/pipeline/window_triangles.h"

namespace plumbline::pipeline {
namespace {

using testing_words::window_triangle;
using testing_words::window_vertex;
using Func = CompareFunc;
using O = StencilOp;

TEST(AlphaTest, ComparesWithTheReferenceByEachFunction) {
  struct Row {
    Func func;
    bool below, at, above;
  };
  for (const Row& row : {Row{Func::never, false, false, false}, Row{Func::less, true, false, false},
                         Row{Func::equal, false, true, false}, Row{Func::less_equal, true, true, false},
                         Row{Func::greater, false, false, true}, Row{Func::not_equal, true, false, true},
                         Row{Func::greater_equal, false, true, true}, Row{Func::always, true, true, true}}) {
    for (float scale : {0.0f, 255.0f, 4095.0f}) {
      const AlphaTest test{row.func, 0.5f};
      EXPECT_EQ(alpha_passes<float>(test, 0.25f, scale), row.below);
      EXPECT_EQ(alpha_passes<float>(test, 0.5f, scale), row.at);
      EXPECT_EQ(alpha_passes<float>(test, 0.75f, scale), row.above);
    }
  }
}

// 2.1 spec 4.1.4: both are rounded to the frame's codes; a float frame compares what comes, clamped by nothing.
TEST(AlphaTest, ComparesCodesWhereTheFrameHasThem) {
  const AlphaTest equal{Func::equal, 100.0f / 255};
  EXPECT_TRUE(alpha_passes<float>(equal, 100.49f / 255, 255));
  EXPECT_FALSE(alpha_passes<float>(equal, 100.51f / 255, 255));
  EXPECT_TRUE(alpha_passes<float>(equal, 99.51f / 255, 255));
  EXPECT_FALSE(alpha_passes<float>(equal, 100.49f / 255, 4095));
  EXPECT_FALSE(alpha_passes<float>(equal, 100.49f / 255, 0));
  EXPECT_FALSE(alpha_passes<float>({Func::greater, 1}, 1.5f, 255));
  EXPECT_TRUE(alpha_passes<float>({Func::greater, 1}, 1.5f, 0));
}

std::uint8_t after(const StencilFace& face, bool nearer, std::uint8_t held) {
  stencil_test<float>(face, true, nearer, &held);
  return held;
}

TEST(StencilTest, OpsChangeWhatIsHeld) {
  struct Row {
    O op;
    int of_0, of_200, of_255;
  };
  for (const Row& row :
       {Row{O::keep, 0, 200, 255}, Row{O::zero, 0, 0, 0}, Row{O::replace, 77, 77, 77}, Row{O::increment, 1, 201, 255},
        Row{O::increment_wrap, 1, 201, 0}, Row{O::decrement, 0, 199, 254}, Row{O::decrement_wrap, 255, 199, 254},
        Row{O::invert, 255, 55, 0}}) {
    StencilFace face;
    face.reference = 77;
    face.pass = row.op;
    EXPECT_EQ(after(face, true, 0), row.of_0);
    EXPECT_EQ(after(face, true, 200), row.of_200);
    EXPECT_EQ(after(face, true, 255), row.of_255);
    face.write_mask = 0xf0;
    EXPECT_EQ(after(face, true, 200), (row.of_200 & 0xf0) | (200 & 0x0f));
    face.write_mask = 0;
    EXPECT_EQ(after(face, true, 200), 200);
  }
}

TEST(StencilTest, EachOutcomeHasItsOp) {
  StencilFace face{Func::equal, 5, 0x0f, O::zero, O::increment, O::invert, 0xff};
  EXPECT_EQ(after(face, true, 0x75), 0x8a);
  EXPECT_EQ(after(face, false, 0x75), 0x76);
  EXPECT_EQ(after(face, true, 0x76), 0);
  EXPECT_EQ(after(face, false, 0x76), 0);
  std::uint8_t held = 0x75;
  EXPECT_FALSE(stencil_test<float>(face, false, true, &held)) << "what is dropped before";
  EXPECT_EQ(held, 0x75) << "leaves it alone";
  EXPECT_TRUE(stencil_test<float>(face, true, false, &held)) << "depth is another test";
}

// The reference stands on the left: less passes where it is less than what is held.
TEST(StencilTest, ComparesTheReferenceWithWhatIsHeldUnderTheMask) {
  for (int held = 0; held < 256; ++held) {
    for (int mask : {0xff, 0x0f, 0x80, 0}) {
      const int r = 0x47 & mask, s = held & mask;
      const auto passes = [&](Func func) {
        StencilFace face{func, 0x47, static_cast<std::uint8_t>(mask), O::keep, O::keep, O::keep, 0xff};
        return stencil_passes<float>(face, held);
      };
      ASSERT_EQ(passes(Func::less), r < s);
      ASSERT_EQ(passes(Func::less_equal), r <= s);
      ASSERT_EQ(passes(Func::greater), r > s);
      ASSERT_EQ(passes(Func::greater_equal), r >= s);
      ASSERT_EQ(passes(Func::equal), r == s);
      ASSERT_EQ(passes(Func::not_equal), r != s);
      ASSERT_TRUE(passes(Func::always));
      ASSERT_FALSE(passes(Func::never));
    }
  }
}

// Triangles over the whole frame, a draw for each window z; stencil values are cleared to 9.
Scene quads(std::initializer_list<float> depths) {
  Scene scene;
  scene.frame.width = scene.frame.height = 4;
  scene.frame.stencil = StencilFormat::s8;
  scene.frame.clear_stencil = 9;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{0, 4, 0, 4, 0, 1};
  for (float z : depths) {
    Draw draw;
    draw.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    draw.lit = false;
    scene.meshes.push_back(make_triangles({{-9, -9, -z}, {19, -9, -z}, {-9, 19, -z}}, {{0, 1, 2}}, {}));
    scene.draws.push_back(draw);
  }
  return scene;
}

TEST(FragmentTests, GoInOpenGLsOrder) {
  Scene scene = quads({0.5f, 0.25f, 0.75f});
  Stencil& stencil = scene.draws[1].stencil.emplace();
  stencil.front = {Func::equal, 9, 0xff, O::zero, O::invert, O::increment, 0xff};
  stencil.back = {Func::always, 0, 0xff, O::zero, O::zero, O::zero, 0xff};
  scene.draws[2].stencil = stencil;
  scene.draws[2].stencil->front.reference = 10;
  const Frame both = render(scene);
  EXPECT_EQ(both.stencil(1, 1), 255 - 10) << "9, one more by the second, turned over by the third, which is hidden";
  EXPECT_EQ(both.depth_code(1, 1), 4194304u);

  scene.draws[1].alpha_test = AlphaTest{Func::less, 0.5f};
  EXPECT_EQ(render(scene).stencil(1, 1), 0) << "dropped by its alpha it adds nothing, and the third finds 9 for 10";
  EXPECT_EQ(render(scene).depth_code(1, 1), 8388608u);

  scene.draws[1].alpha_test.reset();
  scene.draws[1].stencil->front.func = Func::never;
  EXPECT_EQ(render(scene).stencil(1, 1), 0) << "0 by the second, and by the third, whose 10 is not 0";
  EXPECT_EQ(render(scene).depth_code(1, 1), 8388608u);

  std::swap(scene.meshes[1].triangles[0].y, scene.meshes[1].triangles[0].z);
  scene.draws[2].stencil->front = {Func::equal, 0, 0xff, O::keep, O::increment, O::keep, 0xff};
  EXPECT_EQ(render(scene).stencil(1, 1), 1) << "by its back the second passes and zeroes";
  EXPECT_EQ(render(scene).depth_code(1, 1), 4194304u);
}

TEST(FragmentTests, AFrameWithoutStencilValuesHasNone) {
  Scene scene = quads({0.5f});
  EXPECT_EQ(render(scene).stencil(3, 3), 9);
  scene.frame.stencil = StencilFormat::none;
  EXPECT_TRUE(render(scene).stencil.empty());
}

// dz/dx 1/16, dz/dy -1/8 a pixel: m = 1/8.
ShadedTriangle slope() {
  return window_triangle(window_vertex({0, 0, 0.5f}), window_vertex({4, 0, 0.75f}), window_vertex({0, 2, 0.25f}));
}

TEST(PolygonOffset, IsFactorTimesTheSteepestSlopeAndUnitsTimesAStep) {
  const auto z0 = [](DepthFormat format, PolygonOffset offset) {
    return depth_setup(slope(), {format, 0, 1, offset}).z0;
  };
  EXPECT_EQ(z0(DepthFormat::z24, {}), 0.5);
  EXPECT_EQ(z0(DepthFormat::z24, {2, 0}), 0.75);
  EXPECT_EQ(z0(DepthFormat::z24, {-3, 0}), 0.125);
  EXPECT_DOUBLE_EQ(z0(DepthFormat::z16, {0, 3}), 0.5 + 6 / 65535.0);
  EXPECT_DOUBLE_EQ(z0(DepthFormat::z24, {1, -1}), 0.625 - 2 / 16777215.0);
  EXPECT_EQ(z0(DepthFormat::z32f, {0, 4}), 0.5 + std::ldexp(4, -1 - 23)) << "0.75 has the exponent -1";
}

TEST(PolygonOffset, MovesTheWholePlaneBeforeItIsClamped) {
  const DepthSetup moved = depth_setup(slope(), {DepthFormat::z32f, 0, 1, {8, 0}});
  EXPECT_EQ(moved.dz1, 0.25);
  EXPECT_EQ(moved.dz2, -0.25);
  EXPECT_EQ(test::depth_at(moved, 0, 0), 1) << "1.5, clamped";
  EXPECT_EQ(test::depth_at(depth_setup(slope(), {DepthFormat::z32f, 0, 1, {2, 0}}), 0, 1), 0.5f);
}

TEST(PolygonOffset, LinesAndPointsHaveNone) {
  ShadedTriangle line = slope();
  line.v[2] = line.v[1];
  line.corners = 2;
  EXPECT_EQ(depth_setup(line, {DepthFormat::z32f, 0, 1, {8, 8}}).z0, 0.5);
}

// GL 4.5 compatibility, 14.6.5: 2^(e - 23) of float; of unorm formats what Mesa has, two steps.
TEST(PolygonOffset, AStepIsTheFormats) {
  EXPECT_EQ(polygon_offset_unit(DepthFormat::z8, 0.3), 2 / 255.0);
  EXPECT_EQ(polygon_offset_unit(DepthFormat::z16, 0.3), 2 / 65535.0);
  EXPECT_EQ(polygon_offset_unit(DepthFormat::z24, 0.3), 2 / 16777215.0);
  EXPECT_EQ(polygon_offset_unit(DepthFormat::z32f, 1), std::ldexp(1, -23));
  EXPECT_EQ(polygon_offset_unit(DepthFormat::z32f, 0.99), std::ldexp(1, -24));
  EXPECT_EQ(polygon_offset_unit(DepthFormat::z32f, 0), std::ldexp(1, -149));
}

}  // namespace
}  // namespace plumbline::pipeline
