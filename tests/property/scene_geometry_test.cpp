// Scenes end to end: closed meshes are closed in the window too, and the order of a triangle's vertices is irrelevant.
#include <algorithm>
#include <map>
#include <span>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "capture/plane.h"
#include "pipeline/stages.h"
#include "scene/mesh/mesh_shapes.h"
#include "scene/mesh/mesh_solids.h"
#include "tests/property/fragments.h"
#include "tests/property/random_scene.h"

namespace plumbline {
namespace {

Mesh closed_mesh() {
  using test::evenly;
  switch (*evenly(0, 4)) {
    case 0: return make_icosphere(*evenly(0, 4));
    case 1: {
      const int slices = *evenly(3, 14);
      return make_uv_sphere(slices, *evenly(2, 9));
    }
    case 2: return make_cube();
    default: {
      TorusKnot knot;
      knot.p = *evenly(1, 4);
      knot.q = knot.p + 1;
      knot.segments = *evenly(3, 60);
      knot.sides = *evenly(3, 9);
      return make_torus_knot(knot);
    }
  }
}

// A closed mesh, turned, mirrored and squeezed at random: over the frame's borders, not through near or far.
Scene closed_scene() {
  using namespace rc;
  Scene scene;
  scene.frame.width = *test::evenly(1, 80);
  scene.frame.height = *test::evenly(1, 80);
  if (*gen::arbitrary<bool>()) {
    scene.projection = Orthographic{-1, 1.5, -1.25, 1, 0.5, 10};
  } else {
    scene.projection = Perspective{static_cast<double>(*test::evenly(5, 90)), 0.5, 10};
  }
  const auto number = [](int least, int most) { return *test::evenly(least, most) / 16.0; };
  const auto size = [&] { return *gen::arbitrary<bool>() ? number(1, 24) : -number(1, 24); };
  Draw draw;
  const double x = number(-16, 17), y = number(-16, 17);
  draw.transforms.push_back(Translate{{x, y, number(-16, 17)}});
  draw.transforms.push_back(Rotate{number(-3000, 3000), {1, 2, -1}});
  const double scale_x = size(), scale_y = size();
  draw.transforms.push_back(Scale{{scale_x, scale_y, size()}});
  draw.transforms.push_back(Rotate{number(-3000, 3000), {-1, 1, 3}});
  scene.meshes.push_back(closed_mesh());
  scene.draws.push_back(draw);
  return scene;
}

// Stages 0 to 4 of the scene's one or more draws: visit(polygon, its window triangles).
void each_polygon(const Scene& scene, auto visit) {
  const pipeline::Stages stages = pipeline::production_stages();
  const auto lights = stages.lights(scene);
  const std::vector<DrawRange> ranges = draw_ranges(scene);
  for (std::size_t d = 0; d < scene.draws.size(); ++d) {
    const Draw& draw = scene.draws[d];
    const Mesh& mesh = scene.meshes[draw.mesh];
    const pipeline::DrawInput input = pipeline::draw_input(scene, draw, stages.matrices(scene, draw));
    std::vector<Vertex<float>> vertices;
    stages.vertex(input.matrices, draw.normals, mesh, vertices);
    std::vector<pipeline::Attributes> attributes;
    stages.light({scene, draw, scene.meshes[draw.mesh], {lights.begin(), lights.end()}, vertices}, attributes);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      pipeline::Polygon polygon = stages.assemble(input, mesh.triangles[i], vertices, attributes);
      polygon.primitive = ranges[d].first_primitive + static_cast<std::uint32_t>(i);
      stages.clip(input, polygon);
      std::vector<pipeline::ShadedTriangle> triangles;
      stages.window(input, polygon, triangles);
      visit(polygon, triangles);
    }
  }
}

RC_GTEST_PROP(ClosedMeshes, CoverEachPixelWithAsManyFrontsAsBacks, ()) {
  const Scene scene = closed_scene();
  Plane<int> fronts(scene.frame.width, scene.frame.height, 0), backs = fronts;
  each_polygon(scene, [&](const pipeline::Polygon&, const std::vector<pipeline::ShadedTriangle>& triangles) {
    for (const pipeline::ShadedTriangle& t : triangles) {
      test::for_each_covered(t, [&](const pipeline::Pixels<float>& p) {
        const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
        if (x >= 0 && y >= 0 && x < scene.frame.width && y < scene.frame.height) ++(t.front ? fronts : backs)(x, y);
      });
    }
  });
  RC_CLASSIFY(*std::max_element(fronts.values().begin(), fronts.values().end()) == 0, "nothing in the frame");
  RC_CLASSIFY(*std::max_element(fronts.values().begin(), fronts.values().end()) > 1, "several layers");
  RC_ASSERT(fronts.values() == backs.values());
}

// The window triangles of the primitives that no plane cuts: the fan of a cut one starts elsewhere in another order.
std::map<std::uint32_t, pipeline::ShadedTriangle> whole_triangles(const Scene& scene) {
  std::map<std::uint32_t, pipeline::ShadedTriangle> out;
  each_polygon(scene, [&](const pipeline::Polygon& polygon, const std::vector<pipeline::ShadedTriangle>& triangles) {
    const bool cut = std::any_of(polygon.corners.begin(), polygon.corners.end(), [](const auto& v) { return v.cut; });
    if (!cut && !triangles.empty()) out.emplace(polygon.primitive, triangles[0]);
  });
  return out;
}

RC_GTEST_PROP(RandomScenes, RotatedVertexOrderKeepsCoverageAndValues, ()) {
  Scene scene = test::random_scene();
  scene.dialect = Dialect::gl;
  scene.depth_clamp = false;
  if (std::holds_alternative<Orthographic>(scene.projection)) {  // a view that cuts few
    scene.projection = Orthographic{-6, 6, -6, 6, -20, 40};
  } else {
    scene.projection = Perspective{130, 0.01, 1000};
  }
  for (Draw& draw : scene.draws) draw.shading = Shading::gouraud;  // flat: the last vertex' colour
  const auto before = whole_triangles(scene);
  for (Mesh& mesh : scene.meshes) {
    for (glm::uvec3& t : mesh.triangles)
      t = *rc::gen::arbitrary<bool>() ? glm::uvec3(t.y, t.z, t.x) : glm::uvec3(t.z, t.x, t.y);
  }
  const auto after = whole_triangles(scene);
  RC_CLASSIFY(before.empty(), "nothing whole");
  RC_ASSERT(before.size() == after.size());
  for (const auto& [primitive, triangle] : before) {
    const auto of = [](const pipeline::ShadedTriangle& t) {
      const pipeline::PixelBounds b = pipeline::pixel_bounds(t);
      return test::fragments(t, 0, {b.x0, b.y0});
    };
    const std::string what = test::apart(of(triangle), of(after.at(primitive)), 0x1p-23);
    if (!what.empty()) RC_FAIL(fmt::format("primitive {} {}", primitive, what));
  }
}

}  // namespace
}  // namespace plumbline
