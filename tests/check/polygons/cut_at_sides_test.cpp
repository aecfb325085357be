// Polygons of renderers that leave the sides of the view volume to the raster.
#include "check/polygons/compare_polygons.h"

#include "tests/check/polygons/polygons.h"

namespace plumbline::check {
namespace {

struct CutAtSides : Polygons {
  // A renderer's polygons, as they are and cut at the sides.
  Measurement as_it_is(const Records<double>& a) const { return compare_polygons(scene, a, records, kFactor); }
  Measurement cut(const Records<double>& a) const {
    return compare_polygons(scene, cut_at_sides(scene, a, kFactor), records, kFactor, FlatColors::provoking, 4);
  }
  // The records with the primitive's polygon replaced by its corners, after `change`.
  Records<double> uncut(
      std::size_t primitive, const std::function<void(ClipVertex<double>&)>& change = [](auto&) {}) const {
    Records<double> out = records;
    ClipPolygon& polygon = out.polygons.polygons[primitive];
    polygon.first = static_cast<std::uint32_t>(out.polygons.vertices.size());
    polygon.count = 3;
    for (std::size_t i = 3 * primitive; i < 3 * primitive + 3; ++i)
      out.polygons.vertices.push_back({records.vertices[i].p_clip, records.lit[i].color, false});
    change(out.polygons.vertices[polygon.first + 1]);  // of primitive 2 the corner beyond the right plane
    return out;
  }
};

TEST_F(CutAtSides, IsNothingForPolygonsThatAreCut) {
  const Records<double> same = cut_at_sides(scene, records, kFactor);
  EXPECT_TRUE(passes(compare_polygons(scene, same, records, kFactor)));
  EXPECT_EQ(same.polygons.vertices.size(), records.polygons.vertices.size());
}

TEST_F(CutAtSides, ATriangleThatReachesBeyondASideIsTheSame) {
  EXPECT_TRUE(fails(as_it_is(uncut(2))));
  EXPECT_TRUE(passes(cut(uncut(2))));
}

TEST_F(CutAtSides, SoIsOneThatIsCutFartherOut) {
  Records<double> banded = uncut(2);
  ClipPolygon& polygon = banded.polygons.polygons[2];
  const std::vector<ClipVertex<double>> corners(banded.polygons.vertices.begin() + polygon.first,
                                                banded.polygons.vertices.end());
  const auto between = [&](const ClipVertex<double>& in, const ClipVertex<double>& out) {
    const double t = (2 - in.p_clip.x) / (out.p_clip.x - in.p_clip.x);
    return ClipVertex<double>{glm::mix(in.p_clip, out.p_clip, t), glm::mix(in.color, out.color, t), true};
  };
  banded.polygons.vertices.resize(polygon.first);
  for (const ClipVertex<double>& v :
       {corners[0], between(corners[0], corners[1]), between(corners[2], corners[1]), corners[2]})
    banded.polygons.vertices.push_back(v);
  polygon.count = 4;
  EXPECT_TRUE(fails(as_it_is(banded)));
  EXPECT_TRUE(passes(cut(banded)));
}

TEST_F(CutAtSides, ACornerBeyondThatIsMovedOrColouredOtherwiseFails) {
  EXPECT_TRUE(fails(cut(uncut(2, [](auto& v) { v.p_clip.y += 0.01; }))));
  EXPECT_TRUE(fails(cut(uncut(2, [](auto& v) { v.color.g += 0.01; }))));
}

// A rasterizer divides by w, so a polygon that reaches behind the eye cannot be left to it.
TEST_F(CutAtSides, APolygonThatReachesBehindTheEyeStaysAsItIs) {
  const auto corners_left = [&](double w) {
    return cut_at_sides(scene, uncut(2, [&](auto& v) { v.p_clip.w = w; }), kFactor).polygons.polygons[2].count;
  };
  EXPECT_EQ(corners_left(0x1p-4), 4u);
  EXPECT_EQ(corners_left(0), 3u);
  EXPECT_EQ(corners_left(-1), 3u);
}

// In u of the triangle's largest coordinate, however small the polygon: 4 of a corner, kFactor more of a cut.
TEST_F(CutAtSides, AVertexIsBeyondASideByMoreThanRounding) {
  double scale = 0;
  for (std::size_t i = 6; i < 9; ++i) {
    for (int c = 0; c < 4; ++c) scale = std::max(scale, std::abs(records.vertices[i].p_clip[c]));
  }
  const auto corners_left = [&](double beyond, bool is_cut) {
    const auto moved = uncut(2, [&](auto& v) { v.p_clip.x = v.p_clip.w + beyond * kU * scale, v.cut = is_cut; });
    return cut_at_sides(scene, moved, kFactor).polygons.polygons[2].count;
  };
  EXPECT_EQ(corners_left(3, false), 3u);
  EXPECT_EQ(corners_left(5, false), 4u);
  EXPECT_EQ(corners_left(3 + kFactor, true), 3u);
  EXPECT_EQ(corners_left(5 + kFactor, true), 4u);
}

TEST_F(CutAtSides, TheNearPlaneCutsAllTheSame) { EXPECT_TRUE(fails(cut(uncut(1)))); }

TEST_F(CutAtSides, WhatLiesBeyondASideIsNotThere) {
  Records<double> extra = records;
  ClipPolygon& first = extra.polygons.polygons[0];
  for (std::uint32_t i = 0; i < first.count; ++i) extra.polygons.vertices[first.first + i].p_clip.x += 8;
  EXPECT_EQ(cut_at_sides(scene, extra, kFactor).polygons.polygons.size(), records.polygons.polygons.size() - 1);
  EXPECT_TRUE(fails(cut(extra))) << "a primitive within the view is lacking";
}

}  // namespace
}  // namespace plumbline::check
