// The comparators of stage 3: polygons as polygons, and polygon positions rebuilt from the window.
#include <functional>

#include "check/compare_records.h"
#include "check_fixtures.h"

namespace plumbline::check {
namespace {

using Change = std::function<void(Records<double>&)>;
constexpr auto kUnchanged = [](Records<double>&) {};

struct ClipTriangle {
  glm::dvec4 a, b, c;
};

// One draw of triangles given in clip space. Primitive 0 lies inside, 1 has one corner behind the near plane and is cut
// to four vertices, 2 sticks out at the right and is cut to four, 3 lies inside.
struct Polygons : testing::Test {
  Polygons() {
    set({{{-0.5, -0.5, 0, 1}, {0.5, -0.25, 0.25, 1}, {0, 0.75, 0.5, 2}},
         {{-1, -1, -1, 2}, {1, -0.5, 0, 2}, {0.25, 0.5, -4, 3}},
         {{0, 0, 0, 1}, {3, 0.25, 0.5, 1}, {0.25, 0.75, 0.25, 1}},
         {{0.25, 0.25, 0, 1}, {0.5, 0.25, 0, 1}, {0.25, 0.5, 0, 1}}});
  }
  void set(const std::vector<ClipTriangle>& triangles) {
    scene = {};
    scene.meshes.resize(1);
    scene.draws.resize(1);
    records = {};
    for (const auto& [a, b, c] : triangles) {
      const auto first = static_cast<std::uint32_t>(records.vertices.size());
      scene.meshes[0].triangles.emplace_back(first, first + 1, first + 2);
      for (int i = 0; i < 3; ++i) {
        scene.meshes[0].positions.emplace_back(0);
        records.vertices.push_back({{}, i == 0 ? a : i == 1 ? b : c, {}});
        records.lit.push_back({glm::dvec4(0.25 * i, 0.5, 0.75 - 0.25 * i, 1)});
      }
    }
    Capture in;
    in.records = records;
    records.polygons = exact::make_exact()->run_stage(scene, Stage::clip, in).records.polygons;
  }
  Measurement compare(const Change& candidate, const Change& reference = kUnchanged) const {
    Records<double> a = records, b = records;
    candidate(a);
    reference(b);
    return compare_polygons(scene, a, b, kFactor);
  }
  // Vertex i of a primitive's polygon.
  static ClipVertex<double>& at(Records<double>& r, std::size_t primitive, std::uint32_t i) {
    return r.polygons.vertices[r.polygons.polygons[primitive].first + i];
  }
  // The numbers, within a polygon, of its vertices that a cut made.
  std::vector<std::uint32_t> cuts(std::size_t primitive) {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < records.polygons.polygons[primitive].count; ++i) {
      if (at(records, primitive, i).cut) out.push_back(i);
    }
    return out;
  }
  static void erase_vertex(Records<double>& r, std::size_t primitive, std::uint32_t i) {
    auto& [vertices, polygons] = r.polygons;
    vertices.erase(vertices.begin() + polygons[primitive].first + i);
    --polygons[primitive].count;
    for (std::size_t p = primitive + 1; p < polygons.size(); ++p) --polygons[p].first;
  }
  static void repeat_vertex(Records<double>& r, std::size_t primitive, std::uint32_t i) {
    auto& [vertices, polygons] = r.polygons;
    const auto place = vertices.begin() + polygons[primitive].first + i;
    vertices.insert(place, *place);
    ++polygons[primitive].count;
    for (std::size_t p = primitive + 1; p < polygons.size(); ++p) ++polygons[p].first;
  }
  // Moves a vertex a share of the way to another one, colour and all.
  static void slide(ClipVertex<double>& v, const ClipVertex<double>& to, double share) {
    v.p_clip += share * (to.p_clip - v.p_clip);
    v.color += share * (to.color - v.color);
  }
  static constexpr double kFactor = 8;
  Scene scene;
  Records<double> records;
};

TEST_F(Polygons, EqualOnesPass) {
  ASSERT_EQ(cuts(1).size(), 2u);
  ASSERT_EQ(cuts(2).size(), 2u);
  const Measurement m = compare(kUnchanged);
  EXPECT_TRUE(passes(m));
  EXPECT_EQ(m.items, 4u);
  EXPECT_EQ(m.ambiguous, 0u);
}

TEST_F(Polygons, AVertexOfTheMeshMovedByOneUlpFails) {
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::uint32_t i = 0; i < records.polygons.polygons[p].count; ++i) {
      if (at(records, p, i).cut) continue;
      for (int c = 0; c < 4; ++c) {
        const Change moved = [&](auto& r) { at(r, p, i).p_clip[c] = float_above(at(r, p, i).p_clip[c]); };
        const Change colored = [&](auto& r) { at(r, p, i).color[c] = float_above(at(r, p, i).color[c]); };
        for (const Change& change : {moved, colored}) {
          EXPECT_TRUE(fails(compare(change))) << p << " " << i << " " << c;
          EXPECT_TRUE(fails(compare(kUnchanged, change))) << p << " " << i << " " << c;
          EXPECT_EQ(compare(change).worst.place.record, static_cast<std::int64_t>(p));
        }
      }
    }
  }
}

