// The comparator of stage 3: polygons as polygons.
#include "tests/check/polygons/polygons.h"

#include <algorithm>

namespace plumbline::check {
namespace {

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

Change rotated(std::size_t p, std::ptrdiff_t by) {
  return [=](auto& r) {
    const auto begin = r.polygons.vertices.begin() + r.polygons.polygons[p].first;
    std::rotate(begin, begin + by, begin + r.polygons.polygons[p].count);
  };
}

TEST_F(Polygons, AnyCornerMayBeTheFirst) {
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::ptrdiff_t by = 1; by < records.polygons.polygons[p].count; ++by) {
      EXPECT_TRUE(passes(compare(rotated(p, by)))) << p << " " << by;
      EXPECT_TRUE(passes(compare(kUnchanged, rotated(p, by)))) << p << " " << by;
      EXPECT_TRUE(fails(compare([&](auto& r) {
        rotated(p, by)(r);
        for (int c = 0; c < 4; ++c) at(r, p, 0).p_clip[c] += 1e-4;
      }))) << p
           << " " << by;
    }
  }
}

// Which of two cuts makes a corner where they meet is a matter of their order.
TEST_F(Polygons, WhichCutsCornerStandsTwiceDoesNotMatter) {
  for (std::size_t p : {1u, 2u}) {
    for (std::uint32_t i : cuts(p)) {
      for (std::uint32_t j : cuts(p)) {
        const Change mine = [&](auto& r) { repeat_vertex(r, p, i); };
        EXPECT_TRUE(passes(compare(mine, [&](auto& r) { repeat_vertex(r, p, j); }))) << p << " " << i << " " << j;
      }
    }
  }
}

TEST_F(Polygons, TheOtherWayRoundFails) {
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_TRUE(fails(compare([&](auto& r) {
      const auto begin = r.polygons.vertices.begin() + r.polygons.polygons[p].first;
      std::reverse(begin, begin + r.polygons.polygons[p].count);
    }))) << p;
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
    EXPECT_TRUE(fails(compare([&](auto& r) { at(r, p, cuts(p)[0]).color = records.lit[3 * p].color; })));
  }
}

