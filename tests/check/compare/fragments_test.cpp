// Comparators of fragments, stages 5 to 9: what each triangle covers, and the depth and colours there.
#include <algorithm>
#include <functional>
#include <limits>

#include "capture/float_depth.h"
#include "check/bounds/bounds.h"
#include "check/bounds/mean_bounds.h"
#include "check/compare/compare_records.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

// Six fragments of two triangles.
struct Fragments : testing::Test {
  Fragments() {
    records.triangles = {triangle_of({{{2, 2, 0.25}, {8, 2, 0.5}, {2, 8, 0.75}}}, {1, 0.5, 0.25}, 0),
                         triangle_of({{{2, 2, 0.25}, {8, 2, 0.5}, {2, 8, 0.75}}}, {1, 1, 1}, 1)};
    records.covered = {{0, 2, 2}, {0, 3, 2}, {0, 2, 3}, {1, 2, 2}, {1, 4, 2}, {1, 3, 3}};
    for (std::size_t i = 0; i < 6; ++i) {
      records.depth.push_back(0.25);
      records.attributes.push_back({{0.5, 0.25, 0.25, 1}});
      records.shaded.push_back({{0.5, 0.25, 0.25, 1}});
    }
  }
  using Compare = std::function<Measurement(const Records<double>&, const Records<double>&)>;
  Measurement run(const Compare& compare, const Change& candidate, const Change& reference = kUnchanged) const {
    Records<double> a = records, b = records;
    candidate(a);
    reference(b);
    return compare(a, b);
  }
  Compare depth() const {
    return [this](const auto& a, const auto& b) { return compare_depth(scene, a, b, 0.501); };
  }
  Compare shaded() const {
    return [this](const auto& a, const auto& b) { return compare_shaded(scene, a, b, 4); };
  }
  static Compare attributes() {
    return [](const auto& a, const auto& b) { return compare_attributes(a, b, 10); };
  }
  Scene scene;
  Records<double> records;
};

TEST_F(Fragments, CoveredEqualOnesPass) {
  EXPECT_TRUE(passes(run(compare_covered, kUnchanged)));
  EXPECT_EQ(run(compare_covered, kUnchanged).items, 6u);
}

TEST_F(Fragments, CoveredOnAnEdgeIsOpenToADeclaredTieRule) {
  for (WindowTriangle<double>& t : records.triangles) {
    for (auto& v : t.v) v.p_win += glm::dvec3(0.5, 0.5, 0), v.snapped += kSubpixel / 2;  // side 3: centre of (7, 3)
  }
  const auto with = [&](std::uint16_t x, std::uint16_t y) {
    Records<double> out = records;
    out.covered.push_back({1, x, y});
    return out;
  };
  const Conventions conventions;
  EXPECT_TRUE(fails(compare_covered_except_edges(with(7, 3), records, conventions, {0.25, 0.5}))) << "other sample";
  for (const bool extra : {true, false}) {
    const auto compare = [&](const Records<double>& other) {
      return extra ? compare_covered_except_edges(other, records, conventions)
                   : compare_covered_except_edges(records, other, conventions);
    };
    EXPECT_EQ(compare(with(7, 3)).differing, 0u);
    EXPECT_EQ(compare(with(7, 3)).ambiguous, 1u);
    EXPECT_TRUE(fails(compare(with(4, 4)))) << "within";
    EXPECT_TRUE(fails(compare(with(8, 3)))) << "outside";
    EXPECT_TRUE(fails(compare(with(1, 9)))) << "on the side's line, beyond its end";
  }
}

TEST_F(Fragments, SumsOfPlanesAreThoseOfTheRecords) {
  Planes planes;
  EXPECT_FALSE(are_sums_of(records, planes));
  planes.count = Plane<std::uint32_t>(8, 8), planes.id_sum = Plane<std::uint64_t>(8, 8);
  for (const Covered& c : records.covered) {
    ++planes.count(c.x, c.y);
    planes.id_sum(c.x, c.y) += id_weight(records.triangles[c.triangle].primitive);
  }
  EXPECT_TRUE(are_sums_of(records, planes));
  planes.id_sum(2, 2) += 1;
  EXPECT_FALSE(are_sums_of(records, planes)) << "of other primitives";
  planes.id_sum = {};
  EXPECT_TRUE(are_sums_of(records, planes));
  planes.count(7, 7) = 1;
  EXPECT_FALSE(are_sums_of(records, planes));
}

