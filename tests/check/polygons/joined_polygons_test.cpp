// Clippers that leave several polygons of a primitive: judged as the polygon that they make together.
#include <array>

#include "check/polygons/join_polygons.h"
#include "tests/check/polygons/polygons.h"

namespace plumbline::check {
namespace {

using VertexNumbers = std::vector<std::uint32_t>;

// Replaces a primitive's polygon by several, of its vertices with these numbers.
Change parts(std::size_t primitive, const std::vector<VertexNumbers>& of) {
  return [=](Records<double>& r) {
    auto& [vertices, polygons] = r.polygons;
    const ClipPolygon whole = polygons[primitive];
    std::vector<ClipPolygon> made;
    for (const VertexNumbers& part : of) {
      made.push_back(
          {whole.primitive, static_cast<std::uint32_t>(vertices.size()), static_cast<std::uint32_t>(part.size())});
      for (const std::uint32_t i : part) vertices.push_back(ClipVertex<double>(vertices[whole.first + i]));
    }
    const auto at = polygons.erase(polygons.begin() + static_cast<std::ptrdiff_t>(primitive));
    polygons.insert(at, made.begin(), made.end());
  };
}

const std::vector<VertexNumbers> kFan = {{0, 1, 2}, {0, 2, 3}}, kOther = {{1, 2, 3}, {3, 0, 1}},
                                 kStrip = {{2, 0, 1}, {3, 0, 2}};

ClipVertex<double> between(const ClipVertex<double>& a, const ClipVertex<double>& b, double share) {
  return {glm::mix(a.p_clip, b.p_clip, share), glm::mix(a.color, b.color, share), true};
}

struct JoinedPolygons : Polygons {
  Measurement with(const Change& change, const std::function<void(std::vector<ClipVertex<double>>&)>& vertices) const {
    return compare([&](Records<double>& r) { change(r), vertices(r.polygons.vertices); });
  }
};

TEST_F(JoinedPolygons, TrianglesOfAPolygonPass) {
  for (const std::size_t p : {1u, 2u}) {
    for (const auto& split : {kFan, kOther, kStrip}) {
      const Measurement m = compare(parts(p, split));
      EXPECT_TRUE(passes(m)) << p << " " << m.worst.place.field;
      EXPECT_EQ(m.items, 4u);
      EXPECT_EQ(m.ambiguous, 0u);
    }
  }
}

TEST_F(JoinedPolygons, TrianglesWithoutAreaBesideThemPass) {
  EXPECT_TRUE(passes(compare(parts(1, {{0, 1, 2}, {2, 2, 0}, {0, 2, 3}, {1, 1, 1}}))));
}

TEST_F(JoinedPolygons, ALostOneFails) {
  for (const std::size_t p : {1u, 2u}) {
    EXPECT_TRUE(fails(compare(parts(p, {kFan[0]})))) << p;
    EXPECT_TRUE(fails(compare(parts(p, {kFan[1]})))) << p;
  }
}

TEST_F(JoinedPolygons, OnesThatOverlapOrTurnOverFail) {
  for (const auto& split : std::vector<std::vector<VertexNumbers>>{{{0, 1, 2, 3}, {0, 1, 2}},
                                                                   {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}},
                                                                   {{0, 1, 2}, {0, 3, 2}},
                                                                   {{0, 2, 1}, {0, 3, 2}}}) {
    const Measurement m = compare(parts(1, split));
    EXPECT_TRUE(fails(m));
    EXPECT_EQ(m.worst.place.record, 1);
  }
  EXPECT_STREQ(compare(parts(1, {{0, 1, 2}, {0, 3, 2}})).worst.place.field, "polygons that do not join");
}

TEST_F(JoinedPolygons, OnesThatDoNotMeetFail) {
  // The second triangle's copies of the shared corners, by more than two clippings' rounding.
  const std::size_t first = records.polygons.vertices.size() + 3;
  for (int c = 0; c < 4; ++c) {
    for (const double off : {1e-4, -1e-4}) {
      EXPECT_TRUE(fails(with(parts(1, kFan), [&](auto& v) { v[first + 1].p_clip[c] += off; }))) << c << " " << off;
      EXPECT_TRUE(fails(with(parts(1, kFan), [&](auto& v) { v[first + 1].color[c] += off; }))) << c << " " << off;
    }
  }
}

TEST_F(JoinedPolygons, CopiesOfACutVertexMayBeRoundedApart) {
  const std::uint32_t cut = cuts(1)[0];
  const VertexNumbers a = {cut, (cut + 1) % 4, (cut + 2) % 4}, b = {cut, (cut + 2) % 4, (cut + 3) % 4};
  const std::size_t copy = records.polygons.vertices.size() + 3;
  ASSERT_TRUE(passes(with(parts(1, {a, b}), [&](auto& v) { v[copy].p_clip.x += 2 * kU; })));
  EXPECT_TRUE(fails(with(parts(1, {a, b}), [&](auto& v) { v[copy].p_clip.x += 256 * kU; })));
}

// A clipper that cuts triangles by one plane after the other also cuts the edges that they share: vertices in the
// middle of the polygon's edge.
TEST_F(JoinedPolygons, AVertexOnTheEdgeThatACutMadeIsNoCorner) {
  const auto i = cuts(1)[0], j = cuts(1)[1];
  ASSERT_EQ((i + 1) % 4, j);
  const VertexNumbers a = {i, (j + 1) % 4, (j + 2) % 4}, b = {i, j, (j + 1) % 4};
  const std::size_t first = records.polygons.vertices.size();
  const auto split = [&](double share, const std::function<void(ClipVertex<double>&)>& change) {
    return compare([&](Records<double>& r) {
      parts(1, {a, b, b})(r);
      auto& v = r.polygons.vertices;
      ClipVertex<double> middle = between(v[first + 3], v[first + 4], share);
      change(middle);
      v[first + 4] = v[first + 6] = middle;  // b: (i, middle, far) and (middle, j, far)
    });
  };
  for (const double share : {0.25, 0.5, 0.75}) {
    EXPECT_TRUE(passes(split(share, [](auto&) {})));
    EXPECT_TRUE(fails(split(share, [](auto& v) { v.color.g += 1e-4; })));
    EXPECT_TRUE(fails(split(share, [](auto& v) { v.p_clip.w += 1e-4; })));
    EXPECT_TRUE(fails(split(share, [](auto& v) { v.cut = false; })));
  }
}

// A vertex in the middle of the polygon is no corner of it either, and held to the triangle.
TEST_F(JoinedPolygons, AVertexInsideIsHeldToTheTriangle) {
  const std::size_t first = records.polygons.vertices.size();
  const auto about = [&](const std::function<void(ClipVertex<double>&)>& change) {
    return compare([&](Records<double>& r) {
      parts(1, {{0, 0, 1}, {0, 1, 2}, {0, 2, 3}, {0, 3, 0}})(r);
      auto& v = r.polygons.vertices;
      ClipVertex<double> middle = between(v[first + 3], v[first + 5], 0.5);
      change(middle);
      for (std::size_t part = 0; part < 4; ++part) v[first + 3 * part] = middle;
      v[first + 1] = v[first + 11];  // (m, 0, 1), (m, 1, 2), (m, 2, 3), (m, 3, 0)
    });
  };
  EXPECT_TRUE(passes(about([](auto&) {})));
  for (int c = 0; c < 4; ++c) EXPECT_TRUE(fails(about([&](auto& v) { v.color[c] += 1e-4; }))) << c;
  EXPECT_TRUE(fails(about([](auto& v) { v.p_clip.z += 1e-4; })));
}

TEST_F(JoinedPolygons, ACornerInTheMiddleOfAnEdgeThatNoCutMadeFails) {
  EXPECT_TRUE(passes(compare(parts(0, {{0, 1, 2}, {1, 1, 2}}))));
  EXPECT_TRUE(fails(compare([](Records<double>& r) {
    parts(0, {{0, 1, 2}, {0, 1, 2}})(r);
    auto& v = r.polygons.vertices;
    const std::size_t first = v.size() - 6;
    v[first + 1] = v[first + 3] = between(v[first], v[first + 1], 0.5);
  })));
}

// A triangle in the right plane's corner with the top one: exact's cuts make corners that coincide, in a polygon
// without area. Its parts must reach each corner.
TEST_F(JoinedPolygons, PartsOfAPolygonWithoutAreaReachItsCorners) {
  set({{{0.7, 0.9, -1, 1}, {0.9, 0.6, -1, 1}, {0.8, 0.8, -2, 1}}});
  ASSERT_EQ(records.polygons.polygons.at(0).count, 4u);
  EXPECT_TRUE(passes(compare(parts(0, kFan))));
  EXPECT_EQ(compare(parts(0, kFan)).ambiguous, 1u);
  const auto all_at = [](std::uint32_t i) { return parts(0, {{i, i, i}, {i, i, i}}); };
  EXPECT_TRUE(fails(compare(all_at(0))));
  EXPECT_TRUE(fails(compare(all_at(1))));
  EXPECT_STREQ(compare(all_at(1)).worst.place.field, "cut off");
}

// An edge that two parts share, cut at a small angle, may leave more in one part than in the other. Here it runs from
// where the near plane cuts the first edge to the last corner, which is 40 u in front of that plane.
TEST_F(JoinedPolygons, PartsMayShareAPieceOfAnEdge) {
  set({{{0, 0, 0, 1}, {0.5, 0.25, -2, 1}, {-0.5, 0.5, -1 + 40 * kU, 1}}});
  ASSERT_EQ(cuts(0), VertexNumbers({1, 2}));
  const std::size_t first = records.polygons.vertices.size();
  const auto with_end = [&](double along, double away) {
    return with(parts(0, {{0, 1, 3}, {1, 2, 3}}),
                [&](auto& v) { v[first + 3] = between(between(v[first + 3], v[first + 5], along), v[first], away); });
  };
  EXPECT_TRUE(passes(with_end(0, 0)));
  EXPECT_TRUE(passes(with_end(0.2, 0)));
  EXPECT_TRUE(fails(with_end(0.2, 1e-4)));
  EXPECT_TRUE(fails(with_end(0, 1e-4)));
}

// Triangles of one primitive, of these corners.
Change triangles_of_corners(const std::vector<std::array<glm::dvec4, 3>>& triangles) {
  return [=](Records<double>& r) {
    r.polygons = {};
    for (const auto& corners : triangles) {
      r.polygons.polygons.push_back({0, static_cast<std::uint32_t>(r.polygons.vertices.size()), 3});
      for (const glm::dvec4& p : corners) r.polygons.vertices.push_back({p, r.lit[0].color, false});
    }
  };
}

// A corner on the right plane, of which rounding may leave a point or nothing.
TEST_F(JoinedPolygons, PartsOfAPrimitiveThatMayVanishLieWhereItDoes) {
  const glm::dvec4 corner(1, 0, 0, 1);
  set({{corner, {2, 0.5, 0, 1}, {2, -0.5, 0, 1}}});
  const Change nothing = [](Records<double>& r) { r.polygons = {}; };
  const std::array<glm::dvec4, 3> there = {corner, corner, corner};
  EXPECT_TRUE(passes(compare(triangles_of_corners({there, there}), nothing)));
  const std::array<glm::dvec4, 3> far = {glm::dvec4(-0.9, -0.9, 0, 1), {0.1, -0.9, 0, 1}, {0.1, 0.9, 0, 1}},
                                  apart = {glm::dvec4(-0.5, 0.2, 0.3, 1), {-0.4, 0.2, 0.3, 1}, {-0.4, 0.3, 0.9, 1}};
  EXPECT_TRUE(fails(compare(triangles_of_corners({far, apart}), nothing)));
}

// Two of the expected vertices coincide but for 1e-8: parts need not join, and lie in the polygon.
TEST_F(JoinedPolygons, PartsThatDoNotJoinLieInThePolygon) {
  const std::array<glm::dvec4, 3> all = {glm::dvec4(-0.5, -0.5, 0, 1), {0.5, -0.5, 0, 1}, {0, 0.5, 0, 1}};
  set({{all[0], all[1], all[2]}});
  const Change expected = [&](Records<double>& r) {
    r.polygons.vertices.push_back({all[2] + glm::dvec4(1e-8, 0, 0, 0), r.lit[2].color, false});
    r.polygons.polygons[0].count = 4;
  };
  const glm::dvec4 middle = (all[1] + all[2]) / 2.0, beside = middle - glm::dvec4(1e-4, 0, 0, 0);
  const std::array<glm::dvec4, 3> lower = {all[0], all[1], middle}, upper = {all[0], beside, all[2]},
                                  outside = {glm::dvec4(-0.9, 0.9, 0.9, 1), {-0.8, 0.9, 0.9, 1}, {-0.9, 0.8, 0.1, 1}};
  EXPECT_TRUE(fails(compare(triangles_of_corners({all, outside}), expected)));
  EXPECT_TRUE(passes(compare(triangles_of_corners({lower, upper}), expected)));
}

}  // namespace
}  // namespace plumbline::check