TEST_F(Polygons, ACutVertexAlongTheCutButOffItsEdgeFails) {
  // Still on its plane and on its triangle's: but the polygon has lost, or gained, a corner.
  for (std::size_t p : {1u, 2u}) {
    const auto i = cuts(p)[0], j = cuts(p)[1];
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

TEST_F(Polygons, ACutAlongANearlyParallelEdgeMayNotSlideOutOfTheView) {
  // An edge that leaves through the far plane at x = 0.95 and, were it not for that, through the right one: by z it
  // moves 2e-6 for each unit of x, so that 0.1 of x is within the rounding of the far plane either way.
  set({{{0.5, 0, 1 - 0.9e-6, 1}, {1.4, 0, 1 + 0.9e-6, 1}, {0.5, -0.5, 0, 1}}});
  const ClipVertex<double> a{records.vertices[0].p_clip, records.lit[0].color, false};
  std::uint32_t cut = 0;
  for (std::uint32_t i : cuts(0)) {
    if (std::abs(at(records, 0, i).p_clip.x - 0.95) < 1e-3) cut = i;
  }
  ASSERT_NEAR(at(records, 0, cut).p_clip.x, 0.95, 1e-3);
  const auto slid_to = [&](double x) { return compare([&](auto& r) { slide(at(r, 0, cut), a, (0.95 - x) / 0.45); }); };
  EXPECT_TRUE(passes(slid_to(0.85)));
  EXPECT_TRUE(passes(slid_to(0.99)));
  EXPECT_TRUE(fails(slid_to(1.01)));
  EXPECT_STREQ(slid_to(1.01).worst.place.field, "outside a plane");
}

// A triangle over the edge of the view volume where right and top meet: the polygon has a corner there.
TEST_F(Polygons, WhereTwoPlanesMeetInsideATriangleNothingIsOpen) {
  set({{{0, 0, 0, 1}, {4, 0.5, 0, 1}, {0.25, 4, 0, 1}}});
  const auto on_both = [](const glm::dvec4& p) { return p.x == p.w && p.y == p.w; };
  int corners = 0;
  for (std::uint32_t i = 0; i < records.polygons.polygons[0].count; ++i) {
    EXPECT_TRUE(fails(compare([&](auto& r) { erase_vertex(r, 0, i); }))) << i;
    EXPECT_TRUE(fails(compare(kUnchanged, [&](auto& r) { erase_vertex(r, 0, i); }))) << i;
    if (!on_both(at(records, 0, i).p_clip)) continue;
    ++corners;
    for (double by : {-1.0, 1.0}) {
      EXPECT_TRUE(passes(compare([&](auto& r) { at(r, 0, i).p_clip.z += by * kU; })));
      EXPECT_TRUE(passes(compare([&](auto& r) { at(r, 0, i).color.g += by * kU; })));
      for (const Measurement& m : {compare([&](auto& r) { at(r, 0, i).p_clip.z += by * 1e-4; }),
                                   compare([&](auto& r) { at(r, 0, i).color.g += by * 1e-4; })}) {
        EXPECT_TRUE(fails(m));
        EXPECT_STREQ(m.worst.place.field, "off its triangle") << "it is on both planes";
      }
    }
  }
  EXPECT_EQ(corners, 1);
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

TEST_F(Polygons, NearAnotherPlaneIsNotOnIt) {
  set({{{0, 0.9985, 0, 1}, {2, 0.9995, 0, 1}, {0, 0, 0, 1}}});
  EXPECT_TRUE(passes(compare(kUnchanged)));
  EXPECT_TRUE(fails(compare([&](auto& r) { slide(at(r, 0, cuts(0)[0]), at(r, 0, cuts(0)[1]), 1e-4); })));
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

TEST_F(Polygons, AnEdgeThroughTheMeetingOfTwoPlanesLeavesTheNumberOpen) {
  // Through (1, 1): cut by the right plane there, and by the top one in the same place, or not again. What is cut off
  // elsewhere is not open.
  set({{{0.5, 1.5, 0, 1}, {1.5, 0.5, 0, 1}, {0, 0, 0, 1}}});
  ASSERT_EQ(records.polygons.polygons[0].count, 5u);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const glm::dvec4 p = at(records, 0, i).p_clip;
    const bool open = p.x == p.w && p.y == p.w;
    const Measurement m = compare([&](auto& r) { erase_vertex(r, 0, i); });
    EXPECT_EQ(passes(m), open) << i;
    EXPECT_TRUE(!open || m.ambiguous == 1) << i;
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

TEST_F(Polygons, ATriangleWithinRoundingOfAPlaneThatCutsItMayVanish) {
  set({{{-0.5, 0, 1 - 0x1p-23, 1}, {0.5, 0, 1, 1}, {0, 0.5, 1 + 0x1p-23, 1}}});
  ASSERT_EQ(records.polygons.polygons.size(), 1u);
  const Measurement m = compare([](auto& r) { r.polygons = {}; });
  EXPECT_TRUE(passes(m));
  EXPECT_EQ(m.ambiguous, 1u);
}

TEST_F(Polygons, ButNotWhereItLiesInThePlane) {
  for (const double z : {1.0, 1 - 0x1p-23}) {
    set({{{-0.5, 0, z, 1}, {0.5, 0, 1, 1}, {0, 0.5, 1, 1}}});
    ASSERT_EQ(records.polygons.polygons.size(), 1u);
    EXPECT_TRUE(fails(compare([](auto& r) { r.polygons = {}; }))) << z;
  }
}

TEST_F(Polygons, NorMayOneAppearThatLiesBeyondThePlane) {
  set({{{-0.5, 0, 1, 1}, {0.5, 0, 1, 1}, {0, 0.5, 1, 1}}});
  for (Vertex<double>& v : records.vertices) v.p_clip.z = 1 + 0x1p-23;
  EXPECT_TRUE(fails(compare(kUnchanged, [](auto& r) { r.polygons = {}; })));
}

// A field of view of 179.9 degrees: an edge of 4700 runs along the far plane 0.0003 away. Float leaves little of that,
// and the cut slides by a seventh of its w: of two neighbours that coincide (within 8 u of 4700) on one side alone.
TEST_F(Polygons, ACutThatSlidesAlongAParallelEdgeMayPartNeighbours) {
  set({{{0.0004195558722130954, 0.000891741830855608, 4.810702800750732, 4.810384273529053},
        {-0.00045310897985473275, 0.0006299423985183239, 6.302610397338867, 6.302192687988281},
        {0.8776571750640869, 0.11845716089010239, -4688.509765625, -4688.19775390625}}});
  ASSERT_EQ(records.polygons.polygons.at(0).count, 5u);
  for (auto& lit : records.lit) lit.color = glm::dvec4(0.5);
  for (auto& v : records.polygons.vertices) v.color = glm::dvec4(0.5);
  const auto in_float = [](Records<double>& r) {  // corners of the float recipe
    at(r, 0, 0).p_clip = {0.0007202281849458814, 0.0007873839349485934, 0.029369069263339043, 0.029369069263339043};
    at(r, 0, 4).p_clip = {0.0013144684489816427, 0.0010116759222000837, 0.02281949296593666, 0.02281949296593666};
  };
  for (const Measurement& m : {compare(in_float), compare(kUnchanged, in_float)}) {
    EXPECT_TRUE(passes(m));
    EXPECT_EQ(m.ambiguous, 0u) << "each vertex was held to its counterpart";
  }
  const double unit = kFactor * kU * 4688.5;
  for (const std::uint32_t i : {0u, 4u}) {
    EXPECT_TRUE(fails(compare([&](auto& r) { in_float(r), at(r, 0, i).p_clip.z -= 1.1 * unit; }))) << "off its plane";
    EXPECT_TRUE(fails(compare([&](auto& r) { in_float(r), at(r, 0, i).p_clip.x -= 3 * unit; }))) << "off its triangle";
    EXPECT_TRUE(fails(compare([&](auto& r) { in_float(r), at(r, 0, i).cut = false; })));
  }
}

}  // namespace
}  // namespace plumbline::check