TEST_F(Fragments, CoveredOnePixelLackingOrMoreFails) {
  for (std::size_t i = 0; i < 6; ++i) {
    const Change erase = [&](auto& r) { r.covered.erase(r.covered.begin() + static_cast<std::ptrdiff_t>(i)); };
    const Measurement lacking = run(compare_covered, erase), extra = run(compare_covered, kUnchanged, erase);
    for (const Measurement& m : {lacking, extra}) {
      EXPECT_TRUE(fails(m)) << i;
      EXPECT_EQ(m.items, 6u);
      EXPECT_EQ(m.max_difference, 1);
      EXPECT_EQ(m.worst.place.x, records.covered[i].x);
      EXPECT_EQ(m.worst.place.y, records.covered[i].y);
      EXPECT_EQ(m.worst.place.record, records.covered[i].triangle);
    }
    EXPECT_STREQ(lacking.worst.place.field, "lacking");
    EXPECT_EQ(lacking.worst.candidate, 0);
    EXPECT_EQ(lacking.worst.reference, 1);
    EXPECT_STREQ(extra.worst.place.field, "extra");
    EXPECT_EQ(extra.worst.candidate, 1);
    EXPECT_EQ(extra.worst.reference, 0);
  }
}

TEST_F(Fragments, CoveredElsewhereFailsTwice) {
  EXPECT_TRUE(fails(run(compare_covered, [](auto& r) { r.covered[1].x = 4; }), 2));
  EXPECT_TRUE(fails(run(compare_covered, [](auto& r) { r.covered[2].y = 4; }), 2));
  EXPECT_TRUE(fails(run(compare_covered, [](auto& r) { r.covered[5].triangle = 2; }), 2));
  EXPECT_TRUE(fails(run(compare_covered, [](auto& r) { std::swap(r.covered[1].x, r.covered[1].y); }), 2))
      << "x and y exchanged";
  EXPECT_TRUE(fails(run(compare_covered, [](auto& r) { r.covered.clear(); }), 6));
  EXPECT_TRUE(fails(run(compare_covered, kUnchanged, [](auto& r) { r.covered.clear(); }), 6));
  EXPECT_TRUE(fails(run(compare_covered, [](auto& r) { r.covered.push_back(r.covered.back()); }))) << "drawn twice";
  EXPECT_FALSE(passes(run(compare_covered, [](auto& r) { std::swap(r.covered[0], r.covered[1]); })))
      << "in another order";
}

TEST_F(Fragments, DepthInStepsOfEachFormat) {
  for (DepthFormat format : {DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f}) {
    scene.frame.depth = format;
    EXPECT_TRUE(passes(run(depth(), kUnchanged)));
    const double step = depth_step(format, 0.25);
    const auto moved = [&](double steps) { return [=](auto& r) { r.depth[4] += steps * step; }; };
    for (double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(passes(run(depth(), moved(sign * 0.5)))) << "rounding";
      EXPECT_TRUE(fails(run(depth(), moved(sign * 0.502))));
      EXPECT_TRUE(fails(run(depth(), moved(sign)))) << "one step";
      EXPECT_TRUE(fails(run(depth(), kUnchanged, moved(sign))));
    }
    const Measurement m = run(depth(), moved(3));
    EXPECT_NEAR(m.max_difference, 3, 1e-9);
    EXPECT_EQ(m.unit, "step");
    EXPECT_EQ(m.worst.place.x, 4);
    EXPECT_EQ(m.worst.place.y, 2);
    EXPECT_EQ(m.worst.place.record, 1);
  }
  EXPECT_EQ(depth_step(DepthFormat::z8, 0.25), 1 / 255.0);
  EXPECT_EQ(depth_step(DepthFormat::z16, 0.25), 1 / 65535.0);
  EXPECT_EQ(depth_step(DepthFormat::z24, 0.25), 1 / 16777215.0);
  EXPECT_EQ(depth_step(DepthFormat::z32f, 0.25), 0x1p-24);
  EXPECT_EQ(depth_step(DepthFormat::z32f, 0.75), 0x1p-24);
  EXPECT_EQ(depth_step(DepthFormat::z32f, 1), 0x1p-23);
}

