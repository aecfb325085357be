// Invariances on vertices that lie on the grid of 1/256 pixel, so that snapping loses nothing.
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "pipeline/geometry.h"
#include "pipeline/render.h"
#include "scene/mesh/mesh_shapes.h"
#include "tests/property/fragments.h"
#include "tests/property/random_scene.h"

namespace plumbline {
namespace {

using test::Fragment;

/// Depths in codes of 24 bits.
constexpr double kScale = 16777215.0;

struct Corner {
  glm::ivec2 snapped;
  float z, w;
  glm::vec4 color;
};
using Corners = std::array<Corner, 3>;

// Point [1/256 pixel from pixel 0's centre] around a frame of 64 pixels; half of the coordinates are centres'.
glm::ivec2 snapped_point() {
  using namespace rc;
  const auto coordinate = gen::weightedOneOf<int>(
      {{3, test::evenly(-4096, 20480)}, {3, gen::map(test::evenly(-2, 10), [](int i) { return i * 8 * kSubpixel; })}});
  const int x = *coordinate;
  return {x, *coordinate};
}

Corner corner() {
  using namespace rc;
  const auto unit = gen::map(test::evenly(0, 8192), [](int i) { return static_cast<float>(i) / 8191; });
  Corner c{snapped_point(), *unit, std::ldexp(1.0f, *test::evenly(0, 7)), {}};
  for (int k = 0; k < 4; ++k) c.color[k] = *unit;
  return c;
}

Corners corners() {
  const Corner a = corner(), b = corner();
  return {a, b, corner()};
}

// Through stage 4 as one polygon; its position in clip space comes to the snapped one without an error.
std::vector<pipeline::ShadedTriangle> window_triangles(const Corners& corners, Cull cull) {
  Matrices<float> matrices{};
  matrices.win_scale = Vec3<float>(1);
  pipeline::Polygon polygon;
  for (const Corner& c : corners) {
    const glm::vec2 p_win = glm::vec2(c.snapped) / 256.0f + 0.5f;
    polygon.corners.push_back({Vec4<float>(p_win * c.w, c.z * c.w, c.w), {}, false});
    polygon.corners[polygon.corners.size() - 1].attributes.color() = c.color;
  }
  std::vector<pipeline::ShadedTriangle> out;
  Draw draw;
  draw.cull = cull;
  pipeline::to_window({&draw, Topology::triangles, false, false, matrices}, polygon, out);
  return out;
}

std::vector<Fragment> drawn(const Corners& corners, Cull cull = Cull::none, glm::ivec2 shift = {0, 0}) {
  const auto triangles = window_triangles(corners, cull);
  return triangles.empty() ? std::vector<Fragment>{} : test::fragments(triangles[0], kScale, shift + 16);
}

void require_alike(const std::vector<Fragment>& a, const std::vector<Fragment>& b) {
  const std::string what = test::apart(a, b, 0);
  if (!what.empty()) RC_FAIL(what);
}

RC_GTEST_PROP(SnappedTriangles, AWholePixelShiftMovesEveryFragmentAndChangesNoBit, ()) {
  const Corners here = corners();
  const glm::ivec2 shift(*test::evenly(-300, 300), *test::evenly(-300, 300));
  Corners there = here;
  for (Corner& c : there) c.snapped += kSubpixel * shift;
  std::vector<Fragment> expected = drawn(here);
  for (Fragment& f : expected) f.x += shift.x, f.y += shift.y;
  RC_ASSERT(drawn(there, Cull::none, shift) == expected);
}

// The sums run in another order: colours, in float, may round otherwise.
RC_GTEST_PROP(SnappedTriangles, MirroredWindingWithCullFlippedIsTheSame, ()) {
  const Corners c = corners();
  const Corners mirrored{c[0], c[2], c[1]};
  require_alike(drawn(c, Cull::back), drawn(mirrored, Cull::front));
  require_alike(drawn(c, Cull::front), drawn(mirrored, Cull::back));
  require_alike(drawn(c), drawn(mirrored));
  RC_ASSERT(drawn(c, Cull::back).empty() || drawn(c, Cull::front).empty());
}

RC_GTEST_PROP(SnappedTriangles, RotatedVertexOrderIsTheSame, ()) {
  const Corners c = corners();
  require_alike(drawn(c), drawn({c[1], c[2], c[0]}));
  require_alike(drawn(c), drawn({c[2], c[0], c[1]}));
}

// Parts about any point: counter-clockwise ones count +1, clockwise ones -1; the sum is the triangle's own.
RC_GTEST_PROP(SnappedTriangles, PartsAroundAPointCoverWhatTheWholeCovers, ()) {
  const Corners c = corners();
  const Corner hub = corner();
  std::map<std::pair<int, int>, int> sum;
  const auto add = [&](const Corners& part, int sign) {
    for (const auto& t : window_triangles(part, Cull::none)) {
      test::for_each_covered(t, [&](const auto& p) { sum[{p.x, p.y}] += t.front ? sign : -sign; });
    }
  };
  for (std::size_t i = 0; i < 3; ++i) add({hub, c[i], c[(i + 1) % 3]}, 1);
  add(c, -1);
  for (const auto& [pixel, count] : sum) {
    if (count != 0) RC_FAIL(fmt::format("pixel {},{}: {} too many", pixel.first, pixel.second, count));
  }
}

// A grid whose vertices are moved, each within its own cell: its triangles share edges and do not overlap.
Scene moved_grid() {
  constexpr int kCells = 6, kCell = 12;  // pixels
  Scene scene;
  scene.frame.width = scene.frame.height = 64;
  scene.frame.color = static_cast<ColorFormat>(*test::evenly(0, 4));
  scene.frame.depth = static_cast<DepthFormat>(*test::evenly(0, 4));
  scene.projection = Orthographic{0, 64, 0, 64, 1, 10};
  Mesh mesh = make_grid(kCells, kCells);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::ivec2 cell(static_cast<int>(i) % (kCells + 1), static_cast<int>(i) / (kCells + 1));
    // Up to a quarter of a cell, and as often to a centre or a corner as anywhere.
    const auto move =
        rc::gen::oneOf(test::evenly(-kCell * 64, kCell * 64 + 1),
                       rc::gen::map(test::evenly(-kCell / 2, kCell / 2 + 1), [](int halves) { return halves * 128; }));
    const int x = cell.x * kCell * kSubpixel + *move, y = cell.y * kCell * kSubpixel + *move;
    mesh.positions[i] = glm::vec3(x / 256.0 - 4, y / 256.0 - 4, static_cast<float>(*test::evenly(-3, 4)));
    const auto n = static_cast<double>(i);
    mesh.colors.emplace_back(std::fmod(n, 3) / 2, std::fmod(n, 5) / 4, std::fmod(n, 7) / 6, 1);
  }
  scene.meshes.push_back(mesh);
  scene.draws.emplace_back();
  scene.draws[0].lit = false;
  scene.draws[0].shading = Shading::flat;  // a pixel painted twice shows the second colour
  scene.draws[0].depth_func = DepthFunc::always;
  return scene;
}

RC_GTEST_PROP(SnappedTriangles, PermutedTrianglesThatDoNotOverlapChangeNoBit, ()) {
  Scene scene = moved_grid();
  const pipeline::Frame before = pipeline::render(scene);
  auto& triangles = scene.meshes[0].triangles;
  for (std::size_t i = triangles.size() - 1; i > 0; --i) {
    std::swap(triangles[i], triangles[*test::evenly<std::size_t>(0, i + 1)]);
  }
  const pipeline::Frame after = pipeline::render(scene);
  RC_ASSERT(after.color_rgba8.values() == before.color_rgba8.values());
  RC_ASSERT(after.color_rgba16.values() == before.color_rgba16.values());
  RC_ASSERT(after.color_rgba32f.values() == before.color_rgba32f.values());
  RC_ASSERT(after.depth_code.values() == before.depth_code.values());
  RC_ASSERT(after.depth_z32f.values() == before.depth_z32f.values());
}

}  // namespace
}  // namespace plumbline
