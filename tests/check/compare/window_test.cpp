// The comparators of stage 4: window triangles against exact ones, and against another renderer's, bit for bit.
#include "tests/check/compare/window.h"

namespace plumbline::check {
namespace {

TEST_F(Window, EqualOnesPass) {
  EXPECT_TRUE(passes(compare(kUnchanged)));
  EXPECT_EQ(compare(kUnchanged).max_difference, 0);
  EXPECT_EQ(compare(kUnchanged).items, 4u);
  EXPECT_EQ(compare(kUnchanged).ambiguous, 0u);
  EXPECT_TRUE(passes(compare([](auto& r) { r.triangles.clear(); }, [](auto& r) { r.triangles.clear(); })));
}

TEST_F(Window, PositionsAreHeldToTheirRounding) {
  // |p_ndc scale| + |translate|, in u.
  const double size[] = {std::abs(80.0 - 48) + 48, std::abs(12.0 - 32) + 32, std::abs(0.5 - 0.5) + 0.5};
  for (int c = 0; c < 3; ++c) {
    const auto moved = [&](double by) {
      return [=](auto& r) {
        r.triangles[1].v[1].p_win[c] += by * kFactor * kU * size[c];
        snap(r.triangles[1].v[1]);
      };
    };
    for (double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(passes(compare(moved(0.99 * sign)))) << c;
      EXPECT_TRUE(fails(compare(moved(1.01 * sign)))) << c;
    }
    EXPECT_EQ(compare(moved(1.01)).worst.place.record, 1);
    EXPECT_STREQ(compare(moved(1.01)).worst.place.field, "p_win");
    EXPECT_NEAR(compare(moved(0.5)).max_difference, 2, 1e-3) << "in u of its size";
  }
}

TEST_F(Window, InverseWIsHeldToItself) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto scaled = [k](double by) { return [k, by](auto& r) { r.triangles[2].v[k].inv_w *= 1 + by * kU; }; };
    EXPECT_TRUE(passes(compare(scaled(3.99))));
    EXPECT_TRUE(fails(compare(scaled(4.01))));
    EXPECT_TRUE(fails(compare(scaled(-4.01))));
    EXPECT_STREQ(compare(scaled(9)).worst.place.field, "inv_w");
  }
}

TEST_F(Window, SnappedIsTheRoundingOfItsOwnPosition) {
  for (int c = 0; c < 2; ++c) {
    for (int by : {-1, 1}) {
      const Change moved = [&](auto& r) { r.triangles[0].v[2].snapped[c] += by; };
      EXPECT_TRUE(fails(compare(moved)));
      EXPECT_STREQ(compare(moved).worst.place.field, "snapped");
      EXPECT_EQ(compare(moved).max_difference, 1);
      EXPECT_TRUE(passes(compare(kUnchanged, moved))) << "only the candidate's is judged";
    }
  }
}

TEST_F(Window, SnappingByTruncationFails) {
  const auto at = [](double steps, int snapped) {
    return [=](auto& r) {
      r.triangles[0].v[0].p_win.x = 10 + steps / 256;
      r.triangles[0].v[0].snapped.x = (10 * 256 - 128) + snapped;
    };
  };
  const auto snapped_to = [&](double steps, int snapped) { return compare(at(steps, snapped), at(steps, snapped)); };
  EXPECT_TRUE(passes(snapped_to(0.75, 1)));
  EXPECT_TRUE(fails(snapped_to(0.75, 0))) << "truncated";
  EXPECT_TRUE(passes(snapped_to(0.25, 0)));
  EXPECT_TRUE(fails(snapped_to(0.25, 1))) << "rounded up";
  EXPECT_TRUE(passes(snapped_to(0.5, 0))) << "half to even";
  EXPECT_TRUE(fails(snapped_to(0.5, 1)));
  EXPECT_TRUE(passes(snapped_to(1.5, 2)));
  EXPECT_TRUE(fails(snapped_to(1.5, 1)));
  EXPECT_TRUE(passes(snapped_to(-0.75, -1)));
  EXPECT_TRUE(fails(snapped_to(-0.75, 0))) << "truncated towards zero";
}

