// A renderer may begin its window triangles at any corner.
#include "check/judge/foreign_records.h"

#include <algorithm>
#include <memory>
#include <string>

#include "check/judge/judge_single.h"
#include "reference/exact/exact.h"
#include "tests/check/judge/judge_fixtures.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

void rotate(Records<double>& r, std::size_t i, std::ptrdiff_t by) {
  std::rotate(r.triangles[i].v.begin(), r.triangles[i].v.begin() + by, r.triangles[i].v.end());
  for (const Varying v : kAllVaryings) {
    auto& columns = r.varyings[v].triangles;
    if (!columns.empty()) std::rotate(columns[i].begin(), columns[i].begin() + by, columns[i].end());
  }
}

Records<double> two_triangles() {
  Records<double> r;
  r.triangles = {triangle_of({glm::dvec3(1, 2, 0.25), {9, 3, 0.5}, {4, 7, 0.75}}, {1, 0.5, 0.25}, 0),
                 triangle_of({glm::dvec3(1, 2, 0.25), {4, 7, 0.75}, {2, 9, 0.125}}, {1, 0.25, 0.125}, 0)};
  r.varyings[Varying::texture].triangles = {{Vec4<double>(1), Vec4<double>(2), Vec4<double>(3)},
                                            {Vec4<double>(4), Vec4<double>(5), Vec4<double>(6)}};
  return r;
}

void expect_in_order(const Records<double>& mine, const Records<double>& theirs) {
  for (std::size_t i = 0; i < theirs.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(mine.triangles[i].v[k].inv_w, theirs.triangles[i].v[k].inv_w) << i << ", corner " << k;
      EXPECT_EQ(mine.varyings[Varying::texture].triangles[i][k], theirs.varyings[Varying::texture].triangles[i][k]);
    }
  }
}

TEST(RotateCorners, TurnsEachWithItsVaryings) {
  const Records<double> theirs = two_triangles();
  for (const std::ptrdiff_t first : {0, 1, 2}) {
    for (const std::ptrdiff_t second : {0, 1, 2}) {
      Records<double> mine = theirs;
      rotate(mine, 0, first), rotate(mine, 1, second);
      rotate_corners(mine, theirs);
      expect_in_order(mine, theirs);
    }
  }
}

TEST(RotateCorners, SeesWrongPositionsByTheOtherNumbers) {
  const Records<double> theirs = two_triangles();
  Records<double> mine = theirs;
  for (std::size_t i : {0u, 1u}) {
    for (WindowVertex<double>& v : mine.triangles[i].v) v.p_win.y = 61 - v.p_win.y;
    rotate(mine, i, 2);
  }
  rotate_corners(mine, theirs);
  expect_in_order(mine, theirs);
}

// A triangle so small that each corner is near the others: the nearest rotation counts.
TEST(RotateCorners, TurnsATriangleOfNearCornersToTheNearest) {
  Records<double> theirs = two_triangles();
  for (std::size_t k = 0; k < 3; ++k) {
    theirs.triangles[1].v[k] = theirs.triangles[1].v[0];
    theirs.triangles[1].v[k].inv_w += 1e-4 * static_cast<double>(k);
  }
  for (const std::ptrdiff_t by : {0, 1, 2}) {
    Records<double> mine = theirs;
    rotate(mine, 1, by);
    for (WindowVertex<double>& v : mine.triangles[1].v) v.p_win.x += 1e-8;
    rotate_corners(mine, theirs);
    expect_in_order(mine, theirs);
  }
}

// Triangle whose corners no number tells apart: it takes the usual rotation; without one, none.
TEST(RotateCorners, TakesTheUsualTurnWhereNoneIsBetter) {
  Records<double> theirs = two_triangles();
  for (WindowVertex<double>& v : theirs.triangles[1].v) v = theirs.triangles[1].v[0];
  Records<double> mine = theirs;
  rotate(mine, 1, 1);
  const Records<double> as_it_was = mine;
  rotate_corners(mine, theirs);
  expect_in_order(mine, as_it_was);
  rotate(mine, 0, 1);
  rotate_corners(mine, theirs);
  expect_in_order(mine, theirs);
}

// Begins each window triangle at the second of its corners.
void rotate_all(Capture& c) {
  for (std::size_t i = 0; i < c.records.triangles.size(); ++i) {
    if (c.records.triangles[i].corners == 3) rotate(c.records, i, 1);
  }
}

TEST(RotateCorners, HoldWhereverTheyBegin) {
  const auto exact = exact::make_exact();
  const Reference references[] = {{"exact", exact.get()}};
  for (const char* name : {"coverage/fan", "clip/each_plane", "phong/glass", "texture/clipped", "lines/widths"}) {
    OursAsAnothers turned(rotate_all);
    const Scene scene = suite_scene(name);
    const SceneVerdict verdict = judge_single(scene, turned, references);
    for (const Comparison& c : verdict.comparisons) {
      EXPECT_NE(c.outcome, Outcome::different) << name << ' ' << name_of(c.stage) << ' ' << c.note;
      EXPECT_NE(c.outcome, Outcome::failed) << name << ' ' << name_of(c.stage) << ' ' << c.note;
    }
  }
}

}  // namespace
}  // namespace plumbline::check
