// Values for which a triangle without area has no bound: open there, and nowhere else.
#include "check/compare/blending.h"
#include "check/compare/compare_records.h"
#include "check/compare/compare_texels.h"
#include "check/diagnose/known_causes.h"
#include "tests/check/compare/planes.h"

namespace plumbline::check {
namespace {

constexpr int kSize = 96;

struct Unbounded : testing::Test {
  Unbounded() {
    scene.frame.width = scene.frame.height = kSize;
    scene.meshes.push_back(make_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}));
    scene.draws.emplace_back().lit = false;
  }
  // One fragment of the triangles, at a pixel, with what both sides' frames hold there.
  Capture fragment_at(const std::vector<WindowTriangle<double>>& triangles, glm::ivec2 pixel, double z) const {
    Capture out;
    out.width = out.height = kSize;
    out.records.triangles = triangles;
    out.records.covered = {
        {.triangle = 0, .x = static_cast<std::uint16_t>(pixel.x), .y = static_cast<std::uint16_t>(pixel.y)}};
    out.records.depth = {z};
    out.records.drawn = {{true}};
    out.planes.id = Plane<std::int32_t>(kSize, kSize, kBackground);
    out.planes.depth = Plane<double>(kSize, kSize, 1);
    out.planes.shaded = out.planes.color = Plane<glm::vec4>(kSize, kSize, glm::vec4(0, 0, 0, 1));
    out.planes.id(pixel.x, pixel.y) = 0;
    out.planes.depth(pixel.x, pixel.y) = z;
    out.planes.shaded(pixel.x, pixel.y) = out.planes.color(pixel.x, pixel.y) = glm::vec4(0.5f);
    return out;
  }
  Scene scene;
};

const WindowTriangle<double> kFat = triangle_of({{{0.5, 0.5, 0.5}, {90.5, 0.5, 0.5}, {0.5, 90.5, 0.5}}});
const WindowTriangle<double> kSliver = triangle_of({{{90.5, 0.5, 0.5}, {0.5, 90.5, 0.5}, {45.5000001, 45.5, 0.5}}});

// Corners in line but for rounding, whose snapped area is not 0: a stranger's depth may be any.
TEST_F(Unbounded, DepthsOfAStrangersSliverAreOpen) {
  const auto at = [](double x, double y, double z) { return glm::dvec3(0.5 + x / 256, 0.5 + y / 256, z); };
  const auto sliver =
      triangle_of({at(0.5001, 0.4999, 0.1), at(16384.5001, 16384.4999, 0.9), at(8192.4999, 8192.5001, 0.5)});
  ASSERT_TRUE(area_may_vanish(sliver));
  scene.frame.depth = DepthFormat::z32f;
  const auto compared = [&](const WindowTriangle<double>& t, double z, double from_origin) {
    const Records<double> theirs = fragment_at({t}, {20, 20}, 0.35).records;
    Records<double> mine = theirs;
    mine.depth = {z};
    return compare_depth(scene, mine, theirs, 0.501, {}, from_origin);
  };
  EXPECT_TRUE(passes(compared(sliver, 0.9, 4)));
  EXPECT_EQ(compared(sliver, 0.9, 4).ambiguous, 1u);
  EXPECT_TRUE(fails(compared(sliver, kNaN, 4)));
  EXPECT_TRUE(fails(compared(sliver, 0.9, 0))) << "ours";
  EXPECT_TRUE(passes(compared(kFat, 0.35 + 4 * kU, 4)));
  EXPECT_TRUE(fails(compared(kFat, 0.3501, 4)));
}

// No plane goes through corners on one line of the grid, whose samples an inclusive rule takes.
TEST_F(Unbounded, DepthsWithoutAPlaneAreOpen) {
  WindowTriangle<double> line = kSliver;
  for (WindowVertex<double>& v : line.v) v.snapped.y = 20 * 256;
  const auto compared = [&](const WindowTriangle<double>& t, double mine_z, double theirs_z, double from_origin) {
    Records<double> theirs = fragment_at({t}, {20, 20}, theirs_z).records, mine = theirs;
    mine.depth = {mine_z};
    return compare_depth(scene, mine, theirs, 0.501, {}, from_origin);
  };
  EXPECT_TRUE(passes(compared(line, kNaN, kNaN, 4)));
  EXPECT_EQ(compared(line, 0.25, kNaN, 4).ambiguous, 1u);
  EXPECT_TRUE(fails(compared(line, 0.25, kNaN, 0))) << "ours";
  EXPECT_TRUE(fails(compared(kFat, kNaN, kNaN, 4)));
  EXPECT_TRUE(fails(compared(line, kNaN, 0.25, 4)));
}

TEST_F(Unbounded, BlendsOfManyLayersAreOpen) {
  scene.frame.color = ColorFormat::rgba32f;
  Planes exact = fragment_at({kFat}, {20, 20}, 0.5).planes;
  exact.depth = {};
  const auto compared = [&](float red, double roundings) {
    Planes mine = exact;
    mine.color(20, 20).r = red;
    return compare_merge(scene, mine, exact, 1, {}, {}, Plane<double>(kSize, kSize, roundings));
  };
  EXPECT_TRUE(passes(compared(0.50000006f, 16)));
  EXPECT_TRUE(fails(compared(0.51f, 16)));
  EXPECT_TRUE(passes(compared(0.51f, kInf)));
  EXPECT_TRUE(fails(compared(std::numeric_limits<float>::quiet_NaN(), kInf)));
}

