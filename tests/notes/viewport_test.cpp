// Class notes (004): X_sp is the window's corner at 0, its pixels' samples at whole numbers (2.1). GL and GAMES101
// (001) sample at halves: half a pixel apart, and the whole numbers are not even about the middle.
#include <cmath>

#include <gtest/gtest.h>

#include "transforms/transform.h"
#include "transforms/viewport.h"

namespace plumbline::transforms {
namespace {

constexpr int kColumns = 8, kRows = 4;

glm::dvec2 ndc_of(const glm::dmat4& inverse, double x, double y) {
  return glm::dvec2(inverse * glm::dvec4(x, y, 0, 1));
}

// Row j is counted from above in both.
glm::dvec2 sample_by_004(int i, int j) { return ndc_of(gzrender::inverse_x_sp(kColumns, kRows, 1), i, j); }
glm::dvec2 sample_by_gl(int i, int j) {
  return ndc_of(games101::inverse_viewport(kColumns, kRows), i + 0.5, kRows - (j + 0.5));
}

TEST(NotesViewport, APixelOfTheNotesLooksHalfAPixelUpAndLeftOfGls) {
  EXPECT_EQ(sample_by_004(0, 0), glm::dvec2(-1, 1)) << "the frame's very corner";
  EXPECT_EQ(sample_by_gl(0, 0), glm::dvec2(-0.875, 0.75)) << "the middle of the corner's pixel";
  const glm::dvec2 half_a_pixel(1.0 / kColumns, -1.0 / kRows);
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) EXPECT_EQ(sample_by_gl(i, j) - sample_by_004(i, j), half_a_pixel);
  }
}

// How many of the frame's columns have their sample within [from, to) of NDC x.
int columns(glm::dvec2 (*sample)(int, int), double from, double to) {
  int count = 0;
  for (int i = 0; i < kColumns; ++i) {
    const double x = sample(i, 0).x;
    count += x >= from && x < to ? 1 : 0;
  }
  return count;
}

TEST(NotesViewport, WhatIsEvenAboutTheMiddleIsDrawnUneven) {
  // From 1.8 to 6.2 in pixels: by the notes the samples 2 to 6, by GL 2.5 to 5.5.
  EXPECT_EQ(columns(sample_by_004, -0.55, 0.55), 5);
  EXPECT_EQ(columns(sample_by_gl, -0.55, 0.55), 4);
  // Two columns of samples left of the middle, and, with the middle's own, three right of it.
  EXPECT_EQ(columns(sample_by_004, -0.55, 0), 2);
  EXPECT_EQ(columns(sample_by_004, 0, 0.55), 3);
  EXPECT_EQ(columns(sample_by_gl, -0.55, 0), 2);
  EXPECT_EQ(columns(sample_by_gl, 0, 0.55), 2);
  // "X in [0, xs)", but NDC x = 1 is xs: a sample that no pixel has.
  EXPECT_EQ((gzrender::x_sp(kColumns, kRows, 1) * glm::dvec4(1, 0, 0, 1)).x, kColumns);
}

TEST(NotesViewport, HalfAPixelPutsItRight) {
  const glm::dmat4 moved = translation({-0.5, -0.5, 0}) * gzrender::x_sp(kColumns, kRows, 1);
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      EXPECT_EQ(moved * glm::dvec4(sample_by_gl(i, j), 0, 1), glm::dvec4(i, j, 0, 1));
    }
  }
}

}  // namespace
}  // namespace plumbline::transforms