// Samples off the grid of 1/256 pixel: positions move by 51.2 steps to the samples' places, snapped positions by 51.
TEST_F(Window, SnappedPositionsAreRoundedBeforeTheyMoveToTheSample) {
  Conventions off_grid;
  off_grid.sample = {0.3, 0.5};
  const auto passes_at = [&](double steps, int snapped) {
    Records<double> a = records;
    for (auto& triangle : a.triangles) {
      for (auto& v : triangle.v) {
        v.snapped.x = static_cast<int>(std::nearbyint((v.p_win.x - 0.5) * 256)) + 51;
        v.p_win.x += 51.2 / 256;
      }
    }
    a.triangles[0].v[0].p_win.x = 10 + (steps + 51.2) / 256;
    a.triangles[0].v[0].snapped.x = (10 * 256 - 128) + snapped + 51;
    return passes(compare_window(scene, a, a, {kFactor, off_grid, 0, FacingArea::either}));
  };
  for (const int by : {-1, 0, 1}) {
    EXPECT_EQ(passes_at(0.4, by), by == 0) << by;
    EXPECT_EQ(passes_at(0.1, by), by == 0) << by;
    EXPECT_EQ(passes_at(-0.4, by), by == 0) << by;
  }
}

// No specification says to which of two equally near places a position is snapped.
TEST_F(Window, AStrangerMaySnapHalfAStepEitherWay) {
  const auto passes_at = [&](double steps, int snapped) {
    Records<double> a = records;
    a.triangles[0].v[0].p_win.x = 10 + steps / 256;
    a.triangles[0].v[0].snapped.x = (10 * 256 - 128) + snapped;
    return passes(compare_window(scene, a, a, {kFactor, {}, 0, FacingArea::either}));
  };
  EXPECT_TRUE(passes_at(0.5, 0));
  EXPECT_TRUE(passes_at(0.5, 1));
  EXPECT_FALSE(passes_at(0.5, -1));
  EXPECT_FALSE(passes_at(0.5, 2));
  EXPECT_FALSE(passes_at(0.25, 1));
  EXPECT_FALSE(passes_at(0, 1));
}

TEST_F(Window, FacingFlippedFailsUnlessSnappingMayTurnTheTriangle) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Change flipped = [&](auto& r) { r.triangles[i].front = !r.triangles[i].front; };
    EXPECT_TRUE(fails(compare(flipped)));
    EXPECT_TRUE(fails(compare(kUnchanged, flipped)));
    EXPECT_STREQ(compare(flipped).worst.place.field, "front");
  }
  const Measurement m = compare([](auto& r) { r.triangles[3].front = false; });
  EXPECT_TRUE(passes(m));
  EXPECT_EQ(m.ambiguous, 1u);
}

TEST_F(Window, ATurnedTriangleHasTheColoursOfItsFace) {
  scene.light_model.sides = LightModel::Sides::two;
  auto& back = records.varyings[Varying::back_color].clipped;
  for (const auto& v : records.polygons.vertices) back.push_back(glm::dvec4(1) - v.color);
  const auto turned = [](bool front, bool back_colors) {
    return [=](auto& r) {
      r.triangles[3].front = front;
      for (auto& v : r.triangles[3].v) v.color = back_colors ? glm::dvec4(1) - v.color : v.color;
    };
  };
  EXPECT_TRUE(passes(compare(turned(false, true))));
  EXPECT_TRUE(fails(compare(turned(false, false)))) << "the front's colours on a back face";
  EXPECT_TRUE(fails(compare(turned(true, true))));
  EXPECT_TRUE(passes(compare(turned(true, false), turned(false, true))));
  EXPECT_TRUE(fails(compare(turned(true, true), turned(false, true))))
      << "a facing of its own, the reference's colours";
}

TEST_F(Window, ItsOwnSnappedAreaExcusesNoRecord) {
  // All corners in one place: no area is left, so that by itself any facing would do.
  for (const bool front : {true, false}) {
    const Change collapsed = [&](auto& r) {
      for (auto& v : r.triangles[0].v) v = r.triangles[0].v[0];
      r.triangles[0].front = front;
    };
    EXPECT_TRUE(fails(compare(collapsed)));
    EXPECT_TRUE(fails(compare([&](auto& r) {
                        collapsed(r);
                        r.triangles.insert(r.triangles.begin(), r.triangles[0]);
                      }),
                      2));
  }
}