TEST_F(Fragments, DepthsOfSliversAreHeldToTheRoundingOfTheirPlane) {
  auto& v = records.triangles[1].v;
  v[2].p_win = Vec3<double>(2, 2 + 1.0 / 1024, 4096);  // a slope of 4 10^6 by y
  const double rounding = depth_rounding(records.triangles[1]), step = depth_step(scene.frame.depth, 0.25);
  const double slope = (4096 - 0.25) * 1024;
  EXPECT_GT(rounding, 6 * 0x1p-53 * 128 * slope * 0.9);
  EXPECT_LT(rounding, 6 * 0x1p-53 * 128 * slope * 1.1);
  const auto moved = [&](double by) { return [=](auto& r) { r.depth[4] += 0.501 * step + by * rounding; }; };
  for (double by : {0.05, 0.99}) EXPECT_TRUE(passes(run(depth(), moved(by)))) << by;
  EXPECT_TRUE(fails(run(depth(), moved(1.01))));
  const Change of_plain = [&](auto& r) { r.depth[0] += 0.501 * step + 0.01 * rounding; };
  EXPECT_TRUE(fails(run(depth(), of_plain))) << "the other triangle is no sliver";
  records.covered[4].triangle = 7;
  EXPECT_TRUE(fails(run(depth(), moved(0.5)))) << "of no triangle";
  v[1].p_win = v[0].p_win, v[1].snapped = v[0].snapped;
  EXPECT_EQ(depth_rounding(records.triangles[1]), 0) << "no plane";
}

// Codes of a renderer that declares depths in float may be off by that arithmetic's error, and by u.
TEST_F(Fragments, DepthsInFloatAreHeldToTheirBound) {
  using enum Conventions::DepthArithmetic;
  const auto compare = [&](Conventions::DepthArithmetic arithmetic, double from_origin) {
    return [this, arithmetic, from_origin](const auto& a, const auto& b) {
      Conventions conventions;
      conventions.depth_arithmetic = arithmetic;
      return compare_depth(scene, a, b, 0.501, conventions, from_origin);
    };
  };
  const auto moved = [&](double by) { return [=](auto& r) { r.depth[5] += by; }; };
  for (const bool sliver : {false, true}) {
    if (sliver) {
      WindowTriangle<double>& t = records.triangles[1];
      t = triangle_of({{{2, 2, 0.25}, {512, 512, 0.25}, {514, 514 + 1.0 / 16, 0.25}}}, {1, 1, 1}, 1);
    }
    const auto& v = records.triangles[1].v;
    const WindowCorners corners = {v[0].p_win, v[1].p_win, v[2].p_win};
    const double by_plane = kU * 4 * bounds_from_origin(records.triangles[1], 3, 3).depth;
    for (const auto arithmetic : {in_float, in_float_from_origin}) {
      for (const DepthFormat format : {DepthFormat::z16, DepthFormat::z24}) {
        scene.frame.depth = format;
        const double half = 0.501 * depth_step(format, 0.25),
                     bound = std::max(by_plane + kU, depth_error(arithmetic, corners, {3.5, 3.5}, kNoSides));
        EXPECT_TRUE(passes(run(compare(arithmetic, 4), moved(half + 0.99 * bound))));
        EXPECT_TRUE(fails(run(compare(arithmetic, 4), moved(half + 1.01 * bound))));
        EXPECT_TRUE(fails(run(compare(arithmetic, 0), moved(half + 0.1 * bound)))) << "plumbline's own";
        EXPECT_TRUE(fails(run(compare(in_double, 4), moved(half + 0.1 * bound)))) << "not declared";
      }
    }
    scene.frame.depth = DepthFormat::z32f;
    const double half = 0.501 * depth_step(DepthFormat::z32f, 0.25);
    EXPECT_TRUE(passes(run(compare(in_double, 4), moved(half + 0.99 * by_plane)))) << "a float buffer";
    EXPECT_TRUE(fails(run(compare(in_double, 4), moved(half + 1.01 * by_plane))));
    EXPECT_TRUE(fails(run(compare(in_float, 4), moved(std::numeric_limits<double>::quiet_NaN()))));
  }
}

