// The comparator of colours that several fragments of a pixel make.
#include "check/bounds/open_pixels.h"
#include "tests/check/compare/planes.h"

namespace plumbline::check {
namespace {

// Three fragments at (3, 1), one of them hidden.
struct BlendedPairs : PlanePairs {
  BlendedPairs() {
    scene.draws[0].merge.blend = Blend{};
    capture.records.covered = {{0, 3, 1}, {0, 2, 2}, {1, 3, 1}, {1, 3, 1}};
    capture.records.drawn = {{true}, {true}, {false}, {true}};
  }
  Compare blended() const {
    return [this](const auto& a, const auto& b) { return compare_blended(scene, a, b, legal, 2.5, 8); };
  }
  // Codes apart that still pass at (x, y), or 99.
  int most(int x, int y) const {
    int codes = 0;
    while (codes < 99 && passes(run(blended(), [&](Planes& p) { p.color(x, y).r += code(codes + 1); }))) ++codes;
    return codes;
  }
};

TEST_F(BlendedPairs, EachFragmentDrawnMayDifferByTwoCodesAndAHalf) {
  EXPECT_TRUE(passes(run(blended(), kUnchangedPlanes)));
  EXPECT_EQ(most(3, 1), 5);
  EXPECT_EQ(most(2, 2), 2);
  EXPECT_EQ(most(0, 0), 0) << "the clear colour";
  scene.draws[0].merge.blend->rgb.source = BlendFactor::destination_alpha;
  EXPECT_EQ(most(3, 1), 7) << "twice what was there before, and once more";
  EXPECT_EQ(most(2, 2), 2);
}

// 2.5 codes for each of 102 layers are all that there are: the row says that it judged nothing there.
TEST_F(BlendedPairs, SoManyLayersThatNoCodeIsWrongLeaveTheColourOpen) {
  for (int layer = 2; layer < 101; ++layer) {
    capture.records.covered.push_back({0, 3, 1});
    capture.records.drawn.push_back({true});
  }
  EXPECT_EQ(run(blended(), kUnchangedPlanes).ambiguous, 0u);
  capture.records.covered.push_back({0, 3, 1});
  capture.records.drawn.push_back({true});
  EXPECT_EQ(run(blended(), kUnchangedPlanes).ambiguous, 1u);
  EXPECT_TRUE(passes(run(blended(), [](Planes& p) { p.color(3, 1) = glm::vec4(1, 0, 1, 0); })));
  EXPECT_TRUE(fails(run(blended(), [](Planes& p) { p.color(3, 1).r = static_cast<float>(kNaN); })));
}

TEST_F(BlendedPairs, InFloatByTheirColoursBoundsAlone) {
  scene.frame.color = ColorFormat::rgba32f;
  EXPECT_TRUE(passes(run(blended(), kUnchangedPlanes)));
  EXPECT_TRUE(passes(run(blended(), [](Planes& p) { p.color(3, 1).r += static_cast<float>(20 * kU); })));
  EXPECT_TRUE(fails(run(blended(), [](Planes& p) { p.color(3, 1).r += 1e-3f; })));
  EXPECT_TRUE(fails(run(blended(), [](Planes& p) { p.color(0, 0).r += 1e-6f; })));
}

TEST_F(BlendedPairs, WhereItIsOpenWhichFragmentsMadeItAnyNumberIsLegal) {
  legal.color_lo = legal.color_hi = Plane<glm::vec4>(kWidth, kHeight);
  legal.color_lo(3, 1) = glm::vec4(-static_cast<float>(kInf));
  EXPECT_EQ(most(3, 1), 99);
  EXPECT_EQ(run(blended(), kUnchangedPlanes).ambiguous, 1u);
  EXPECT_TRUE(fails(run(blended(), [](Planes& p) { p.color(3, 1).r = static_cast<float>(kNaN); })));
  EXPECT_EQ(most(2, 2), 2);
}

// The hidden fragment at (3, 1) lies so near to the one before it that it may have been drawn: not where it is a step
// and the bounds of both farther.
TEST_F(BlendedPairs, AHiddenFragmentWhoseDepthTestIsOpenMayHaveBeenDrawn) {
  const double step = depth_step(scene.frame.depth, 0.5);
  const auto at = [&](double apart) { capture.records.depth = {0.5, 0.5, 0.5 + apart, 0.25}; };
  at(step);
  EXPECT_EQ(most(3, 1), 99);
  EXPECT_EQ(run(blended(), kUnchangedPlanes).ambiguous, 1u);
  EXPECT_EQ(most(2, 2), 2);
  at(0.125);
  EXPECT_EQ(most(3, 1), 5);
  at(-step);
  EXPECT_EQ(most(3, 1), 99) << "drawn here, and hidden there";
  scene.draws[0].depth_func = DepthFunc::always;
  EXPECT_EQ(most(3, 1), 5) << "nothing is compared";
  scene.draws[0].depth_func = DepthFunc::less;
  capture.records.depth = {0.5, 0.5, 0.25 + step, 0.25};
  capture.records.drawn[2].drawn = true;
  EXPECT_EQ(most(3, 1), 99) << "of what was held last";
  scene.draws[0].merge.depth_mask = false;
  EXPECT_EQ(most(3, 1), 7) << "nothing is held but the cleared depth; three are drawn";
  at(step);
  legal.color_lo = legal.color_hi = Plane<glm::vec4>(kWidth, kHeight);
  allow(0, 0, {});
  scene.draws[0].merge.depth_mask = true;
  EXPECT_EQ(most(3, 1), 7) << "where an oracle has been asked, it decides";
}

// Of three fragments at (3, 1) the last leaves its depth, and a draw that writes none wins. The second's depth test is
// open: had it been drawn, a stencil test might keep the last one out, and the first's depth might stay.
TEST_F(BlendedPairs, AnyFragmentsDepthMayBeLeftWhereAStencilTestFollowsAnOpenOne) {
  const double step = depth_step(scene.frame.depth, 0.5);
  scene.draws.push_back(scene.draws[0]);
  scene.draws[1].merge.depth_mask = false;
  for (const auto& [triangle, z] : {std::pair(1, 0.5 + step), std::pair(2, 0.25)}) {
    WindowTriangle<double> flat = capture.records.triangles[0];
    flat.primitive = static_cast<std::uint32_t>(triangle) + 3;
    for (auto& v : flat.v) v.p_win.z = z;
    capture.records.triangles.resize(static_cast<std::size_t>(triangle));
    capture.records.triangles.push_back(flat);
  }
  capture.records.covered = {{0, 3, 1}, {1, 3, 1}, {2, 3, 1}};
  capture.records.drawn = {{true}, {false}, {true}};
  capture.records.depth = {0.5, 0.5 + step, 0.25};
  capture.planes.id(3, 1) = 8 + 3;
  capture.planes.depth(3, 1) = 0.25;
  const auto leaves = [&](double z) { return run(depth(), kUnchangedPlanes, [z](Planes& p) { p.depth(3, 1) = z; }); };
  EXPECT_TRUE(passes(leaves(0.25)));
  EXPECT_TRUE(fails(leaves(0.5))) << "without a stencil test";
  scene.draws[0].stencil.emplace();
  EXPECT_TRUE(passes(leaves(0.5)));
  EXPECT_TRUE(fails(leaves(0.375))) << "no fragment's";
  capture.records.depth[1] = 0.75;
  EXPECT_TRUE(fails(leaves(0.5))) << "no depth test is open";
}

// A fragment's depth half-way between two steps may be rounded to either: the two sides may be a step apart in each.
TEST_F(BlendedPairs, ADepthTestIsOpenWhereBothDepthsMayBeRoundedOtherwise) {
  scene.frame.depth = DepthFormat::z16;
  const double step = depth_step(scene.frame.depth, 0.5);
  const auto at = [&](double apart) { capture.records.depth = {0.5, 0.5, 0.5 + apart, 0.25}; };
  at(2 * step);
  EXPECT_EQ(most(3, 1), 99);
  at(3 * step);
  EXPECT_EQ(most(3, 1), 5);
}

// Three edges pass the pixel at three depths: the reference may hold any of them for the second.
TEST_F(BlendedPairs, ADepthTestIsOpenAgainstWhatAnyEdgeOfTheTriangleMayHold) {
  std::vector<WindowTriangle<double>>& triangles = capture.records.triangles;
  WindowTriangle<double> edge = triangles[0];
  edge.v[2] = edge.v[1];
  edge.corners = 2;
  triangles = {edge, edge, edge, triangles[1]};
  for (std::size_t i = 0; i < 3; ++i) {
    for (auto& v : triangles[i].v) v.p_win.z = std::array{0.5, 0.625, 0.4375}[i];
  }
  capture.records.covered = {{1, 3, 1}, {3, 3, 1}};
  capture.records.drawn = {{true}, {true}};
  const auto is_open = [&](double z) {
    capture.records.depth = {0.625, z};
    return open_by_depth(scene, capture)(3, 1) != 0;
  };
  EXPECT_TRUE(is_open(0.4376));
  EXPECT_TRUE(is_open(0.8124)) << "as far on the other side";
  EXPECT_FALSE(is_open(0.4374));
  EXPECT_FALSE(is_open(0.8126));
}

TEST_F(BlendedPairs, OtherFragmentsAreCoveragesAndALinesColourItsMajorAxiss) {
  const PlaneChange beside = [](Planes& p) { p.id_sum(2, 2) += 1, p.color(2, 2).r += code(40); };
  scene.meshes[0].topology = Topology::lines;
  EXPECT_TRUE(passes(run(blended(), beside)));
  EXPECT_EQ(run(blended(), beside).ambiguous, 1u);
  const PlaneChange zero_beside = [](Planes& p) { p.count(2, 2) += 1, p.color(2, 2).r += code(40); };
  EXPECT_TRUE(passes(run(blended(), zero_beside))) << "primitive 0 weighs nothing";
  EXPECT_EQ(run(blended(), zero_beside).ambiguous, 1u);
  EXPECT_TRUE(
      fails(run(blended(), [](Planes& p) { p.id_sum(2, 2) += 1, p.color(2, 2).r = static_cast<float>(kNaN); })));
  EXPECT_EQ(most(3, 1), 5);
  WindowTriangle<double>& line = capture.records.triangles[0];
  line.v[2] = line.v[1];
  line.corners = 2;
  const Vec4<double> along = glm::abs(bounds_from_origin(line, 3, 1).line_shift_color);
  const double largest = std::max({along.r, along.g, along.b, along.a});
  ASSERT_GT(255 * largest, 1);
  EXPECT_EQ(most(3, 1), 5 + static_cast<int>(255 * 3 * largest)) << "as colour, as factor of itself and of the frame";
}

TEST_F(BlendedPairs, AgainstBoundsHalfACodeBeyondThem) {
  Legal bounds;
  bounds.color_lo = bounds.color_hi = capture.planes.color;
  bounds.color_hi(3, 1).r += code(1);
  const auto moved = [&](int x, int y, int codes) {
    const auto compare = [&](const auto& a, const auto& b) {
      return compare_merge(scene, a.planes, b.planes, 1, bounds);
    };
    return run(compare, [&](Planes& p) { p.color(x, y).r += code(codes); });
  };
  EXPECT_TRUE(passes(moved(3, 1, 0)));
  EXPECT_TRUE(passes(moved(3, 1, 1)));
  EXPECT_TRUE(fails(moved(3, 1, 2)));
  EXPECT_TRUE(fails(moved(3, 1, -1)));
  EXPECT_TRUE(fails(moved(2, 2, 1)));
  legal = bounds;
  legal.certain = Plane<std::uint32_t>(kWidth, kHeight);
  const auto by_oracle = [&](const auto& a, const auto&) { return compare_legal_merge(scene, a.planes, legal, 1); };
  EXPECT_TRUE(passes(run(by_oracle, [](Planes& p) { p.color(3, 1).r += code(1); })));
  EXPECT_TRUE(fails(run(by_oracle, [](Planes& p) { p.color(3, 1).r += code(2); })));
  EXPECT_TRUE(fails(run(by_oracle, [](Planes& p) { p.color(2, 2).r = static_cast<float>(kNaN); })));
  legal.color_lo(3, 1) = glm::vec4(-static_cast<float>(kInf));
  EXPECT_TRUE(passes(run(by_oracle, [](Planes& p) { p.color(3, 1).r += code(2); }))) << "open";
  for (int c = 0; c < 4; ++c) {
    EXPECT_TRUE(fails(run(by_oracle, [&](Planes& p) { p.color(3, 1)[c] = static_cast<float>(kNaN); }))) << c;
  }
}

TEST_F(BlendedPairs, CodesOfALogicOpAreEqualWhereTheFragmentsCodesAreCertain) {
  scene.draws[0].merge = Merge{};
  scene.draws[0].merge.logic_op = LogicOp::xor_;
  const auto sources = [&](double codes) {
    capture.records.shaded.assign(4, Shaded<double>{Vec4<double>(codes / 255)});
  };
  sources(100.25);
  EXPECT_EQ(most(3, 1), 0);
  sources(100.5);
  EXPECT_EQ(most(3, 1), 99) << "either code may be";
  EXPECT_GT(run(blended(), kUnchangedPlanes).ambiguous, 0u);
  EXPECT_TRUE(fails(run(blended(), [](Planes& p) { p.color(3, 1).r = static_cast<float>(kNaN); })));
}

TEST_F(BlendedPairs, CodesOfALogicOpAreOpenOverAClearColourHalfWayBetweenTwo) {
  scene.draws[0].merge = Merge{};
  scene.draws[0].merge.logic_op = LogicOp::and_;
  capture.records.shaded.assign(4, Shaded<double>{Vec4<double>(100.25 / 255)});
  EXPECT_EQ(most(3, 1), 0);
  scene.frame.clear_color.g = 100.5f / 255;
  EXPECT_EQ(most(3, 1), 0) << "another channel";
  scene.frame.clear_color.r = 100.5f / 255;
  EXPECT_EQ(most(3, 1), 99) << "either code may be";
}

// OpenGL lets alpha and its reference be converted with more bits than the frame has (2.1 spec, 2.14.9): 1e-6 is the
// code 0 of 16 bits, and more than an alpha of 0 in float, where Mesa compares them of all frames but those of 8 bits.
TEST(SettledAlpha, IsOpenWhereABetterConversionDropsTheFragment) {
  Scene scene = two_draws();
  scene.draws.resize(1);
  scene.draws[0].lit = false;
  scene.draws[0].material.diffuse = {0.5, 0.5, 0.5, 0};
  const auto settled = [&](ColorFormat format, float reference) {
    scene.frame.color = format;
    scene.draws[0].alpha_test = AlphaTest{CompareFunc::greater_equal, reference};
    const Capture mine = exact_capture(scene);
    Capture theirs = mine;
    theirs.planes.id.values().assign(mine.planes.id.size(), kBackground);
    const std::uint64_t open = copy_pixels_open_by_alpha(scene, mine, Stage::visibility, 8, theirs);
    if (open > 0) {
      EXPECT_EQ(theirs.planes.id.values(), mine.planes.id.values());
    }
    return open;
  };
  EXPECT_GT(settled(ColorFormat::rgba16, 1e-6f), 0u);
  EXPECT_EQ(settled(ColorFormat::rgba8, 1e-6f), 0u) << "Mesa rounds to 8 bits";
  EXPECT_EQ(settled(ColorFormat::rgba16, 0.25f), 0u) << "dropped in any format";
}

}  // namespace
}  // namespace plumbline::check