TEST_F(Window, ColoursAreHandedOnAsTheyAre) {
  for (int c = 0; c < 4; ++c) {
    EXPECT_TRUE(fails(compare([&](auto& r) { r.triangles[1].v[2].color[c] += kU; })));
  }
}

TEST_F(Window, WhatIsNoNumberFails) {
  for (double bad : not_numbers()) {
    for (int c = 0; c < 4; ++c) {
      for (const Change& change : std::vector<Change>{[&](auto& r) { r.triangles[1].v[1].p_win[c % 3] = bad; },
                                                      [&](auto& r) { r.triangles[1].v[1].inv_w = bad; },
                                                      [&](auto& r) { r.triangles[1].v[1].color[c] = bad; }}) {
        EXPECT_TRUE(fails(compare(change)));
        EXPECT_TRUE(fails(compare(kUnchanged, change)));
        if (std::isnan(bad)) {
          EXPECT_TRUE(fails(compare(change, change)));
        }
      }
    }
  }
}

TEST_F(Window, MissingAndExtraTrianglesFail) {
  for (std::size_t i : {0u, 1u, 2u}) {
    EXPECT_FALSE(passes(compare(erase(i)))) << i;
    EXPECT_FALSE(passes(compare(kUnchanged, erase(i)))) << i;
    const auto primitive = static_cast<std::int64_t>(records.triangles[i].primitive);
    EXPECT_EQ(compare(erase(i)).worst.place.record, primitive);
    EXPECT_EQ(compare(erase(i)).max_difference, kInf);
  }
  EXPECT_TRUE(fails(compare(erase(0))));
  EXPECT_TRUE(fails(compare([](auto& r) { r.triangles.clear(); }), 3));
  EXPECT_TRUE(fails(compare(kUnchanged, [](auto& r) { r.triangles.clear(); }), 3));
  EXPECT_TRUE(fails(compare([](auto& r) { r.triangles.push_back(r.triangles[0]); }))) << "drawn twice";
  EXPECT_FALSE(passes(compare([](auto& r) { r.triangles[0].primitive = 1; })));
  EXPECT_FALSE(passes(compare([](auto& r) { std::swap(r.triangles[1], r.triangles[2]); }))) << "the fan out of order";
}

TEST_F(Window, ATriangleThatSnappingMayEmptyMayBeMissing) {
  for (const Measurement& m : {compare(erase(3)), compare(kUnchanged, erase(3))}) {
    EXPECT_TRUE(passes(m));
    EXPECT_EQ(m.ambiguous, 1u);
    EXPECT_EQ(m.items, 4u);
  }
  // The polygon says where its corners may be snapped to: half a step rounds either way.
  for (const auto& [steps, may_vanish] : {std::pair(0.5, true), std::pair(0.75, false), std::pair(1.5, true)}) {
    const Change higher = [&, height = steps](auto& r) {
      for (std::size_t k = 0; k < 3; ++k) {
        WindowVertex<double>& v = r.triangles[3].v[k];
        v.p_win.y = 50 + (k == 2 ? height + 0.001 : std::floor(height)) / 256;
        snap(v);
      }
      const auto corners = r.triangles[3].v;
      r.polygons.polygons.pop_back();
      add_polygon(r, 3, {corners[2], corners[0], corners[1]});
    };
    const Change missing = [&](auto& r) {
      higher(r);
      erase(3)(r);
    };
    EXPECT_EQ(passes(compare(missing, higher)), may_vanish) << steps;
    EXPECT_EQ(passes(compare(higher, missing)), may_vanish) << steps;
  }
}

TEST_F(Window, AVanishedTriangleOfAFanDoesNotExcuseOrBlameTheOthers) {
  const auto more = [&](std::ptrdiff_t place) {
    return [&, place](auto& r) { r.triangles.insert(r.triangles.begin() + place, thin); };
  };
  EXPECT_TRUE(passes(compare(kUnchanged, more(3)))) << "the two others are as they were";
  EXPECT_TRUE(passes(compare(more(3), kUnchanged)));
  EXPECT_TRUE(passes(compare(more(3), more(3))));
  EXPECT_EQ(compare(more(3), more(3)).ambiguous, 0u);
  EXPECT_EQ(compare(more(3), kUnchanged).ambiguous, 1u);
  EXPECT_FALSE(passes(compare(more(1), kUnchanged))) << "not in the fan's order";
  EXPECT_FALSE(passes(compare(more(2), kUnchanged)));
  const Change bad = [&](auto& r) {
    more(3)(r);
    for (auto& t : r.triangles) t.v[0].inv_w *= 1.001;
  };
  EXPECT_TRUE(fails(compare(bad, kUnchanged), 5)) << "and are still compared";
  const Change wrong_colors = [&](auto& r) {
    more(3)(r);
    r.triangles[3].v[1].color.r += kU;
  };
  EXPECT_TRUE(fails(compare(wrong_colors, kUnchanged))) << "one that the reference lacks is held to the polygon";
}