// Attributes of a stranger: the arithmetic that it declares adds its error.
TEST_F(Fragments, AttributesInFloatAreHeldToTheirBound) {
  using enum Conventions::DepthArithmetic;
  const auto slack = [&](Conventions::DepthArithmetic arithmetic, double from_origin) {
    Conventions conventions;
    conventions.depth_arithmetic = arithmetic;
    double low = 0, high = 1;  // the largest error that passes
    for (int step = 0; step < 50; ++step) {
      const double by = (low + high) / 2;
      Records<double> a = records;
      a.attributes[5].color.r += by;
      (passes(compare_attributes(a, records, 10, from_origin, conventions)) ? low : high) = by;
    }
    return low;
  };
  const auto& v = records.triangles[1].v;
  const WindowCorners corners = {v[0].p_win, v[1].p_win, v[2].p_win};
  const Covered& c = records.covered[5];
  const double undeclared = slack(in_double, 8);
  EXPECT_GT(undeclared, 0);
  for (const auto arithmetic : {in_float, in_float_from_origin}) {
    const double shares = shares_error(arithmetic, corners, {c.x + 0.5, c.y + 0.5}, kNoSides);
    EXPECT_GT(slack(arithmetic, 8) - undeclared, 0.9 * shares * 2 * v[0].color.a);
    EXPECT_EQ(slack(arithmetic, 0), slack(in_double, 0)) << "plumbline's own";
  }
  EXPECT_GT(slack(in_float_from_origin, 8), slack(in_float, 8));
}

TEST_F(Fragments, AttributesAreHeldToTheirBound) {
  const Vec4<double> bound = bounds_of_mean(records.triangles[1], 3, 3);
  for (int c = 0; c < 4; ++c) {
    const auto moved = [&](double by) { return [=](auto& r) { r.attributes[5].color[c] += by * 10 * kU * bound[c]; }; };
    EXPECT_TRUE(passes(run(attributes(), moved(0.99))));
    EXPECT_TRUE(fails(run(attributes(), moved(1.01))));
    EXPECT_TRUE(fails(run(attributes(), moved(-1.01))));
    EXPECT_TRUE(fails(run(attributes(), moved(255 / 255.0 / (10 * kU * bound[c]) / 255)))) << "1/255";
    EXPECT_NEAR(run(attributes(), moved(0.5)).max_difference, 5, 1e-6);
    EXPECT_EQ(run(attributes(), moved(2)).worst.place.x, 3);
    EXPECT_EQ(run(attributes(), moved(2)).worst.place.y, 3);
    EXPECT_EQ(run(attributes(), moved(2)).worst.place.record, 1);
  }
}

TEST_F(Fragments, WhereNoBoundCanBeComputedNothingIsEqual) {
  // The weights' sum, which they are divided by, is 0 at the second triangle's three pixels.
  for (auto& v : records.triangles[1].v) v.inv_w = 0;
  const Change other = [](auto& r) { r.attributes[5].color.r += 0.5; };
  const Measurement m = run(attributes(), other);
  EXPECT_TRUE(m.ambiguous == 3 || m.differing == 1) << m.ambiguous << " ambiguous, " << m.differing << " differing";
  for (double bad : not_numbers()) {
    EXPECT_TRUE(fails(run(attributes(), [&](auto& r) { r.attributes[5].color.g = bad; }))) << bad;
  }
}

