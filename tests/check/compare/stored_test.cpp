// Comparisons of what is stored: captures array by array, channels by name, the picture of the difference.
#include "check/compare/compare_stored.h"

#include <algorithm>
#include <map>

#include "capture/capture_columns.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

using Channel = StoredImage::Channel;

std::map<std::string, Outcome> outcomes(const std::vector<StoredComparison>& rows) {
  std::map<std::string, Outcome> out;
  for (const StoredComparison& row : rows) EXPECT_TRUE(out.emplace(row.what, row.outcome).second) << row.what;
  return out;
}

void bump(bool& v) { v = !v; }
void bump(std::integral auto& v) { ++v; }
void bump(std::floating_point auto& v) { v += 0.5f; }
void bump(auto& v) { bump(v[v.length() - 1]); }  // of a vector or a matrix

// Changes the last element of one array of a capture.
struct Harm {
  int array;  // counted in visit_capture's order
  int seen = 0;
  std::string name{};

  template <class Record>
  void group(Handed group, const auto& columns, std::vector<Record>& records) {
    columns.each([&](const auto& c) { column(group.name, records, c); });
  }
  template <class T>
  void plane(Handed plane, Plane<T>& values) {
    if (values.empty() || seen++ != array) return;
    bump(values.values().back());
    name = plane.name;
  }
  template <class Record, class C>
  void column(std::string_view group, std::vector<Record>& records, const C& column) {
    if (records.empty() || seen++ != array) return;
    auto& value = column.at(records.back(), kPerRecord<C> - 1);
    bump(value);
    name = std::string(group) + "." + std::string(column.name);
  }
};

Capture whole_capture() {
  Capture c = exact_capture(two_draws());
  EXPECT_FALSE(c.records.shaded.empty());
  EXPECT_FALSE(c.planes.depth.empty());
  return c;
}

TEST(StoredCaptures, EveryArrayIsComparedAndNamed) {
  const Capture whole = whole_capture();
  const auto same = outcomes(compare_captures(whole, whole, 0));
  EXPECT_EQ(same.size(), 38u);
  for (const auto& [name, outcome] : same) EXPECT_EQ(outcome, Outcome::equal) << name;
  int arrays = 0;
  for (;; ++arrays) {
    Capture harmed = whole;
    Harm harm{arrays};
    visit_capture(harm, harmed);
    if (harm.name.empty()) break;
    SCOPED_TRACE(harm.name);
    for (const auto& rows : {compare_captures(whole, harmed, 0.25), compare_captures(harmed, whole, 0.25)}) {
      for (const StoredComparison& row : rows) {
        EXPECT_EQ(row.outcome, row.what == harm.name ? Outcome::different : Outcome::equal) << row.what;
        EXPECT_TRUE(row.what != harm.name || fails(row.measurement));
      }
    }
  }
  EXPECT_EQ(arrays, 38);
}

TEST(StoredCaptures, ColumnsThatOneSideLeavesOutAreMissing) {
  const Capture whole = whole_capture();
  Capture less = whole;
  less.derived = {"window.front"};
  less.records.triangles[0].front = !less.records.triangles[0].front;
  EXPECT_EQ(outcomes(compare_captures(whole, less, 0))["window.front"], Outcome::missing);
  EXPECT_EQ(outcomes(compare_captures(less, whole, 0))["window.front"], Outcome::missing);
  EXPECT_EQ(outcomes(compare_captures(less, whole, 0))["window.p_win"], Outcome::equal);
  EXPECT_FALSE(outcomes(compare_captures(less, less, 0)).contains("window.front"));
}

