// Vertices of the mesh in a renderer that keeps clip positions in another form, such as depths of [0,w].
#include "tests/check/polygons/polygons.h"

namespace plumbline::check {
namespace {

struct PolygonCopies : Polygons {
  Measurement compare(const Change& candidate, double copies) const {
    Records<double> a = records;
    candidate(a);
    return compare_polygons(scene, a, records, 8, FlatColors::provoking, copies);
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

// A corner that lies on a plane may be called cut, and one that a cut makes there the corner. Elsewhere a cut is one.
TEST_F(PolygonCopies, AtACornerMayBeCalledCut) {
  std::uint32_t corner = 0;
  while (at(records, 1, corner).cut) ++corner;
  EXPECT_TRUE(passes(compare(moved(corner, 0, true), 4)));
  EXPECT_TRUE(fails(compare(moved(corner, 0, true), 0)));
  EXPECT_TRUE(fails(compare(moved(corner, 8.1, true), 4)));
  EXPECT_TRUE(fails(compare(moved(cuts(1).at(0), 0, false), 4)));
}

}  // namespace
}  // namespace plumbline::check