TEST_F(Fragments, ShadedAreEqual) {
  EXPECT_TRUE(passes(run(shaded(), kUnchanged)));
  EXPECT_EQ(run(shaded(), kUnchanged).items, 6u);
  for (int c = 0; c < 4; ++c) {
    const Change ulp = [&](auto& r) { r.shaded[3].color[c] = float_above(r.shaded[3].color[c]); };
    EXPECT_TRUE(fails(run(shaded(), ulp)));
    EXPECT_TRUE(fails(run(shaded(), kUnchanged, ulp)));
    EXPECT_EQ(run(shaded(), ulp).worst.place.x, 2);
    EXPECT_EQ(run(shaded(), ulp).worst.place.record, 1);
    EXPECT_LE(run(shaded(), ulp).max_difference, 2) << "in u";
  }
}

TEST_F(Fragments, ShadedInFogAreAsNearAsItsArithmeticAllows) {
  scene.meshes.resize(1);
  scene.meshes[0].triangles.resize(8);
  scene.draws.resize(1);
  scene.draws[0].fog = Fog{Fog::Mode::exp, glm::vec3(0.5f), 0.25f, 0, 1};
  records.varyings[Varying::position].fragments.assign(6, {0, 0, -2, 1});
  EXPECT_TRUE(passes(run(shaded(), kUnchanged)));
  const double u = 1.0 / 16777216;
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(passes(run(shaded(), [&](auto& r) { r.shaded[3].color[c] += u; })));
    EXPECT_TRUE(fails(run(shaded(), [&](auto& r) { r.shaded[3].color[c] += 8 * u; })));
    for (double bad : not_numbers()) {
      EXPECT_TRUE(fails(run(shaded(), [&](auto& r) { r.shaded[3].color[c] = bad; }))) << bad;
    }
  }
  EXPECT_TRUE(fails(run(shaded(), [&](auto& r) { r.shaded[3].color.a += u; }))) << "alpha is copied";
}

// Below 2^-126 ours rounds to multiples of 2^-149; a renderer of ours that flushed to zero would be another.
TEST_F(Fragments, ShadedInThickFogUnderflowGradually) {
  scene.meshes.resize(1);
  scene.meshes[0].triangles.resize(8);
  scene.draws.resize(1);
  scene.draws[0].fog = Fog{Fog::Mode::exp, glm::vec3(0), 0.25f, 0, 1};
  Records<double> b = records;
  b.varyings[Varying::position].fragments.assign(6, {0, 0, -360, 1});  // f = e^-90 = 8e-40
  b.shaded[3].color = {0x1p-131, 0, 0, 1};
  const auto moved = [&](double by) {
    Records<double> a = b;
    a.shaded[3].color.r += by;
    return compare_shaded(scene, a, b, 4);
  };
  EXPECT_TRUE(passes(moved(0x1p-149)));
  EXPECT_TRUE(passes(moved(-0x1p-149)));
  EXPECT_TRUE(fails(moved(0x1p-145)));
  EXPECT_TRUE(fails(moved(-0x1p-131))) << "flushed to zero";
}

// Colours of a draw without fog, texture or light per fragment are those of the attributes.
TEST_F(Fragments, ColoursThatNoStepChangesMayBeOffByCopies) {
  const auto moved = [&](double by, double copies) {
    Records<double> a = records;
    a.shaded[3].color.r *= 1 + by * 0x1p-24;
    return compare_shaded(scene, a, records, 0, copies);
  };
  EXPECT_TRUE(passes(moved(3.9, 4)));
  EXPECT_TRUE(passes(moved(-3.9, 4)));
  EXPECT_TRUE(fails(moved(4.1, 4)));
  EXPECT_TRUE(fails(moved(0.1, 0)));
}