TEST_F(Polygons, ACutVertexMovedByRoundingPasses) {
  for (std::size_t p : {1u, 2u}) {
    for (std::uint32_t i : cuts(p)) {
      for (int c = 0; c < 4; ++c) {
        // Coordinates are up to 4; a distance to a plane adds two of them.
        EXPECT_TRUE(passes(compare([&](auto& r) { at(r, p, i).p_clip[c] += 2 * kU; })));
        EXPECT_TRUE(passes(compare([&](auto& r) { at(r, p, i).color[c] -= 2 * kU; })));
      }
    }
  }
}

TEST_F(Polygons, ACutVertexOffItsPlaneFails) {
  // Along its edge, so that it stays on its triangle; in and out.
  for (std::size_t p : {1u, 2u}) {
    for (std::uint32_t i : cuts(p)) {
      const std::uint32_t count = records.polygons.polygons[p].count;
      for (std::uint32_t neighbour : {(i + 1) % count, (i + count - 1) % count}) {
        if (at(records, p, neighbour).cut) continue;
        for (double share : {1e-4, -1e-4, 1e-5, -1e-5}) {
          const Change off = [&](auto& r) { slide(at(r, p, i), at(r, p, neighbour), share); };
          EXPECT_TRUE(fails(compare(off))) << p << " " << i << " " << share;
          EXPECT_STREQ(compare(off).worst.place.field, "off its plane");
        }
      }
    }
  }
}

TEST_F(Polygons, ACutVertexOffItsTriangleFails) {
  for (std::size_t p : {1u, 2u}) {
    for (std::uint32_t i : cuts(p)) {
      const Change color = [&](auto& r) { at(r, p, i).color.b += 1e-5; };
      EXPECT_TRUE(fails(compare(color)));
      EXPECT_STREQ(std::string(compare(color).worst.place.field).substr(0, 7).c_str(), "off its") << "triangle or edge";
      EXPECT_TRUE(fails(compare([&](auto& r) { at(r, p, i).color.a = 1 - 1e-5; })));
    }
  }
  // The near plane, z = -w, knows nothing of x and y, the right one, x = w, nothing of y and z.
  EXPECT_TRUE(fails(compare([&](auto& r) { at(r, 1, cuts(1)[0]).p_clip.x += 1e-4; })));
  EXPECT_TRUE(fails(compare([&](auto& r) { at(r, 1, cuts(1)[1]).p_clip.y -= 1e-4; })));
  EXPECT_TRUE(fails(compare([&](auto& r) { at(r, 2, cuts(2)[0]).p_clip.y += 1e-4; })));
  EXPECT_TRUE(fails(compare([&](auto& r) { at(r, 2, cuts(2)[1]).p_clip.z -= 1e-4; })));
}

TEST_F(Polygons, ACutVertexWithTheColourOfAnotherPlaceFails) {
  for (std::size_t p : {1u, 2u}) {
    EXPECT_TRUE(fails(compare([&](auto& r) { std::swap(at(r, p, cuts(p)[0]).color, at(r, p, cuts(p)[1]).color); })));
    EXPECT_TRUE(fails(compare([&](auto& r) { at(r, p, cuts(p)[0]).color = records.lit[3 * p].color; })))
        << "not interpolated at the cut";
  }
}

TEST_F(Polygons, ACutVertexAlongTheCutButOffItsEdgeFails) {
  // Still on its plane and on its triangle's: but the polygon has lost, or gained, a corner.
  for (std::size_t p : {1u, 2u}) {
    const auto [i, j] = std::pair(cuts(p)[0], cuts(p)[1]);
    for (double share : {0.01, 0.5, 1.0, -0.01, -0.25}) {
      EXPECT_TRUE(fails(compare([&](auto& r) { slide(at(r, p, i), at(r, p, j), share); }))) << p << " " << share;
      EXPECT_TRUE(fails(compare([&](auto& r) { slide(at(r, p, j), at(r, p, i), share); }))) << p << " " << share;
    }
  }
}

