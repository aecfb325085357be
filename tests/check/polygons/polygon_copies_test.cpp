// Vertices of the mesh in a renderer that keeps clip positions in another form, such as depths of [0,w].
#include <span>

#include "check/polygons/compare_polygon.h"
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

// A vertex that a renderer cut and moved no farther than a copy may be off counts as the corner.
TEST(WithinRounding, HoldsAVertexThatIsNotCutToACopyOfACorner) {
  ComparedPrimitive primitive;
  primitive.corners.p_clip = {{{0, 0, 0, 1}, {0.5, 0, 0, 1}, {0, 0.5, 0, 1}}};
  primitive.corners.scale = primitive.corners.color_scale = 1, primitive.corners.planes = 6;
  primitive.factor = 8;
  const auto holds = [&](double steps, double copies) {
    primitive.copies = copies;
    const ClipVertex<double> v{{0.5 + steps * kU, 0, 0, 1}, Vec4<double>(0), false};
    Meter meter("u");
    within_rounding(meter, std::span(&v, 1), primitive);
    meter.item();
    return passes(meter.done());
  };
  EXPECT_TRUE(holds(0, 0));
  EXPECT_FALSE(holds(1, 0));
  EXPECT_TRUE(holds(3.9, 4));
  EXPECT_FALSE(holds(4.1, 4));
}

}  // namespace
}  // namespace plumbline::check
