// The comparator of polygon positions that a reference rebuilt from the window; the vertex taken for the first.
#include <set>
#include <string_view>
#include <utility>

#include "tests/check/polygons/polygons.h"

namespace plumbline::check {
namespace {

// The same records, with vertices in other turns, as a reference rebuilds them.
struct PolygonPositions : Polygons {
  Measurement positions(const Change& candidate, const Change& reference = kUnchanged) const {
    Records<double> a = records, b = records;
    candidate(a);
    reference(b);
    return compare_polygon_positions(a, b, kFactor);
  }
  static void rotate(Records<double>& r, std::size_t p, std::uint32_t by) {
    const auto first = r.polygons.vertices.begin() + r.polygons.polygons[p].first;
    std::rotate(first, first + by, first + r.polygons.polygons[p].count);
  }
};

TEST_F(PolygonPositions, MayBeginAnywhereButNotGoRoundTheOtherWay) {
  EXPECT_TRUE(passes(positions(kUnchanged)));
  EXPECT_EQ(positions(kUnchanged).max_difference, 0);
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::uint32_t by = 1; by < records.polygons.polygons[p].count; ++by) {
      EXPECT_TRUE(passes(positions([&](auto& r) { rotate(r, p, by); }))) << p << " " << by;
      EXPECT_TRUE(passes(positions(kUnchanged, [&](auto& r) { rotate(r, p, by); }))) << p << " " << by;
    }
    EXPECT_TRUE(fails(positions([&](auto& r) {
      const auto first = r.polygons.vertices.begin() + r.polygons.polygons[p].first;
      std::reverse(first, first + r.polygons.polygons[p].count);
    }))) << p;
  }
}

TEST_F(PolygonPositions, EveryCoordinateIsHeldToItsSizeAndThatOfW) {
  for (std::size_t p : {0u, 1u}) {
    for (std::uint32_t i = 0; i < records.polygons.polygons[p].count; ++i) {
      for (int c = 0; c < 4; ++c) {
        const glm::dvec4 q = at(records, p, i).p_clip;
        const double unit = kU * (std::abs(q[c]) + std::abs(q.w));
        const auto moved = [&](double by) { return [&, by](auto& r) { at(r, p, i).p_clip[c] += by * unit; }; };
        EXPECT_TRUE(passes(positions(moved(0.99 * kFactor))));
        EXPECT_TRUE(fails(positions(moved(-1.01 * kFactor))));
        EXPECT_NEAR(positions(moved(5)).max_difference, 5, 1e-6);
      }
    }
  }
}

TEST_F(PolygonPositions, OtherNumbersOfPolygonsOrVerticesFail) {
  for (std::size_t p = 0; p < 4; ++p) {
    const Change lost = [&](auto& r) { erase_vertex(r, p, 1); };
    const Change gone = [&](auto& r) { r.polygons.polygons.erase(r.polygons.polygons.begin() + static_cast<int>(p)); };
    for (const Change& change : {lost, gone}) {
      EXPECT_TRUE(fails(positions(change)));
      EXPECT_TRUE(fails(positions(kUnchanged, change)));
      EXPECT_EQ(positions(change).worst.place.record, static_cast<std::int64_t>(p));
    }
  }
  EXPECT_TRUE(fails(positions([](auto& r) { r = {}; }), 4));
}

TEST_F(PolygonPositions, WhatIsNoNumberFailsOnEitherSide) {
  for (double bad : not_numbers()) {
    for (int c = 0; c < 4; ++c) {
      const Change change = [&](auto& r) { at(r, 1, 2).p_clip[c] = bad; };
      EXPECT_TRUE(fails(positions(change))) << bad << " " << c;
      EXPECT_TRUE(fails(positions(kUnchanged, change))) << "the reference: " << bad << " " << c;
    }
  }
}

// Colours of a small cut triangle, each the next vertex': the colour is named, and no vertex of another place.
TEST_F(Polygons, WrongColoursAreNotTakenForAnotherFirstVertex) {
  set({{{0, 0, -0.99, 1}, {0.01, 0, -0.99, 1}, {0, 0.01, -1.01, 1}}});
  const Measurement m = compare([](Records<double>& r) {
    auto& vertices = r.polygons.vertices;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) std::swap(vertices[i].color, vertices[i + 1].color);
  });
  EXPECT_TRUE(fails(m));
  const std::set<std::string_view> of_colors = {"color", "off its triangle", "off its edge"};
  EXPECT_TRUE(of_colors.contains(m.worst.place.field)) << m.worst.place.field;
}

}  // namespace
}  // namespace plumbline::check
