// Stages 3 to 7 of lines and points, by hand.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "faults/pixel_barycentrics.h"
#include "kernels/attributes.h"
#include "kernels/coverage.h"
#include "kernels/depth.h"
#include "kernels/line_diamond.h"
#include "pipeline/geometry.h"
#include "renderers/pipeline_renderer.h"
#include "tests/pipeline/window_triangles.h"

namespace plumbline::pipeline {
namespace {

using testing_words::color_setup;
using testing_words::window_primitive;
using testing_words::window_vertex;

Polygon clipped(Topology topology, std::vector<glm::vec4> p_clip, Shading shading = Shading::gouraud) {
  std::vector<Vertex<float>> vertices;
  for (const glm::vec4& p : p_clip) vertices.push_back({{}, p, {}});
  Attributes attributes[2] = {};
  attributes[0].color() = {1, 0, 0, 1}, attributes[1].color() = {0, 1, 0, 0};
  Draw draw;
  draw.shading = shading;
  const DrawInput input{&draw, topology, false, false, {}};
  Polygon out =
      assemble(input, topology == Topology::lines ? glm::uvec3(0, 1, 1) : glm::uvec3(0), vertices, attributes);
  clip(input, out);
  return out;
}
std::vector<ClipVertex> line(glm::vec4 a, glm::vec4 b, Shading shading = Shading::gouraud) {
  const Polygon out = clipped(Topology::lines, {a, b}, shading);
  return {out.corners.begin(), out.corners.end()};
}

TEST(PipelineLines, ClipLeavesWhatIsInsideAsItIs) {
  const auto out = line({-1, 0, 0, 1}, {0.5f, 1, 1, 1});
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].p_clip, glm::vec4(-1, 0, 0, 1));
  EXPECT_EQ(out[1].p_clip, glm::vec4(0.5f, 1, 1, 1));
  EXPECT_FALSE(out[0].cut || out[1].cut);
  EXPECT_EQ(out[0].attributes.color(), glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(line({-1, 0, 0, 1}, {0.5f, 1, 1, 1}, Shading::flat)[0].attributes.color(),
            glm::vec4(0, 1, 0, 0));  // the last provokes
}

TEST(PipelineLines, ClipCutsAtEachPlane) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec4 in(0, 0, 0, 1), out(0, 0, 0, 1);
      out[axis] = 4 * side;
      for (const bool from_outside : {false, true}) {
        const auto v = from_outside ? line(out, in) : line(in, out);
        ASSERT_EQ(v.size(), 2u);
        const ClipVertex &kept = v[from_outside ? 1 : 0], &cut = v[from_outside ? 0 : 1];
        EXPECT_EQ(kept.p_clip, in);
        EXPECT_FALSE(kept.cut);
        EXPECT_TRUE(cut.cut);
        EXPECT_EQ(cut.p_clip[axis], side);
        // A quarter of the way from the inner end.
        EXPECT_EQ(cut.attributes.color(),
                  from_outside ? glm::vec4(0.25f, 0.75f, 0, 0.25f) : glm::vec4(0.75f, 0.25f, 0, 0.75f));
      }
    }
  }
}

TEST(PipelineLines, ClipTakesTheFarthestCutAtEitherEnd) {
  // Right at 1/4 and top at 1/2 of the way out: of the first end, the top's.
  const auto v = line({1.5f, 2, 0, 1}, {-0.5f, 0, 0, 1});
  ASSERT_EQ(v.size(), 2u);
  EXPECT_EQ(v[0].p_clip, glm::vec4(0.5f, 1, 0, 1));
  const auto both = line({-3, 0, 0, 1}, {3, 0, 0, 1});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[0].p_clip.x, -1, 1e-6);
  EXPECT_NEAR(both[1].p_clip.x, 1, 1e-6);
}

TEST(PipelineLines, ClipDropsWhatIsOutside) {
  EXPECT_TRUE(line({2, 0, 0, 1}, {3, 5, 0, 1}).empty());    // beyond one plane
  EXPECT_TRUE(line({-3, 0, 0, 1}, {0, 3, 0, 1}).empty());   // across a corner, violating two
  EXPECT_TRUE(line({0, 0, 0, -1}, {1, 0, 0, -2}).empty());  // behind the eye
  EXPECT_TRUE(line({0, 0, 0, 1}, {NAN, 0, 0, 1}).empty());
  EXPECT_TRUE(line({0, 0, 0, 1}, {0, std::numeric_limits<float>::infinity(), 0, 1}).empty());
}