TEST_F(Polygons, ACutAlongANearlyParallelEdgeMaySlideButNotLeaveItsPlane) {
  // From w - z = 1e-6 inside the far plane to 1e-6 outside: rounding decides where along the edge it is cut.
  set({{{-0.5, 0, 1 - 1e-6, 1}, {0.5, 0, 1 + 1e-6, 1}, {0, -0.5, 0, 1}}});
  const auto which = cuts(0);
  ASSERT_EQ(which.size(), 2u);
  for (std::uint32_t i : which) {
    const glm::dvec4 p = at(records, 0, i).p_clip;
    if (p.y < -1e-9) continue;  // the one on the nearly parallel edge
    const ClipVertex<double> a{records.vertices[0].p_clip, records.lit[0].color, false};
    EXPECT_TRUE(passes(compare([&](auto& r) { slide(at(r, 0, i), a, 0.1); })));
    EXPECT_TRUE(passes(compare([&](auto& r) { slide(at(r, 0, i), a, -0.1); })));
    EXPECT_TRUE(fails(compare([&](auto& r) { slide(at(r, 0, i), a, 0.9); }))) << "by more than rounding";
    EXPECT_TRUE(fails(compare([&](auto& r) { slide(at(r, 0, i), a, -0.9); })));
  }
}

TEST_F(Polygons, OutsideAnotherPlaneFails) {
  // Cut by two planes; on both of them at one vertex, off the second at the other.
  set({{{0, 0, 0, 1}, {4, 0.5, 0, 1}, {0.25, 4, 0, 1}}});
  for (std::uint32_t i : cuts(0)) {
    const glm::dvec4 p = at(records, 0, i).p_clip;
    const bool on_right = std::abs(p.w - p.x) < 1e-9;
    EXPECT_TRUE(fails(compare([&](auto& r) { at(r, 0, i).p_clip[on_right ? 1 : 0] = 1.001; })));
    EXPECT_TRUE(fails(compare([&](auto& r) { at(r, 0, i).p_clip[on_right ? 0 : 1] = 1.001; })));
  }
}

TEST_F(Polygons, ALostOrAnExtraVertexFails) {
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::uint32_t i = 0; i < records.polygons.polygons[p].count; ++i) {
      const Change lost = [&](auto& r) { erase_vertex(r, p, i); };
      const Change extra = [&](auto& r) { repeat_vertex(r, p, i); };
      for (const Change& change : {lost, extra}) {
        EXPECT_TRUE(fails(compare(change))) << p << " " << i;
        EXPECT_TRUE(fails(compare(kUnchanged, change))) << p << " " << i;
        EXPECT_EQ(compare(change).worst.place.record, static_cast<std::int64_t>(p));
        EXPECT_EQ(compare(change).ambiguous, 0u);
      }
    }
  }
}

TEST_F(Polygons, WrongMarksOfCutsFail) {
  EXPECT_TRUE(fails(compare([](auto& r) { at(r, 0, 1).cut = true; })));
  EXPECT_TRUE(fails(compare([&](auto& r) { at(r, 1, cuts(1)[0]).cut = false; })));
}

TEST_F(Polygons, ReversedOrInAnotherOrderFails) {
  for (std::size_t p = 0; p < 4; ++p) {
    const Change reversed = [&](auto& r) {
      const auto first = r.polygons.vertices.begin() + r.polygons.polygons[p].first;
      std::reverse(first, first + r.polygons.polygons[p].count);
    };
    EXPECT_TRUE(fails(compare(reversed))) << p;
  }
}

TEST_F(Polygons, WhatIsNoNumberFails) {
  for (double bad : not_numbers()) {
    for (std::size_t p = 0; p < 3; ++p) {
      for (std::uint32_t i = 0; i < records.polygons.polygons[p].count; ++i) {
        for (int c = 0; c < 4; ++c) {
          EXPECT_TRUE(fails(compare([&](auto& r) { at(r, p, i).p_clip[c] = bad; }))) << p << i << c << bad;
          EXPECT_TRUE(fails(compare([&](auto& r) { at(r, p, i).color[c] = bad; })))
              << "the colour of " << (at(records, p, i).cut ? "a cut" : "a corner") << " is " << bad;
        }
      }
    }
  }
}

TEST_F(Polygons, MissingExtraAndMisnumberedPolygonsFail) {
  const auto erase = [](std::size_t p) {
    return [p](auto& r) { r.polygons.polygons.erase(r.polygons.polygons.begin() + static_cast<std::ptrdiff_t>(p)); };
  };
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_TRUE(fails(compare(erase(p))));
    EXPECT_STREQ(compare(erase(p)).worst.place.field, "polygon lacking");
    EXPECT_EQ(compare(erase(p)).worst.place.record, static_cast<std::int64_t>(p));
    EXPECT_EQ(compare(erase(p)).items, 4u);
    EXPECT_TRUE(fails(compare(kUnchanged, erase(p))));
    EXPECT_STREQ(compare(kUnchanged, erase(p)).worst.place.field, "polygon extra");
  }
  EXPECT_TRUE(fails(compare([](auto& r) { r.polygons = {}; }), 4));
  EXPECT_TRUE(fails(compare(kUnchanged, [](auto& r) { r.polygons = {}; }), 4));
  EXPECT_FALSE(passes(compare([](auto& r) { r.polygons.polygons[3].primitive = 2; })));
}

