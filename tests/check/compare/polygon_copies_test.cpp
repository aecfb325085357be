// Vertices of the mesh in a renderer that keeps clip positions in another form, such as depths of [0,w].
#include "tests/check/compare/polygons.h"

namespace plumbline::check {
namespace {

struct PolygonCopies : Polygons {
  Measurement compare(const Change& candidate, double copies) const {
    Records<double> a = records;
    candidate(a);
    return compare_polygons(scene, a, records, 8, true, copies);
  }
};

// Moves vertex i of primitive 1, whose largest coordinate is 4, by `steps` of 4 u.
Change moved(std::uint32_t i, double steps, bool cut) {
  return [=](Records<double>& r) {
    ClipVertex<double>& v = Polygons::at(r, 1, i);
    v.p_clip.z += steps * 4 * kU;
    v.cut = cut;
  };
}

TEST_F(PolygonCopies, MayBeOffByFourRoundingsWhereTheyAreGranted) {
  std::uint32_t corner = 0;
  while (at(records, 1, corner).cut) ++corner;
  EXPECT_TRUE(passes(compare(moved(corner, 3.9, false), 4)));
  EXPECT_TRUE(fails(compare(moved(corner, 4.1, false), 4)));
  EXPECT_TRUE(fails(compare(moved(corner, 0.1, false), 0)));
  EXPECT_TRUE(passes(compare([&](Records<double>& r) { at(r, 1, corner).color.r += 3.9 * kU; }, 4)));
  EXPECT_TRUE(fails(compare([&](Records<double>& r) { at(r, 1, corner).color.r += 4.1 * kU; }, 4)));
}

TEST_F(PolygonCopies, AreTheVertexWhateverMadeThem) {
  const std::uint32_t cut = cuts(1).at(0);
  EXPECT_TRUE(passes(compare(moved(cut, 0, false), 4)));
  EXPECT_TRUE(fails(compare(moved(cut, 0, false), 0)));
  EXPECT_TRUE(fails(compare(moved(cut, 8.1, false), 4)));
}

}  // namespace
}  // namespace plumbline::check
