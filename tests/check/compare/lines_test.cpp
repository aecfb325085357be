// The comparators of lines, both ways: what OpenGL allows passes, the least that it does not fails.
#include "check/compare/compare_lines.h"

#include "check/compare/compare_planes.h"
#include "tests/check/compare/lines.h"

namespace plumbline::check {
namespace {

const WindowTriangle<double> kFlat = line_of({2.5, 3.5}, {6.5, 4.5}, 1);
const Pixels kFlatPixels = {{2, 3}, {3, 3}, {4, 4}, {5, 4}};

Measurement lines_compared(const Pixels& theirs) {
  return compare_covered_lines({}, drawn({kFlat}, {kFlatPixels}), drawn({kFlat}, {theirs}), 1);
}

Measurement winners(Capture mine, const Capture& theirs) {
  mine.records.depth.resize(mine.records.covered.size(), 0.5);
  return compare_line_or_point_winners({}, mine, theirs);
}

TEST(CheckLines, TheSamePixelsAreEqual) {
  const Measurement m = lines_compared(kFlatPixels);
  EXPECT_TRUE(passes(m));
  EXPECT_EQ(m.ambiguous, 0u);
  EXPECT_EQ(m.max_difference, 0);
  EXPECT_EQ(m.items, 16u * 12 + 1);
}

TEST(CheckLines, WhatTheSpecificationAllowsIsAmbiguous) {
  for (const Pixels& theirs : {Pixels{{2, 3}, {3, 4}, {4, 4}, {5, 4}},             // a pixel one off
                               Pixels{{2, 2}, {3, 2}, {4, 3}, {5, 3}},             // all one off
                               Pixels{{3, 3}, {4, 4}, {5, 4}},                     // the first lost
                               Pixels{{2, 3}, {3, 3}, {4, 4}, {5, 4}, {6, 4}},     // one more
                               Pixels{{1, 3}, {2, 3}, {3, 3}, {4, 4}, {5, 4}}}) {  // at the other end
    const Measurement m = lines_compared(theirs);
    EXPECT_TRUE(passes(m));
    EXPECT_EQ(m.ambiguous, 1u);
    EXPECT_EQ(m.max_difference, 1);
  }
}

TEST(CheckLines, WhatItDoesNotAllowIsDifferent) {
  EXPECT_TRUE(fails(lines_compared({{2, 3}, {3, 5}, {4, 4}, {5, 4}})));                  // a pixel two off
  EXPECT_TRUE(fails(lines_compared({{4, 4}, {5, 4}})));                                  // two fewer
  EXPECT_TRUE(fails(lines_compared({{2, 3}, {3, 3}, {4, 4}, {5, 4}, {6, 4}, {7, 4}})));  // two more
  EXPECT_TRUE(fails(lines_compared({{2, 3}, {3, 3}, {3, 4}, {4, 4}, {5, 4}})));          // two in one column
  EXPECT_TRUE(fails(lines_compared({{2, 3}, {3, 3}, {4, 4}, {8, 4}})));                  // one far away
  EXPECT_TRUE(fails(lines_compared({})));
}

TEST(CheckLines, SteepLinesHaveRowsForColumns) {
  const WindowTriangle<double> steep = line_of({3.5, 2.5}, {4.5, 6.5}, 1);
  const Pixels pixels = {{3, 2}, {3, 3}, {4, 4}, {4, 5}};
  const auto against = [&](const Pixels& theirs) {
    return compare_covered_lines({}, drawn({steep}, {pixels}), drawn({steep}, {theirs}), 1);
  };
  EXPECT_TRUE(passes(against({{3, 3}, {4, 4}, {4, 5}})));
  EXPECT_TRUE(passes(against({{3, 2}, {4, 3}, {4, 4}, {4, 5}})));
  EXPECT_TRUE(fails(against({{3, 2}, {3, 3}, {4, 3}, {4, 4}, {4, 5}})));
}

TEST(CheckLines, ColumnsOfWideLinesAreWhole) {
  WindowTriangle<double> wide = kFlat;
  wide.width = 3;
  const auto widened = [](const Pixels& lowest, int width = 3) {
    Pixels out;
    for (int k = 0; k < width; ++k) {
      for (const glm::ivec2 p : lowest) out.push_back(p + glm::ivec2(0, k));
    }
    return out;
  };
  const Pixels lowest = {{2, 2}, {3, 2}, {4, 3}, {5, 3}};
  const auto against = [&](const Pixels& theirs) {
    return compare_covered_lines({}, drawn({wide}, {widened(lowest)}), drawn({wide}, {theirs}), 1);
  };
  EXPECT_EQ(against(widened(lowest)).ambiguous, 0u);
  EXPECT_TRUE(passes(against(widened({{2, 2}, {3, 3}, {4, 3}, {5, 3}}))));  // a column one off
  EXPECT_TRUE(passes(against(widened({{3, 2}, {4, 3}, {5, 3}}))));          // the first lost
  EXPECT_TRUE(fails(against(widened({{4, 3}, {5, 3}}))));
  EXPECT_TRUE(fails(against(widened({{2, 2}, {3, 4}, {4, 3}, {5, 3}}))));  // two off
  EXPECT_TRUE(fails(against(widened(lowest, 2))));                         // too narrow
  EXPECT_TRUE(fails(against(widened(lowest, 4))));                         // too wide
  Pixels gap = widened(lowest);
  gap[4].y += 2;  // of the column's middle, beyond its upper end
  EXPECT_TRUE(fails(against(gap)));
  // At the frame's border a column is cut off.
  const WindowTriangle<double> low = [&] {
    WindowTriangle<double> t = line_of({2.5, 0.5}, {6.5, 0.5}, 1);
    t.width = 3;
    return t;
  }();
  const Pixels two_rows = widened({{2, 0}, {3, 0}, {4, 0}, {5, 0}}, 2), one_row = {{2, 0}, {3, 0}, {4, 0}, {5, 0}};
  EXPECT_TRUE(passes(compare_covered_lines({}, drawn({low}, {two_rows}), drawn({low}, {one_row}), 1)));
  // At the scissor box' border too; elsewhere a column is whole on either side.
  Scene boxed;
  boxed.meshes.resize(1);
  boxed.meshes[0].triangles.resize(2);
  boxed.draws.resize(1);
  const Pixels narrow = widened({{2, 3}, {3, 3}, {4, 3}, {5, 3}}, 2);
  const auto both_narrow = [&](std::optional<Scissor> box) {
    boxed.draws[0].scissor = box;
    return compare_covered_lines(boxed, drawn({wide}, {narrow}), drawn({wide}, {narrow}), 1);
  };
  EXPECT_TRUE(passes(both_narrow(Scissor{0, 0, 16, 5}))) << "rows 3 and 4, the box' last";
  EXPECT_TRUE(passes(both_narrow(Scissor{0, 3, 16, 9})));
  EXPECT_TRUE(fails(both_narrow(Scissor{0, 0, 16, 6})));
  EXPECT_TRUE(fails(both_narrow(Scissor{0, 2, 16, 9})));
  EXPECT_TRUE(fails(both_narrow(std::nullopt)));
  // The axis that snapping decides: as long in x as in y but for less than a step.
  WindowTriangle<double> diagonal = line_of({2.5, 2.5}, {5.5, 5.501}, 1);
  diagonal.width = 3;
  const Pixels columns = {{2, 1}, {2, 2}, {2, 3}, {3, 2}, {3, 3}, {3, 4}, {4, 3}, {4, 4}, {4, 5}};
  const Pixels rows = {{1, 2}, {2, 2}, {3, 2}, {2, 3}, {3, 3}, {4, 3}, {3, 4}, {4, 4}, {5, 4}};
  EXPECT_TRUE(passes(compare_covered_lines({}, drawn({diagonal}, {columns}), drawn({diagonal}, {rows}), 1)));
  diagonal = line_of({2.5, 2.5}, {5.5, 5.4}, 1);
  diagonal.width = 3;
  EXPECT_TRUE(fails(compare_covered_lines({}, drawn({diagonal}, {columns}), drawn({diagonal}, {rows}), 1)));
}

TEST(CheckLines, TheCandidatesPixelsAreHeldToTheSame) {
  const auto of = [](const WindowTriangle<double>& line, const Pixels& candidate, const Pixels& reference) {
    return compare_covered_lines({}, drawn({line}, {candidate}), drawn({line}, {reference}), 1);
  };
  EXPECT_TRUE(passes(of(kFlat, {{2, 3}, {3, 4}, {4, 4}, {5, 4}}, kFlatPixels)));
  EXPECT_TRUE(fails(of(kFlat, {{2, 3}, {3, 3}, {4, 4}, {9, 9}}, kFlatPixels))) << "one far away, as many columns";
  EXPECT_TRUE(fails(of(kFlat, {{2, 3}, {3, 3}, {3, 4}, {4, 4}, {5, 4}}, kFlatPixels))) << "two in one column";
  WindowTriangle<double> wide = kFlat;
  wide.width = 3;
  Pixels whole, torn;
  for (const glm::ivec2 p : kFlatPixels) {
    for (int k = 0; k < 3; ++k) whole.push_back(p + glm::ivec2(0, k));
    torn.push_back(p), torn.push_back(p + glm::ivec2(0, 2));
  }
  EXPECT_TRUE(passes(of(wide, whole, whole)));
  EXPECT_TRUE(fails(of(wide, torn, whole))) << "its columns lack their middle";
  WindowTriangle<double> diagonal = line_of({2.5, 2.5}, {6.5, 6.5}, 1);
  diagonal.width = 2;
  diagonal.v[1].p_win.y += 0.001;  // along y but for snapping
  const Pixels drawn_so = {{2, 2}, {2, 3}, {3, 3}, {3, 4}, {4, 4}, {4, 5}, {5, 5}, {5, 6}};
  Pixels stray = drawn_so;
  EXPECT_TRUE(passes(of(diagonal, drawn_so, drawn_so)));
  stray.emplace_back(12, 2);
  EXPECT_TRUE(fails(of(diagonal, stray, drawn_so))) << "whichever axis it goes by";
}

TEST(CheckLines, EdgesOfOneTriangleAreToldApart) {
  const WindowTriangle<double> second = line_of({6.5, 4.5}, {6.5, 8.5}, 1);
  const Pixels upright = {{6, 4}, {6, 5}, {6, 6}, {6, 7}};
  const Capture mine = drawn({kFlat, second}, {kFlatPixels, upright});
  EXPECT_TRUE(passes(compare_covered_lines({}, mine, mine, 1)));
  EXPECT_TRUE(
      passes(compare_covered_lines({}, mine, drawn({kFlat, second}, {kFlatPixels, {{6, 5}, {6, 6}, {6, 7}}}), 1)));
  EXPECT_TRUE(fails(compare_covered_lines({}, mine, drawn({kFlat, second}, {upright, kFlatPixels}), 1), 2));
  EXPECT_FALSE(passes(compare_covered_lines({}, mine, drawn({kFlat}, {kFlatPixels}), 1)));
}

TEST(CheckLines, BoundsHoldForThePlaceAlongTheMajorAxis) {
  // 1/w falls to a hundredth along a diagonal line: a pixel to its right lies further along by the major axis than by
  // projection, where the same error of 1/w is of a larger share.
  WindowTriangle<double> line = line_of({0.5, 0.5}, {16.5, 15.5}, 1);
  line.v[0].inv_w = 1;
  line.v[1].inv_w = line.v[2].inv_w = 0.01;
  WindowTriangle<double> upright = line;  // of the same share by projection, no other by an axis
  const PlaneBounds far = bounds_from_origin(line, 15, 8);
  const glm::dvec2 p(15.5, 8.5), a(line.v[0].p_win), d = glm::dvec2(line.v[1].p_win) - a;
  const double share = glm::dot(p - a, d) / glm::dot(d, d);
  upright.v[1].p_win = upright.v[2].p_win = {16.5, 0.5, line.v[1].p_win.z};
  const PlaneBounds near = bounds_from_origin(upright, static_cast<int>(16 * share), 0);
  EXPECT_GT(far.color.r, 1.5 * near.color.r);
}

TEST(CheckLines, DepthsAlongALineEndWhereTheRangeClampsThem) {
  WindowTriangle<double> line = line_of({2.5, 2.5}, {6.5, 4.5}, 1);
  line.v[0].p_win.z = 0.5;
  line.v[1].p_win.z = line.v[2].p_win.z = 0.56;
  const double beyond = bounds_from_origin(line, 7, 2).line_shift_depth;  // share 5/4
  const double clamped = bounds_from_origin(line, 7, 2, {0.5, 0.56}).line_shift_depth;
  const double projected = 0.5 + 0.06 * (5 * 4 + 0 * 2) / 20.0;
  EXPECT_NEAR(beyond, 0.575 - projected, 1e-12);
  EXPECT_NEAR(clamped, 0, 1e-12) << "both are 0.56";
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].triangles.resize(2);
  scene.draws.resize(1);
  scene.draws[0].depth_range.near = 0.75f;
  scene.draws[0].depth_range.far = 0.25f;
  EXPECT_EQ(depth_limits(DrawIndex(scene), 1).high, 1) << "not clamped";
  scene.depth_clamp = true;
  EXPECT_EQ(depth_limits(DrawIndex(scene), 1).low, 0.25);
  EXPECT_EQ(depth_limits(DrawIndex(scene), 1).high, 0.75);
}

TEST(CheckLines, CornersDrawnOverEachOtherTieWithinAStep) {
  const auto point = [](double x, double z) {
    WindowTriangle<double> t = line_of({x, 4.5}, {x, 4.5}, 1);
    t.corners = 1;
    t.width = 3;
    for (auto& v : t.v) v.p_win.z = z;
    return t;
  };
  const std::vector<WindowTriangle<double>> corners = {point(4.5, 0.5), point(5.5, 0.501), point(6.5, 0.75)};
  EXPECT_EQ(tied_corners(corners, 5, 4, 1.0 / 255).size(), 2u);
  EXPECT_TRUE(tied_corners(corners, 5, 4, 0x1p-24).empty()) << "told apart by 24 bits";
  EXPECT_TRUE(tied_corners(corners, 7, 4, 1.0 / 255).empty()) << "one alone";
  EXPECT_TRUE(tied_corners(corners, 5, 6, 1.0 / 255).empty()) << "beside their squares";
}

TEST(CheckLines, OtherFragmentsMayHaveLeftTheDepthThatAWinnerLeaves) {
  Scene scene;
  scene.frame.depth = DepthFormat::z32f;
  Capture mine = drawn({kFlat}, {kFlatPixels}), theirs = mine;
  const int width = mine.planes.count.width(), height = mine.planes.count.height();
  scene.frame.width = width;
  scene.frame.height = height;
  scene.meshes.resize(1);
  scene.meshes[0].triangles.resize(2);
  scene.draws.resize(1);
  for (Capture* c : {&mine, &theirs}) {
    c->planes.id = Plane<std::int32_t>(width, height, 1);
    c->planes.depth = Plane<double>(width, height, 0.5);
  }
  theirs.planes.depth(1, 1) = 0.25;
  theirs.planes.count(1, 1) += 1;
  EXPECT_FALSE(passes(compare_depth_planes(scene, mine, theirs, 4))) << "the winner's depth is its own";
  scene.draws[0].merge.depth_mask = false;
  EXPECT_TRUE(passes(compare_depth_planes(scene, mine, theirs, 4)));
  EXPECT_EQ(compare_depth_planes(scene, mine, theirs, 4).ambiguous, 1u);
  theirs.planes.count(1, 1) -= 1;
  EXPECT_FALSE(passes(compare_depth_planes(scene, mine, theirs, 4))) << "of the same fragments";
}

// A line of depth 0.55 by the projection, 0.5 by the major axis, beneath a winner that writes no depth: by 0.5 the line
// fails against a clear depth between the two.
TEST(CheckLines, TheClearDepthStaysWhereALinesOtherDepthFails) {
  constexpr std::uint32_t kOfSecondDraw = 2;
  Scene scene;
  scene.frame.width = 16, scene.frame.height = 12;
  scene.frame.depth = DepthFormat::z32f;
  scene.meshes.resize(1);
  scene.meshes[0].triangles.resize(2);
  scene.draws.resize(2);
  scene.draws[1].merge.depth_mask = false;
  Capture mine =
      drawn({line_of({2.5, 1.5}, {6.5, 3.5}, 1), line_of({2.5, 3.5}, {6.5, 3.5}, kOfSecondDraw)}, {{{4, 3}}, {{4, 3}}});
  mine.records.drawn.assign(2, {.drawn = true});
  mine.records.depth = {0.55, 0.25};
  mine.planes.depth(4, 3) = 0.55;
  const auto against = [&](double cleared, DepthFunc func, double reference) {
    scene.frame.clear_depth = cleared;
    scene.draws[0].depth_func = func;
    Capture theirs = mine;
    theirs.planes.depth(4, 3) = reference;
    return compare_depth_planes(scene, mine, theirs, 4);
  };
  EXPECT_TRUE(passes(against(0.52, DepthFunc::greater, 0.52)));
  EXPECT_TRUE(fails(against(0.52, DepthFunc::greater, 0.53))) << "neither a line's depth nor the clear depth";
  EXPECT_TRUE(fails(against(0.4, DepthFunc::greater, 0.4))) << "the line passes by either depth";
  EXPECT_TRUE(fails(against(0.52, DepthFunc::always, 0.52))) << "no depth is compared";
}

TEST(CheckLines, WhereEdgesMeetEitherMayHaveBeenDrawnLast) {
  const WindowTriangle<double> second = line_of({6.5, 4.5}, {6.5, 8.5}, 1);
  const Records<double> one = drawn({kFlat}, {{}}).records, two = drawn({kFlat, second}, {{}, {}}).records;
  EXPECT_TRUE(edge_values(triangles_of(one, 1), 6, 4).empty()) << "a line alone";
  EXPECT_EQ(edge_values(triangles_of(two, 1), 6, 4).size(), 4u);
  EXPECT_TRUE(edge_values(triangles_of(two, 1), 2, 3).empty()) << "the other edge is far";
  EXPECT_TRUE(edge_values(triangles_of(two, 2), 6, 4).empty()) << "another primitive's";
  EXPECT_NEAR(edge_values(triangles_of(two, 1), 6, 4)[0].depth, 0.75,
              1e-12);  // the end of one, the beginning of the other
  EXPECT_NEAR(edge_values(triangles_of(two, 1), 6, 4)[2].depth, 0.25, 1e-12);
  Scene scene;
  scene.frame.depth = DepthFormat::z32f;
  Capture mine = drawn({kFlat, second}, {{}, {{6, 4}}}), theirs = mine;
  mine.planes.depth(6, 4) = 0.25;
  for (const double z : {0.25, 0.75}) {
    theirs.planes.depth(6, 4) = z;
    EXPECT_TRUE(passes(compare_depth_planes(scene, mine, theirs, 4))) << z;
  }
  theirs.planes.depth(6, 4) = 0.5;
  EXPECT_TRUE(fails(compare_depth_planes(scene, mine, theirs, 4)));
}

TEST(CheckLines, ALineOfNoPixelMayHaveOneAtItsEnd) {
  const WindowTriangle<double> dot = line_of({3.25, 2.5}, {3.5, 2.75}, 1);
  const auto against = [&](const Pixels& theirs) {
    return compare_covered_lines({}, drawn({dot}, {{}}), drawn({dot}, {theirs}), 1);
  };
  EXPECT_TRUE(passes(against({{3, 2}})));
  EXPECT_TRUE(passes(against({{4, 2}})));
  EXPECT_TRUE(fails(against({{6, 2}})));
  EXPECT_TRUE(fails(against({{3, 2}, {4, 2}})));
}

TEST(CheckLines, AllElseMustBeTheSame) {
  const Capture mine = drawn({kFlat}, {kFlatPixels}, {{3, 3}, {8, 8}});
  EXPECT_TRUE(passes(compare_covered_lines({}, mine, mine, 1)));
  EXPECT_TRUE(fails(compare_covered_lines({}, mine, drawn({kFlat}, {kFlatPixels}, {{3, 3}}), 1)));
  EXPECT_TRUE(fails(compare_covered_lines({}, mine, drawn({kFlat}, {kFlatPixels}, {{3, 3}, {8, 9}}), 1), 2));
  Capture other = mine;
  other.planes.id_sum(8, 8) = id_weight(10);
  EXPECT_TRUE(fails(compare_covered_lines({}, mine, other, 1)));
  other = mine;
  other.records.covered.pop_back();  // what the records tell of the line is not what the planes show
  EXPECT_TRUE(fails(compare_covered_lines({}, mine, other, 1)));
}

TEST(CheckLines, ALineThatOneSideLacksIsDifferent) {
  const WindowTriangle<double> second = line_of({2.5, 8.5}, {4.5, 8.5}, 2);
  const Capture one = drawn({kFlat}, {kFlatPixels}), two = drawn({kFlat, second}, {kFlatPixels, {{2, 8}, {3, 8}}});
  EXPECT_TRUE(fails(compare_covered_lines({}, one, two, 1)));
  EXPECT_TRUE(fails(compare_covered_lines({}, two, one, 1)));
  Capture empty;
  EXPECT_NE(compare_covered_lines({}, one, empty, 1).mismatch, "");
  EXPECT_NE(winners(one, empty).mismatch, "");
}

TEST(CheckLines, WinnersCountWhereBothCoverAlike) {
  const Capture mine = drawn({kFlat}, {kFlatPixels}, {{3, 3}, {3, 4}});
  Capture theirs = drawn({kFlat}, {{{2, 3}, {3, 4}, {4, 4}, {5, 4}}}, {{3, 3}, {3, 4}});
  const Measurement m = winners(mine, theirs);
  EXPECT_TRUE(passes(m));
  EXPECT_EQ(m.ambiguous, 2u);
  theirs.planes.id(4, 4) = 9;  // covered by the same, another won, and its depth is another
  theirs.planes.depth(4, 4) = 0.5;
  EXPECT_TRUE(fails(winners(mine, theirs)));
  // Primitive 0 weighs nothing: the count tells.
  const WindowTriangle<double> zero = line_of({2.5, 3.5}, {6.5, 4.5}, 0);
  EXPECT_TRUE(passes(winners(drawn({zero}, {kFlatPixels}), drawn({zero}, {{{2, 3}}}))));
}

TEST(CheckLines, DepthAndColorGoByTheMajorAxisOrByTheProjection) {
  // Along (4, 2): the pixel above the middle projects to 0.6 of the way; by the major axis it is 0.5.
  WindowTriangle<double> t = line_of({2.5, 1.5}, {6.5, 3.5});
  const PlaneBounds b = bounds_from_origin(t, 4, 3);
  EXPECT_NEAR(b.line_shift_depth, -0.1 * 0.5, 1e-12);
  EXPECT_NEAR(b.line_shift_color.r, 0.1, 1e-12);
  EXPECT_EQ(bounds_from_origin(t, 4, 2).line_shift_depth, 0);  // on the line
  EXPECT_EQ(bounds_from_origin(line_of({2.5, 1.5}, {6.5, 1.5}), 4, 2).line_shift_depth, 0);
  EXPECT_TRUE(std::isfinite(b.depth) && std::isfinite(b.color.r));
  t.corners = 1;
  EXPECT_EQ(bounds_from_origin(t, 4, 3).line_shift_depth, 0);
  // A line as long in x as in y but for float's rounding has x for its major axis. The pixel's place is 3.1 / 24 along
  // x.
  const auto at = [](float z) { return static_cast<double>(z); };
  const WindowTriangle<double> diagonal = line_of({at(49.599998f), at(9.36f)}, {at(25.599998f), at(33.360001f)});
  EXPECT_GT(std::abs(diagonal.v[1].p_win.y - diagonal.v[0].p_win.y),
            std::abs(diagonal.v[1].p_win.x - diagonal.v[0].p_win.x));
  const double from_projection = (3.1 - 2.14) / 2 / 24;  // of the way, along which the colour falls from 1 to 0
  EXPECT_NEAR(bounds_from_origin(diagonal, 46, 11).line_shift_color.r, -from_projection, 1e-6);

  Scene scene;
  scene.frame.depth = DepthFormat::z32f;
  Capture mine = drawn({line_of({2.5, 1.5}, {6.5, 3.5})}, {{{4, 3}}}), theirs = mine;
  mine.planes.depth(4, 3) = 0.55;
  theirs.planes.depth = mine.planes.depth;
  theirs.planes.depth(4, 3) = 0.5;
  EXPECT_TRUE(passes(compare_depth_planes(scene, mine, theirs, 4)));
  for (const double z : {0.5 - 2e-5, 0.525, 0.6}) {  // between the two is neither
    theirs.planes.depth(4, 3) = z;
    EXPECT_TRUE(fails(compare_depth_planes(scene, mine, theirs, 4)));
  }
  theirs.planes.depth(4, 3) = 0.55;
  EXPECT_TRUE(passes(compare_depth_planes(scene, mine, theirs, 4)));

  // Red is 0.4 of the way back, 0.5 by the major axis; as codes 102 and 128.
  mine.planes.shaded = Plane<glm::vec4>(16, 12, glm::vec4(0));
  mine.planes.shaded(4, 3) = {0.4f, 0.6f, 0, 1};
  theirs.planes.shaded = mine.planes.color = mine.planes.shaded;
  const auto with_red = [&](float red, float green) {
    theirs.planes.shaded(4, 3) = {red, green, 0, 1};
    theirs.planes.color = theirs.planes.shaded;
  };
  const auto shaded = [&] { return compare_shaded_planes(scene, mine, theirs, 8); };
  const auto codes = [&] { return compare_codes(scene, mine, theirs, 1, 8); };
  with_red(0.5f, 0.5f);
  EXPECT_TRUE(passes(shaded()));
  EXPECT_TRUE(passes(codes()));
  with_red(0.4f, 0.6f);
  EXPECT_TRUE(passes(shaded()));
  EXPECT_TRUE(passes(codes()));
  with_red(0.45f, 0.55f);
  EXPECT_TRUE(fails(shaded()));
  EXPECT_TRUE(fails(codes()));
}

}  // namespace
}  // namespace plumbline::check