TEST(StoredCaptures, ToleranceIsForFloatsAlone) {
  const Capture whole = whole_capture();
  Capture near = whole;
  near.records.depth[0] += 0.25;
  near.planes.count(0, 0) += 1;
  near.records.triangles[0].v[0].snapped.x += 1;
  auto rows = outcomes(compare_captures(whole, near, 10));
  EXPECT_EQ(rows["depth.value"], Outcome::within);
  EXPECT_EQ(rows["planes.count"], Outcome::different);
  EXPECT_EQ(rows["window.snapped"], Outcome::different);
  near = whole;
  near.planes.id_sum(0, 0) ^= 1;
  near.planes.id_sum(1, 0) = whole.planes.id_sum(1, 0) + (std::uint64_t{1} << 63);  // no double, no signed number
  for (const StoredComparison& row : compare_captures(whole, near, 10)) {
    EXPECT_TRUE(row.what != "planes.id_sum" || fails(row.measurement, 2));
  }
}

TEST(StoredCaptures, NoNumberIsNoNumber) {
  const Capture whole = whole_capture();
  for (double odd : not_numbers()) {
    Capture harmed = whole;
    harmed.records.vertices[1].p_clip.w = odd;
    harmed.planes.shaded(3, 4).g = static_cast<float>(odd);
    auto rows = outcomes(compare_captures(whole, harmed, 1e300));
    EXPECT_EQ(rows["vertex.p_clip"], Outcome::different) << odd;
    EXPECT_EQ(rows["planes.shaded"], Outcome::different) << odd;
    EXPECT_EQ(rows["vertex.p_eye"], Outcome::equal);
    rows = outcomes(compare_captures(harmed, harmed, 0));
    EXPECT_EQ(rows["vertex.p_clip"], std::isnan(odd) ? Outcome::different : Outcome::equal) << odd;
  }
}

TEST(StoredCaptures, WhatOneAloneHoldsIsMissingAndNamed) {
  const Capture whole = whole_capture();
  Capture part = whole;
  part.records.covered.clear();
  part.planes.id_sum = {};
  for (bool turned : {false, true}) {
    const auto rows = turned ? compare_captures(part, whole, 0) : compare_captures(whole, part, 0);
    std::size_t missing = 0;
    for (const StoredComparison& row : rows) {
      if (row.outcome != Outcome::missing) continue;
      ++missing;
      EXPECT_TRUE(row.what == "coverage" || row.what == "planes.id_sum") << row.what;
      EXPECT_TRUE(row.note.starts_with(turned ? "B holds " : "A holds ")) << row.note;
    }
    EXPECT_EQ(missing, 2u);
  }
  EXPECT_TRUE(compare_captures({}, {}, 0).empty()) << "nothing is held, nothing compared";
}

TEST(StoredCaptures, OtherNumbersAndSizesAreTold) {
  const Capture whole = whole_capture();
  Capture other = whole;
  other.records.triangles.pop_back();
  other.width = whole.height;
  other.height = whole.width;
  other.planes.depth = Plane<double>(whole.height, whole.width);
  auto rows = compare_captures(whole, other, 1e300);
  EXPECT_EQ(rows.front().what, "frame");
  EXPECT_EQ(rows.front().note, "24 x 16 against 16 x 24");
  auto by_name = outcomes(rows);
  for (const char* name : {"frame", "window.p_win", "window.front", "planes.depth"}) {
    EXPECT_EQ(by_name[name], Outcome::different) << name;
  }
  EXPECT_EQ(by_name["planes.color"], Outcome::equal);
  by_name = outcomes(compare_captures(other, whole, 1e300));  // the fewer first
  EXPECT_EQ(by_name["window.p_win"], Outcome::different);
  EXPECT_EQ(by_name["window.front"], Outcome::different);
}

TEST(StoredCaptures, FramesOfAnotherWidthOrHeightAreTold) {
  const Capture whole = whole_capture();
  Capture wider = whole, higher = whole;  // of their planes, as they are handed out, the sizes are compared by plane
  ++wider.width, ++higher.height;
  EXPECT_EQ(outcomes(compare_captures(whole, whole, 0)).count("frame"), 0u);
  for (const Capture& other : {wider, higher}) {
    EXPECT_EQ(outcomes(compare_captures(whole, other, 0))["frame"], Outcome::different);
    EXPECT_EQ(outcomes(compare_captures(other, whole, 0))["frame"], Outcome::different);
  }
}