TEST_F(Polygons, RecordsThatDoNotFitTheSceneFailAndDoNotCrash) {
  EXPECT_FALSE(passes(compare([](auto& r) { r.polygons.polygons[3].primitive = 4; }))) << "a primitive of no draw";
  EXPECT_FALSE(passes(compare([](auto& r) { r.polygons.polygons[0].primitive = 1u << 31; })));
  EXPECT_FALSE(passes(compare([](auto& r) { r.vertices.clear(); }))) << "no vertices to hold the polygons to";
  EXPECT_FALSE(passes(compare([](auto& r) { r.lit.clear(); })));
  EXPECT_FALSE(passes(compare([](auto& r) { r = {}; })));
}

TEST_F(Polygons, OutOfDrawOrderFailsAndDoesNotCrash) {
  scene.draws.resize(2);
  scene.meshes.resize(2, scene.meshes[0]);
  scene.draws[1].mesh = 1;
  records.vertices.insert(records.vertices.end(), records.vertices.begin(), records.vertices.end());
  records.lit.insert(records.lit.end(), records.lit.begin(), records.lit.end());
  for (std::size_t p = 0; p < 4; ++p) {
    records.polygons.polygons.push_back(records.polygons.polygons[p]);
    records.polygons.polygons.back().primitive += 4;
  }
  EXPECT_TRUE(passes(compare(kUnchanged)));
  EXPECT_EQ(compare(kUnchanged).items, 8u);
  EXPECT_FALSE(passes(compare([](auto& r) { std::swap(r.polygons.polygons[0], r.polygons.polygons[7]); })));
}

TEST_F(Polygons, ACornerOnAPlaneLeavesTheNumberOfVerticesOpen) {
  // One corner within rounding outside the near plane: cut to four vertices, or left as three.
  for (double off : {0.0, -1e-7, 4 * kU}) {
    set({{{-0.5, 0, 0, 1}, {0.5, 0, 0, 1}, {0, 0.5, -1 - off, 1}}});
    Records<double> other = records;
    if (records.polygons.polygons[0].count == 3) {
      repeat_vertex(other, 0, 2);
    } else {
      erase_vertex(other, 0, cuts(0)[0]);
    }
    const Measurement m = compare_polygons(scene, other, records, kFactor);
    EXPECT_TRUE(passes(m)) << off;
    EXPECT_EQ(m.ambiguous, 1u);
  }
}

TEST_F(Polygons, ACornerOnAPlaneIsNoExcuseForALostPolygon) {
  // The corner that is on the near plane is legal either way; the triangle is there all the same.
  set({{{-0.5, 0, 0, 1}, {0.5, 0, 0, 1}, {0, 0.5, -1, 1}}});
  EXPECT_TRUE(fails(compare([](auto& r) { r.polygons = {}; })));
  // A square over the whole view, its corners on the planes.
  set({{{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}}, {{-1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}}});
  EXPECT_TRUE(fails(compare([](auto& r) { r.polygons = {}; }), 2));
}

TEST_F(Polygons, NorForALostCorner) {
  // A corner on the left plane leaves open whether it is cut there, not what the right plane cuts.
  set({{{-1, 0, 0, 1}, {4, 0.25, 0, 1}, {0.25, 0.75, 0, 1}}});
  ASSERT_EQ(records.polygons.polygons[0].count, 4u);
  EXPECT_TRUE(fails(compare([&](auto& r) { erase_vertex(r, 0, cuts(0)[0]); })));
  EXPECT_TRUE(fails(compare([&](auto& r) {
    erase_vertex(r, 0, 3);
    erase_vertex(r, 0, 2);
  })));
}

TEST_F(Polygons, ATriangleWithinRoundingOfAPlaneMayVanish) {
  set({{{-0.5, 0, 1 - 1e-7, 1}, {0.5, 0, 1, 1}, {0, 0.5, 1, 1}}});
  ASSERT_EQ(records.polygons.polygons.size(), 1u);
  const Measurement m = compare([](auto& r) { r.polygons = {}; });
  EXPECT_TRUE(passes(m));
  EXPECT_EQ(m.ambiguous, 1u);
}

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

}  // namespace
}  // namespace plumbline::check