// A sliver on the long side of its primitive opens the pixels beside it, not those that the other piece covers alone.
TEST_F(Unbounded, ASliverOpensThePixelsBesideIt) {
  ASSERT_TRUE(area_may_vanish(kSliver));
  const auto depth = [&](const std::vector<WindowTriangle<double>>& pieces, glm::ivec2 pixel) {
    const Capture theirs = fragment_at(pieces, pixel, 0.5);
    Capture mine = theirs;
    mine.planes.depth(pixel.x, pixel.y) = 0.9;
    return compare_depth_planes(scene, mine, theirs, 4);
  };
  const auto color = [&](const std::vector<WindowTriangle<double>>& pieces, glm::ivec2 pixel) {
    const Capture theirs = fragment_at(pieces, pixel, 0.5);
    Capture mine = theirs;
    mine.planes.shaded(pixel.x, pixel.y) = glm::vec4(0.1f);
    return compare_shaded_planes(scene, mine, theirs, 8);
  };
  const glm::ivec2 far(10, 10), beside(45, 45);
  EXPECT_TRUE(fails(depth({kFat, kSliver}, far)));
  EXPECT_TRUE(passes(depth({kFat, kSliver}, beside)));
  EXPECT_TRUE(fails(depth({kFat}, beside)));
  EXPECT_TRUE(passes(depth({kSliver}, far))) << "nothing else says what is there";
  EXPECT_TRUE(fails(color({kFat, kSliver}, far)));
  EXPECT_TRUE(passes(color({kFat, kSliver}, beside)));
}

// Where edges meet, the reference may hold either edge's value, and the candidate one of both.
TEST_F(Unbounded, WhereEdgesMeetTheCandidateHoldsTheValueOfOne) {
  const auto edge = [](const glm::dvec3& from, const glm::dvec3& to) {
    WindowTriangle<double> t = triangle_of({from, to, to});
    t.corners = 2;
    for (auto& corner : t.v) corner.color = glm::dvec4(from.z);
    return t;
  };
  const Capture theirs = [&] {
    Capture out = fragment_at(
        {edge({50.5, 10.5, 0.5}, {10.5, 10.5, 0.5}), edge({10.5, 10.5, 0.25}, {10.5, 50.5, 0.25})}, {12, 10}, 0.5);
    return out;
  }();
  const auto depth = [&](double z) {
    Capture mine = theirs;
    mine.planes.depth(12, 10) = z;
    return compare_depth_planes(scene, mine, theirs, 4);
  };
  EXPECT_TRUE(passes(depth(0.5)));
  EXPECT_TRUE(passes(depth(0.25)));
  EXPECT_TRUE(fails(depth(0.9)));
  EXPECT_TRUE(fails(depth(kNaN)));
  const auto shaded = [&](const glm::vec4& color) {
    Capture mine = theirs;
    mine.planes.shaded(12, 10) = color;
    return compare_shaded_planes(scene, mine, theirs, 8);
  };
  const auto codes = [&](const glm::vec4& color) {
    Capture mine = theirs;
    mine.planes.color(12, 10) = color;
    return compare_codes(scene, mine, theirs, 1, 8);
  };
  for (const auto& compared : {std::function(shaded), std::function(codes)}) {
    EXPECT_TRUE(passes(compared(glm::vec4(0.5f))));
    EXPECT_TRUE(passes(compared(glm::vec4(0.25f))));
    EXPECT_TRUE(fails(compared({0.25f, 0.25f, 0.25f, 0.9f}))) << "one channel of neither";
    EXPECT_TRUE(fails(compared(glm::vec4(0.9f))));
  }
}

// An image of floats beside does not widen what is allowed of another texture.
TEST_F(Unbounded, TexelsAreHeldToTheirOwnTexturesMagnitude) {
  const auto of_one_texel = [](const glm::vec4& texel) {
    Texture out;
    out.levels.resize(1);
    out.levels[0].width = out.levels[0].height = 1;
    out.levels[0].texels = {texel};
    return out;
  };
  scene.textures = {of_one_texel(glm::vec4(0.5f)), of_one_texel(glm::vec4(60000))};
  Records<double> theirs = fragment_at({kFat}, {1, 1}, 0.5).records;
  theirs.texels = {{glm::dvec4(0.5), 0}};
  const auto compared = [&](std::uint32_t texture, double off) {
    scene.draws[0].texture = DrawTexture{texture, {}};
    Records<double> mine = theirs;
    mine.texels[0].color.r += off;
    return compare_texels(scene, mine, theirs, 3);
  };
  EXPECT_TRUE(fails(compared(0, 2 / 255.0)));
  EXPECT_TRUE(passes(compared(0, 2 * kU)));
  EXPECT_TRUE(passes(compared(1, 2 / 255.0)));
}

TEST_F(Unbounded, ATriangleOfNoFragmentsIsTheSumOfThem) {
  Capture none = fragment_at({kFat}, {1, 1}, 0.5);
  none.records.covered.clear();
  none.planes.count = Plane<std::uint32_t>(kSize, kSize, 0);
  EXPECT_TRUE(are_sums_of(none.records, none.planes));
  none.planes.count(3, 4) = 1;
  EXPECT_FALSE(are_sums_of(none.records, none.planes));
}

TEST_F(Unbounded, CornersThatCoincideHaveNoEdge) {
  const auto point = triangle_of({{{2.5, 2.5, 0}, {2.5, 2.5, 0}, {12.5, 2.5, 0}}});
  EXPECT_FALSE(on_an_edge(point, {90, 77}, {0, 0}));
  EXPECT_TRUE(on_an_edge(point, {7, 2}, {0, 0}));
}

}  // namespace
}  // namespace plumbline::check
