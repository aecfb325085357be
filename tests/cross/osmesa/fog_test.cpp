// Mesa's fog where a primitive reaches behind the eye: it is that of |z_eye| at the vertices, interpolated, where the
// specification has the distance of the fragment (2.1, section 3.10). This is what the check calls a dispute.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

constexpr Stage kFromLight[] = {Stage::light, Stage::clip, Stage::window, Stage::attributes, Stage::shade};

/// The fragments' colours, position's z changed at the vertices.
std::vector<Shaded<double>> shaded_with(Renderer& exact, const Scene& scene, Capture capture, auto change) {
  for (const Stage stage : kFromLight) {
    Records<double> made = exact.run_stage(scene, stage, capture).records;
    Records<double>& r = capture.records;
    VaryingColumns<double>& to = r.varyings[Varying::position];
    VaryingColumns<double>& from = made.varyings[Varying::position];
    switch (stage) {
      case Stage::light:
        r.lit = made.lit;
        to.vertices = from.vertices;
        for (Vec4<double>& p : to.vertices) p.z = change(p.z);
        break;
      case Stage::clip:
        r.polygons = made.polygons;
        to.clipped = from.clipped;
        break;
      case Stage::window:
        r.triangles = made.triangles;
        to.triangles = from.triangles;
        break;
      case Stage::attributes:
        r.attributes = made.attributes;
        to.fragments = from.fragments;
        break;
      default: return made.shaded;
    }
  }
  return {};
}

TEST(OsmesaFog, IsOfTheVerticesDistancesWhereAPrimitiveReachesBehindTheEye) {
  const Scene scene = suite_scene("fog/cut");
  const auto mesa = make_opengl();
  const auto referee = exact::make_exact();
  const Capture theirs = mesa->capture(scene, {});
  const Capture ours = referee->capture(scene, {.records = StageSet::all()});
  ASSERT_GT(ours.records.covered.size(), 1000u);
  const auto largest = [&](auto change) {
    const auto shaded = shaded_with(*referee, scene, ours, change);
    double most = 0;
    for (std::size_t i = 0; i < shaded.size(); ++i) {
      const Covered& c = ours.records.covered[i];
      for (int k = 0; k < 4; ++k) {
        most = std::max(most, std::abs(shaded[i].color[k] - static_cast<double>(theirs.planes.shaded(c.x, c.y)[k])));
      }
    }
    return most;
  };
  EXPECT_LT(largest([](double z) { return std::abs(z); }), 2e-5);
  EXPECT_GT(largest([](double z) { return z; }), 0.3) << "the specification's";
}

}  // namespace
}  // namespace plumbline
