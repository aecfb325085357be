// Two captures that must be the same bits.
#pragma once

#include <cstring>

#include <gtest/gtest.h>

#include "capture/capture.h"
#include "check/compare/compare_stored.h"

namespace plumbline::test {

template <class T>
void expect_same_bits(const Plane<T>& a, const Plane<T>& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  if (a.size() == 0) return;
  EXPECT_EQ(std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(T)), 0) << what;
}

/// Planes as bytes; all records, windows among them, as numbers.
inline void expect_same_captures(const Capture& a, const Capture& b) {
  ASSERT_GT(a.planes.color.size(), 0u);
  expect_same_bits(a.planes.count, b.planes.count, "count");
  expect_same_bits(a.planes.id_sum, b.planes.id_sum, "id_sum");
  expect_same_bits(a.planes.id, b.planes.id, "id");
  expect_same_bits(a.planes.stencil, b.planes.stencil, "stencil");
  expect_same_bits(a.planes.texel, b.planes.texel, "texel");
  expect_same_bits(a.planes.shaded, b.planes.shaded, "shaded");
  expect_same_bits(a.planes.color, b.planes.color, "color");
  expect_same_bits(a.planes.depth, b.planes.depth, "depth");
  int windows = 0;
  for (const check::StoredComparison& row : check::compare_captures(a, b, 0)) {
    EXPECT_EQ(row.outcome, check::Outcome::equal) << row.what << ' ' << row.note;
    windows += row.what == "window.snapped" || row.what == "window.p_win";
  }
  EXPECT_EQ(windows, a.records.triangles.empty() ? 0 : 2);
}

}  // namespace plumbline::test