StoredImage image_of(std::vector<std::pair<std::string, double>> channels) {
  StoredImage image;
  image.data = image.display = {0, 0, 2, 1};
  for (const auto& [name, value] : channels) image.channels.push_back({name, 1, Plane<double>(2, 1, value)});
  return image;
}

TEST(StoredImages, ChannelsArePairedByName) {
  const StoredImage rgb = image_of({{"R", 1}, {"G", 2}, {"B", 3}}), bgr = image_of({{"B", 3}, {"G", 2}, {"R", 1}});
  for (const auto& [name, outcome] : outcomes(compare_images(rgb, bgr, 0))) EXPECT_EQ(outcome, Outcome::equal) << name;
  // A channel that is missing is told, and the others are compared all the same.
  auto rows = outcomes(compare_images(rgb, image_of({{"R", 1}, {"G", 5}}), 0));
  EXPECT_EQ(rows["channels"], Outcome::different);
  EXPECT_EQ(rows["R"], Outcome::equal);
  EXPECT_EQ(rows["G"], Outcome::different);
  // Two of one name: by place, as the files agree.
  const StoredImage twice = image_of({{"x", 1}, {"x", 2}}), other = image_of({{"x", 1}, {"x", 3}});
  EXPECT_EQ(compare_images(twice, other, 0).back().outcome, Outcome::different);
  EXPECT_EQ(compare_images(twice, twice, 0).back().outcome, Outcome::equal);
  // A channel is the other side's once.
  const auto has_difference = [](const StoredImage& a, const StoredImage& b) {
    const auto differs = [](const StoredComparison& row) { return row.outcome == Outcome::different; };
    return std::ranges::any_of(compare_images(a, b, 0), differs);
  };
  EXPECT_TRUE(has_difference(image_of({{"R", 1}, {"R", 1}}), image_of({{"R", 1}, {"G", 5}})));
  EXPECT_TRUE(has_difference(image_of({{"R", 1}, {"G", 5}}), image_of({{"R", 1}, {"R", 1}})));
}

TEST(StoredImages, TheDifferenceIsAmplified) {
  const StoredImage a = image_of({{"R", 0}, {"G", 0}, {"B", 0}, {"A", 1}});
  StoredImage b = a;
  b.channels[0].values(0, 0) = 0.25;
  b.channels[2].values(0, 0) = -0.125;
  EXPECT_EQ(amplified_difference(a, b, {})(0, 0), glm::vec4(1, 0, 0.5, 1)) << "the largest is white";
  EXPECT_EQ(amplified_difference(a, b, {})(1, 0), glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(amplified_difference(a, b, 2.0)(0, 0), glm::vec4(0.5, 0, 0.25, 1));
  EXPECT_EQ(amplified_difference(a, b, 100.0)(0, 0), glm::vec4(1, 0, 1, 1));
  EXPECT_EQ(amplified_difference(a, a, {})(0, 0), glm::vec4(0, 0, 0, 1));
  StoredImage alpha = a;
  alpha.channels[3].values(1, 0) = 0.5;
  EXPECT_EQ(amplified_difference(a, alpha, 1.0)(1, 0), glm::vec4(0.5, 0.5, 0.5, 1)) << "seen, though opaque";
  for (double odd : not_numbers()) {
    StoredImage c = b;
    c.channels[1].values(1, 0) = odd;
    EXPECT_EQ(amplified_difference(a, c, {})(1, 0), glm::vec4(0, 1, 0, 1)) << odd;
    EXPECT_EQ(amplified_difference(a, c, {})(0, 0), glm::vec4(1, 0, 0.5, 1)) << "of the finite ones";
  }
  const StoredImage z = image_of({{"Z", 1}}), y = image_of({{"Y", 0.5}});
  EXPECT_EQ(amplified_difference(z, y, 1.0)(0, 0), glm::vec4(0.5, 0.5, 0.5, 1));
  StoredImage wide = a;
  wide.data.width = 3;
  EXPECT_TRUE(amplified_difference(a, wide, {}).empty());
  EXPECT_TRUE(amplified_difference(a, z, {}).empty());
}

}  // namespace
}  // namespace plumbline::check