TEST(PipelineLines, ClipKeepsOrDropsPoints) {
  const auto kept = [](glm::vec4 p) { return !clipped(Topology::points, {p, {}}).corners.empty(); };
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec4 p(0.25f, 0.25f, 0.25f, 1);
      p[axis] = side;
      EXPECT_TRUE(kept(p));
      p[axis] = std::nextafter(side, 2 * side);
      EXPECT_FALSE(kept(p));
    }
  }
  EXPECT_FALSE(kept({0, 0, 0, -1}));
  EXPECT_FALSE(kept({NAN, 0, 0, 1}));
  EXPECT_EQ(clipped(Topology::points, {{0, 0, 0, 1}, {}}).corners.size(), 1u);
}

TEST(PipelineLines, WindowNeitherCullsNorDrops) {
  Matrices<float> m{};
  m.win_scale = {8, 8, 0.5f};
  m.win_translate = {8, 8, 0.5f};
  Polygon of_line{3, {}}, of_point{4, {}};
  ClipVertex v{{0, 0, 0, 1}, {}, false}, w{{1, 0, 0, 2}, {}, true};
  v.attributes.color() = {1, 0, 0, 1}, w.attributes.color() = {0, 1, 0, 1};
  of_line.corners.push_back(v), of_line.corners.push_back(w), of_point.corners.push_back(w);
  for (const Cull cull : {Cull::none, Cull::back, Cull::front}) {
    std::vector<ShadedTriangle> out;
    Draw draw;
    draw.cull = cull;
    for (const Polygon& polygon : {of_line, of_point}) {
      to_window({&draw, Topology::lines, false, false, m}, polygon, out);
    }
    ASSERT_EQ(out.size(), 2u);
    EXPECT_EQ(out[0].corners, 2u);
    EXPECT_EQ(out[1].corners, 1u);
    EXPECT_TRUE(out[0].front && out[1].front);
    EXPECT_EQ(out[0].v[0].snapped, glm::ivec2(7 * 256 + 128));
    EXPECT_EQ(out[0].v[1].p_win, glm::vec3(12, 8, 0.5f));
    EXPECT_EQ(out[0].v[2].p_win, out[0].v[1].p_win);
    EXPECT_EQ(out[0].v[1].inv_w, 0.5f);
    EXPECT_EQ(out[1].v[0].p_win, glm::vec3(12, 8, 0.5f));
    EXPECT_EQ(out[1].attributes[2].color(), glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(out[1].primitive, 4u);
  }
}

ShadedTriangle window_line(glm::vec3 a, glm::vec3 b, float w_b = 1) {
  const auto v = window_vertex(a, 1, {1, 0, 0, 1}), w = window_vertex(b, w_b, {0, 1, 0, 1});
  return window_primitive(v, w, w, 0, 2);
}
ShadedTriangle window_point(glm::vec3 p) {
  const auto v = window_vertex(p);
  return window_primitive(v, v, v, 0, 1);
}
std::vector<glm::ivec2> pixels_in(const ShadedTriangle& t, glm::ivec2 origin, int size) {
  return covered_pixels(t, {origin.x, origin.y, origin.x + size, origin.y + size});
}

TEST(PipelineLines, TilesSplitALineWithoutChangingIt) {
  for (const glm::vec2 b : {glm::vec2(150.3f, 40.1f), {3.2f, 131.9f}, {140.25f, 130.5f}, {-20, 64}, {64, -9}}) {
    const ShadedTriangle t = window_line({60.7f, 63.4f, 0}, {b, 0});
    std::vector<glm::ivec2> tiled;
    for (int y = 0; y < 192; y += 64) {
      for (int x = 0; x < 192; x += 64) {
        for (const glm::ivec2 p : pixels_in(t, {x, y}, 64)) tiled.push_back(p);
      }
    }
    std::vector<glm::ivec2> whole = raster::diamond_exit_line(t.v[0].snapped, t.v[1].snapped, {192, 192});
    const auto before = [](glm::ivec2 p, glm::ivec2 q) { return p.y != q.y ? p.y < q.y : p.x < q.x; };
    std::sort(tiled.begin(), tiled.end(), before);
    std::sort(whole.begin(), whole.end(), before);
    EXPECT_EQ(tiled, whole);
    EXPECT_FALSE(whole.empty());
    const PixelBounds bounds = pixel_bounds(t);
    for (const glm::ivec2 p : whole) {
      EXPECT_TRUE(p.x >= bounds.x0 && p.x < bounds.x1 && p.y >= bounds.y0 && p.y < bounds.y1);
    }
  }
}

TEST(PipelineLines, APointIsThePixelThatItLiesIn) {
  const auto pixels = [](float x, float y) { return pixels_in(window_point({x, y, 0}), {0, 0}, 64); };
  using Pixels = std::vector<glm::ivec2>;
  EXPECT_EQ(pixels(3.5f, 4.5f), (Pixels{{3, 4}}));
  EXPECT_EQ(pixels(3, 4), (Pixels{{3, 4}}));  // on the border: the pixel above and to the right
  EXPECT_EQ(pixels(3.99f, 4.99f), (Pixels{{3, 4}}));
  EXPECT_EQ(pixels(3.999f, 4.999f), (Pixels{{4, 5}}));  // snapped to the border
  EXPECT_EQ(pixels(0, 0), (Pixels{{0, 0}}));
  EXPECT_TRUE(pixels(-0.01f, 3).empty());
  EXPECT_TRUE(pixels(64, 3).empty());
  EXPECT_EQ(pixels_in(window_point({64, 65, 0}), {64, 64}, 64), (Pixels{{64, 65}}));
}

TEST(PipelineLines, DepthAndColorGoByTheProjectionOntoTheLine) {
  // From (2.5, 1.5) along (4, 2), |d|^2 = 20; the pixel above its middle projects 0.1 farther.
  const ShadedTriangle t = window_line({2.5f, 1.5f, 0.25f}, {6.5f, 3.5f, 0.75f});
  const BarycentricPlanes planes = planes_of(t, 0, 0);
  const DepthPlane z = depth_plane(depth_setup(t, {DepthFormat::z32f}), planes);
  const auto at = [&](int x, int y) { return from_anchor<float>(planes, Pixels<float>{x, y, x + 0.5, y + 0.5}); };
  const auto color = [&](const ShadedTriangle& line, int x, int y) {
    return mean<float>(color_setup(line), weights<float>(perspective_setup(line, planes, true), at(x, y)));
  };
  EXPECT_EQ(depth<float>(z, at(2, 1)), 0.25f);
  EXPECT_FLOAT_EQ(depth<float>(z, at(4, 2)), 0.5f);
  EXPECT_FLOAT_EQ(depth<float>(z, at(4, 3)), 0.55f);
  EXPECT_FLOAT_EQ(depth<float>(z, at(6, 3)), 0.75f);
  EXPECT_FLOAT_EQ(color(t, 4, 3).g, 0.6f);
  // Perspective, w 1 and 3: in the middle (0.5 * 1/3) / (0.5 + 0.5 / 3) = 1/4 of the second colour; z stays affine.
  const ShadedTriangle far = window_line({2.5f, 1.5f, 0.25f}, {6.5f, 3.5f, 0.75f}, 3);
  EXPECT_FLOAT_EQ(color(far, 4, 2).g, 0.25f);
  EXPECT_FLOAT_EQ(color(far, 4, 2).r, 0.75f);
}

TEST(PipelineLines, APointHasItsOwnDepthAndColor) {
  const ShadedTriangle t = window_point({2.75f, 1.25f, 0.3f});
  const BarycentricPlanes planes = planes_of(t, 0, 0);
  const Offset<float> at{2, 1};
  EXPECT_EQ(depth<float>(depth_plane(depth_setup(t, {DepthFormat::z32f}), planes), at), 0.3f);
  EXPECT_EQ(mean<float>(color_setup(t), weights<float>(perspective_setup(t, planes, true), at)).r, 1.0f);
  const ShadedTriangle nothing = window_line({2.5f, 1.5f, 0.25f}, {2.5f, 1.5f, 0.75f});  // no length: no NaN
  EXPECT_EQ(barycentric(planes_of(nothing, 0, 0), {2, 1, 2.5, 1.5}).l1, 0);
}

TEST(PipelineLines, RecordsThatAreNotLinesAreRefused) {
  Scene scene;
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 0, 1}}, {}, {{0, 1, 1}}, Topology::lines};
  scene.meshes = {mesh};
  scene.draws = {Draw{}};
  const auto ours = make_pipeline();
  Capture in = ours->capture(scene, {.records = StageSet::all()});
  ASSERT_EQ(in.records.triangles.size(), 1u);
  EXPECT_NO_THROW(ours->run_stage(scene, Stage::coverage, in));
  for (const std::uint32_t corners : {0u, 4u}) {
    in.records.triangles[0].corners = corners;
    EXPECT_THROW(ours->run_stage(scene, Stage::coverage, in), std::invalid_argument);
  }
  in.records.polygons.polygons[0].count = 0;
  EXPECT_THROW(ours->run_stage(scene, Stage::window, in), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline::pipeline