TEST_F(Fragments, CarriedVaryingsAreEqual) {
  records.varyings[Varying::texture].vertices.assign(3, {0.5, 0.25, 0, 1});
  const Compare carried = [](const auto& a, const auto& b) { return compare_carried(Varying::texture, a, b); };
  EXPECT_TRUE(passes(run(carried, kUnchanged)));
  EXPECT_EQ(run(carried, kUnchanged).items, 3u);
  for (int c = 0; c < 4; ++c) {
    const Change ulp = [&](auto& r) {
      double& v = r.varyings[Varying::texture].vertices[1][c];
      v = float_above(v);
    };
    EXPECT_TRUE(fails(run(carried, ulp))) << c;
    EXPECT_TRUE(fails(run(carried, kUnchanged, ulp))) << c;
    EXPECT_EQ(run(carried, ulp).worst.place.record, 1);
  }
  EXPECT_TRUE(fails(run(carried, [](auto& r) { r.varyings[Varying::texture].vertices.pop_back(); }), 3));
}

TEST_F(Fragments, WhatIsNoNumberFails) {
  for (double bad : not_numbers()) {
    const Change z = [&](auto& r) { r.depth[2] = bad; };
    EXPECT_TRUE(fails(run(depth(), z)));
    EXPECT_TRUE(fails(run(depth(), kUnchanged, z)));
    for (int c = 0; c < 4; ++c) {
      const Change color = [&](auto& r) { r.attributes[2].color[c] = r.shaded[2].color[c] = bad; };
      for (const Compare& compare : {attributes(), shaded()}) {
        EXPECT_TRUE(fails(run(compare, color)));
        EXPECT_TRUE(fails(run(compare, kUnchanged, color)));
        if (std::isnan(bad)) {
          EXPECT_TRUE(fails(run(compare, color, color)));
        }
      }
    }
  }
}

TEST_F(Fragments, OtherNumbersOfRecordsFail) {
  const Change fewer = [](auto& r) { r.depth.pop_back(), r.attributes.pop_back(), r.shaded.pop_back(); };
  const Change none = [](auto& r) { r.depth.clear(), r.attributes.clear(), r.shaded.clear(); };
  for (const Compare& compare : {depth(), attributes(), shaded()}) {
    for (const Change& change : {fewer, none}) {
      EXPECT_TRUE(fails(run(compare, change), 6));
      EXPECT_TRUE(fails(run(compare, kUnchanged, change), 6));
    }
  }
}

TEST_F(Fragments, WithoutThePixelsTheyLieAtFailsAndDoesNotCrash) {
  const Change lost = [](auto& r) { r.covered = {}; };
  const Change fewer = [](auto& r) { r.covered = {r.covered[0]}; };
  const Change no_triangles = [](auto& r) { r.triangles = {}; };
  for (const Change& change : {lost, fewer}) {
    EXPECT_FALSE(passes(run(depth(), change)));
    EXPECT_FALSE(passes(run(attributes(), change)));
    EXPECT_FALSE(passes(run(shaded(), change)));
  }
  EXPECT_FALSE(passes(run(attributes(), no_triangles)));
}

TEST_F(Fragments, DrawnOnesAreTheSame) {
  records.drawn.assign(6, {true});
  EXPECT_TRUE(passes(run(compare_drawn, kUnchanged)));
  EXPECT_EQ(run(compare_drawn, kUnchanged).items, 6u);
  const Change hidden = [](auto& r) { r.drawn[4].drawn = false; };
  EXPECT_TRUE(fails(run(compare_drawn, hidden)));
  EXPECT_TRUE(fails(run(compare_drawn, kUnchanged, hidden)));
  EXPECT_EQ(run(compare_drawn, hidden).worst.place.x, 4);
  EXPECT_FALSE(passes(run(compare_drawn, [](auto& r) { r.drawn.pop_back(); })));
  EXPECT_FALSE(passes(run(compare_drawn, kUnchanged, [](auto& r) { r.drawn.clear(); })));
  EXPECT_TRUE(passes(run(compare_drawn, [](auto& r) { r.drawn.clear(); }))) << "it does not say";
}

}  // namespace
}  // namespace plumbline::check