TEST_F(Window, WithoutMatricesFailsAndDoesNotCrash) {
  EXPECT_FALSE(passes(compare([](auto& r) { r.matrices.clear(); })));
}

TEST_F(Window, EqualBitForBit) {
  EXPECT_TRUE(passes(equal(kUnchanged)));
  EXPECT_EQ(equal(kUnchanged).items, 4u);
  for (std::size_t k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) {
      const Change ulp = [&](auto& r) { r.triangles[1].v[k].p_win[c] = float_above(r.triangles[1].v[k].p_win[c]); };
      EXPECT_TRUE(fails(equal(ulp)));
      EXPECT_TRUE(fails(equal(kUnchanged, ulp)));
      EXPECT_EQ(equal(ulp).max_difference, 1) << "ULP, corner " << k;
      EXPECT_EQ(equal(ulp).worst.place.record, 1);
    }
    for (int c = 0; c < 2; ++c) {
      const Change step = [&](auto& r) { r.triangles[2].v[k].snapped[c] -= 1; };
      EXPECT_TRUE(fails(equal(step)));
      EXPECT_EQ(equal(step).worst.place.record, 2);
    }
  }
}

TEST_F(Window, AnyCornerMayBeTheFirstButNotMirrored) {
  for (std::size_t turn : {1u, 2u}) {
    const Change turned = [&](auto& r) {
      for (auto& t : r.triangles) std::rotate(t.v.begin(), t.v.begin() + turn, t.v.end());
    };
    EXPECT_TRUE(passes(equal(turned))) << turn;
    EXPECT_TRUE(passes(equal(kUnchanged, turned))) << turn;
    EXPECT_TRUE(fails(equal([&](auto& r) {
      turned(r);
      r.triangles[0].v[0].p_win.x = float_above(r.triangles[0].v[0].p_win.x);
    })));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Change mirrored = [&](auto& r) { std::swap(r.triangles[0].v[i], r.triangles[0].v[(i + 1) % 3]); };
    EXPECT_TRUE(fails(equal(mirrored)));
    EXPECT_TRUE(fails(equal(kUnchanged, mirrored)));
  }
}

TEST_F(Window, BitForBitInEverythingButPosition) {
  EXPECT_TRUE(fails(equal([](auto& r) { r.triangles[0].front = false; })));
  EXPECT_TRUE(fails(equal([](auto& r) { r.triangles[0].primitive = 1; })));
  EXPECT_TRUE(fails(equal(erase(0)), 4));
  EXPECT_TRUE(fails(equal(kUnchanged, erase(3)), 4));
  EXPECT_TRUE(fails(equal([](auto& r) { r.triangles.clear(); }), 4));
  EXPECT_TRUE(fails(equal([](auto& r) { std::swap(r.triangles[0], r.triangles[2]); }), 2)) << "in another order";
  for (double bad : not_numbers()) {
    const Change change = [&](auto& r) { r.triangles[0].v[1].p_win.y = bad; };
    EXPECT_TRUE(fails(equal(change)));
    EXPECT_TRUE(fails(equal(kUnchanged, change)));
  }
}

TEST_F(Window, BitForBitIncludesTheInverseW) {
  // Depth and colour hang on it; it may be twice as large without a bit of p_win changing.
  EXPECT_TRUE(fails(equal([](auto& r) { r.triangles[0].v[1].inv_w *= 2; })));
  EXPECT_TRUE(fails(equal(kUnchanged, [](auto& r) { r.triangles[0].v[1].inv_w = kNaN; })));
}

}  // namespace
}  // namespace plumbline::check
