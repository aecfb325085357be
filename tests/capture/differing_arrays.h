// Names of the arrays in which two captures differ by a bit.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/capture.h"
#include "capture/capture_columns.h"
#include "capture/same_bits.h"

namespace plumbline::test {

struct DifferingArrays {
  std::vector<std::string> records, planes;  ///< as a capture folder names them: "vertex.p_clip", "planes.color"

  template <class Record>
  void group(Handed group, const auto& columns, const std::vector<Record>& a, const std::vector<Record>& b) {
    columns.each([&](const auto& column) {
      if (packed(a, column) != packed(b, column)) records.push_back(fmt::format("{}.{}", group.name, column.name));
    });
  }
  template <class T>
  void plane(Handed handed, const Plane<T>& a, const Plane<T>& b) {
    if (!have_same_bits(a, b)) planes.emplace_back(handed.name);
  }
};

inline std::vector<std::string> differing_records(const Capture& a, const Capture& b) {
  DifferingArrays out;
  visit_capture(out, a, b);
  return out.records;
}
inline std::vector<std::string> differing_planes(const Capture& a, const Capture& b) {
  DifferingArrays out;
  visit_capture(out, a, b);
  return out.planes;
}

inline void expect_same_captures(const Capture& a, const Capture& b) {
  ASSERT_FALSE(a.planes.color.empty());
  EXPECT_THAT(differing_records(a, b), testing::IsEmpty());
  EXPECT_THAT(differing_planes(a, b), testing::IsEmpty());
}

}  // namespace plumbline::test
