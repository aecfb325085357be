// Colours of planes at a pixel beside its triangle, and of a triangle whose plane is undefined.
#include "check/bounds/bounds.h"
#include "tests/check/compare/planes.h"

namespace plumbline::check {
namespace {

// A sample may be covered whose pixel's centre is not: there the corners' differences count by the weights' sum, 2.6.
TEST_F(PlanePairs, CornersDifferencesAreEnlargedBesideTheTriangle) {
  WindowTriangle<double>& t = capture.records.triangles[0];
  t = triangle_of({{{4.5, 0.5, 0.25}, {6.5, 1, 0.5}, {5, 3.75, 0.75}}}, {1, 1, 1}, 3);
  const glm::dvec3 weights = glm::abs(barycentrics(t, 3.5, 1.5).value);
  const double times = weights.x + weights.y + weights.z;
  ASSERT_GT(times, 1.5);
  const auto apart = [&](double by) {
    Capture a = capture, b = capture;
    a.records.lit[9].color.g += 0.125;
    a.planes.shaded(3, 1).g += static_cast<float>(by);
    return compare_shaded_planes(scene, a, b, 64);
  };
  EXPECT_TRUE(passes(apart(0.125 * times)));
  EXPECT_TRUE(fails(apart(0.126 * times)));
}

TEST_F(PlanePairs, AReferencesUndefinedPlaneSaysNothing) {
  capture.records.triangles[1] = triangle_of({{{1, 1, 0.25}, {3, 2, 0.5}, {5, 3, 0.75}}}, {1, 1, 1}, 5);
  capture.records.triangles[1].v[1].snapped.y += 1;
  const PlaneChange no_number = [](Planes& p) { p.shaded(2, 2).r = static_cast<float>(kNaN); };
  const Measurement m = run(shaded(), kUnchangedPlanes, no_number);
  EXPECT_EQ(m.differing, 0u);
  EXPECT_EQ(m.ambiguous, 1u);
  EXPECT_TRUE(fails(run(shaded(), no_number)));
  EXPECT_TRUE(fails(run(shaded(), no_number, no_number)));
}

}  // namespace
}  // namespace plumbline::check
