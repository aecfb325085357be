// Records in any order, and without what follows from others.
#include "capture/complete_records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <random>

#include <fmt/format.h>

#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/capture/differing_arrays.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

using test::differing_records;
using testing::IsEmpty;

Capture whole_capture(const Scene& scene) {
  return pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
}

template <class T>
void permute(std::vector<T>& column, const std::vector<std::size_t>& order) {
  if (column.size() != order.size()) return;
  const std::vector<T> was = column;
  for (std::size_t i = 0; i < order.size(); ++i) column[i] = was[order[i]];
}

void shuffle_all(Records<double>& r, std::mt19937& random) {
  std::ranges::shuffle(r.polygons.polygons, random);
  std::vector<std::size_t> order(r.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});  // a polygon's triangles stay in their order
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return r.triangles[i].primitive * 2654435761u; });
  std::vector<std::uint32_t> now(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) now[order[i]] = static_cast<std::uint32_t>(i);
  permute(r.triangles, order);
  for (const Varying v : kAllVaryings) permute(r.varyings[v].triangles, order);
  for (Covered& c : r.covered) c.triangle = now[c.triangle];
  std::vector<std::size_t> fragments(r.covered.size());
  std::iota(fragments.begin(), fragments.end(), std::size_t{0});
  std::ranges::shuffle(fragments, random);
  permute(r.covered, fragments), permute(r.depth, fragments), permute(r.attributes, fragments);
  permute(r.texels, fragments), permute(r.shaded, fragments), permute(r.drawn, fragments);
  for (const Varying v : kAllVaryings) permute(r.varyings[v].fragments, fragments);
}

bool is_large(const Scene& scene) {
  return std::ranges::any_of(scene.meshes, [](const Mesh& m) { return m.triangles.size() > 100'000; });
}

TEST(CompleteRecords, LeaveACaptureInOrderAsItIs) {
  std::size_t scenes = 0;
  for (const auto& file : suite_files()) {
    const Scene scene = load_scene(file, {});
    if (antialiased(scene) || is_large(scene) || scene.frame.width * scene.frame.height > 100'000) continue;
    Capture capture;
    try {
      capture = whole_capture(scene);
    } catch (const OverBudget&) {
      continue;
    }
    if (capture.records.covered.size() > 300'000) continue;
    const Capture was = capture;
    complete_records(scene, capture);
    EXPECT_THAT(differing_records(was, capture), IsEmpty()) << file;
    ++scenes;
  }
  EXPECT_GT(scenes, 200u);
}

TEST(CompleteRecords, PutShuffledRecordsInOrder) {
  std::mt19937 random(7);
  for (const char* name :
       {"coverage/shared_edges", "texture/floor_modulated", "light/all_at_once", "clip/six_planes"}) {
    const Scene scene = suite_scene(name);
    const Capture was = whole_capture(scene);
    Capture capture = was;
    shuffle_all(capture.records, random);
    EXPECT_GT(differing_records(was, capture).size(), 4u) << name;
    complete_records(scene, capture);
    EXPECT_THAT(differing_records(was, capture), IsEmpty()) << name;
  }
}

// Every scene whose polygons are filled.
TEST(CompleteRecords, FillWhatFollowsFromOthers) {
  std::size_t scenes = 0;
  for (const auto& file : suite_files()) {
    const Scene scene = load_scene(file, {});
    const auto outlines = [&](const Draw& draw) {
      return scene.meshes[draw.mesh].topology == Topology::triangles && !is_filled(draw);
    };
    if (antialiased(scene) || is_large(scene) || std::ranges::any_of(scene.draws, outlines)) continue;
    const StageSet up_to_window = {Stage::matrices, Stage::vertex, Stage::clip, Stage::window};
    const Capture was = pipeline::make_pipeline()->capture(scene, {up_to_window, false, {}, {}});
    Capture capture = was;
    for (WindowTriangle<double>& t : capture.records.triangles) {
      t.front = false, t.corners = 3, t.width = 1;
      for (WindowVertex<double>& v : t.v) v.snapped = {};
    }
    for (ClipVertex<double>& v : capture.records.polygons.vertices) v.cut = !v.cut;
    capture.derived = {"clip.cut", "window.front", "window.corners", "window.width", "window.snapped"};
    complete_records(scene, capture);
    EXPECT_THAT(differing_records(was, capture), IsEmpty()) << file;
    ++scenes;
  }
  EXPECT_GT(scenes, 300u);
}

// A program's capture is completed once where it is read, and again where it is replayed.
TEST(CompleteRecords, KeepWhoSnappedThePositions) {
  const Scene scene = suite_scene("coverage/fan");
  Capture capture = whole_capture(scene);
  complete_records(scene, capture);
  EXPECT_EQ(capture.snapped_by, SnappedBy::renderer);
  capture.derived = {"window.snapped"};
  for (int i = 0; i < 2; ++i) {
    complete_records(scene, capture);
    EXPECT_EQ(capture.snapped_by, SnappedBy::conventions);
  }
}

// In double, of matrices in float: as near as the pipeline's own normals.
TEST(CompleteRecords, FillNormalsByTheMatrices) {
  for (const char* name : {"light/normals_uneven", "light/normals_grown", "light/sphere_gouraud"}) {
    const Scene scene = suite_scene(name);
    const Capture was = whole_capture(scene);
    Capture capture = was;
    for (Vertex<double>& v : capture.records.vertices) v.n_eye = {};
    capture.derived = {"vertex.n_eye"};
    complete_records(scene, capture);
    for (std::size_t i = 0; i < was.records.vertices.size(); ++i) {
      ASSERT_LT(glm::distance(was.records.vertices[i].n_eye, capture.records.vertices[i].n_eye), 1e-5) << name;
    }
  }
}

// Positions that fragments' are interpolated from are the renderer's own, with its roundings. A wrong one is none.
TEST(CompleteRecords, TakeShownPositionsForThoseInEyeSpace) {
  const Scene scene = suite_scene("phong/mirror_floor");
  Capture capture = whole_capture(scene);
  auto& shown = capture.records.varyings[Varying::position].vertices;
  ASSERT_FALSE(shown.empty());
  shown[0].z += 0x1p-18;
  for (Vertex<double>& v : capture.records.vertices) v.p_eye = {};
  capture.derived = {"vertex.p_eye"};
  complete_records(scene, capture);
  EXPECT_EQ(Vec3<double>(capture.records.vertices[0].p_eye), Vec3<double>(shown[0]));
  EXPECT_EQ(capture.records.vertices[0].p_eye.w, 1);
  shown[0].z += 1e-3;
  capture.derived = {"vertex.p_eye"};
  complete_records(scene, capture);
  EXPECT_LT(std::abs(capture.records.vertices[0].p_eye.z - shown[0].z + 1e-3), 1e-4) << "light's mistake";
}

TEST(CompleteRecords, TakeADepthInFloatForTheNearestCode) {
  const Scene scene = suite_scene("coverage/shared_edges");
  const Capture was = whole_capture(scene);
  Capture capture = was;
  for (double& z : capture.planes.depth.values()) z = static_cast<float>(z);
  const auto completed = [&](Capture of, Depths depths = Depths::of_codes) {
    complete_records(scene, of, {}, depths);
    return of.planes.depth.values();
  };
  EXPECT_EQ(completed(capture), was.planes.depth.values()) << "floats of codes, in doubles";
  EXPECT_EQ(completed(capture, Depths::raw), capture.planes.depth.values());
  capture.planes.depth(0, 0) = 0.3f;
  EXPECT_EQ(completed(capture), capture.planes.depth.values()) << "a float that is none of a code";
  capture.depth_in_float = true;
  EXPECT_NE(completed(capture), capture.planes.depth.values());
  capture.depth_in_float = false;
  std::ranges::fill(capture.planes.depth.values(), static_cast<double>(0.7f));
  EXPECT_EQ(completed(capture)[0], std::nearbyint(static_cast<double>(0.7f) * 16777215) / 16777215);
  capture.depth_in_float = true;
  EXPECT_EQ(completed(capture, Depths::raw), capture.planes.depth.values());
}

// A renderer's buffer may hold doubles: what it declares is as fine.
TEST(CompleteRecords, TakeDepthsForThoseOfTheDeclaredFormat) {
  const Scene scene = suite_scene("coverage/shared_edges");
  Conventions conventions;
  const auto stored = [&](Conventions::Depth format, double z, bool in_float) {
    conventions.depth_format = format;
    Capture capture = whole_capture(scene);
    capture.planes.depth(0, 0) = z, capture.depth_in_float = in_float;
    complete_records(scene, capture, conventions);
    return capture.planes.depth(0, 0);
  };
  EXPECT_EQ(stored(Conventions::Depth::z32f, 0.1, false), static_cast<double>(0.1f));
  EXPECT_EQ(stored(Conventions::Depth::as_asked, 0.1, false), 0.1);
  for (const int code : {1, 21845, 40000, 65534}) {
    const double z = code / 65535.0;
    EXPECT_EQ(stored(Conventions::Depth::z16, 1 - (65535 - code) / 65535.0, false), z) << "off by roundings of double";
    EXPECT_EQ(stored(Conventions::Depth::z16, code * (1 / 65535.0), false), z);
    EXPECT_EQ(stored(Conventions::Depth::z16, static_cast<double>(static_cast<float>(z)), false), z) << "by float";
    EXPECT_EQ(stored(Conventions::Depth::z16, (static_cast<float>(2 * z - 1) + 1.0) / 2, false), z);
    EXPECT_NE(stored(Conventions::Depth::z16, z + 0x1p-20, false), z);
    const double fine = (256 * code + 77) / 16777215.0;
    EXPECT_EQ(stored(Conventions::Depth::as_asked, fine + 0x1p-51, false), fine);
    EXPECT_NE(stored(Conventions::Depth::as_asked, fine + 0x1p-48, false), fine);
  }
  EXPECT_EQ(stored(Conventions::Depth::z16, static_cast<double>(0.1f), true), 6554.0 / 65535);
}

void expect_refused(const Scene& scene, Capture capture, const std::string& says) {
  try {
    complete_records(scene, capture);
    FAIL() << says;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(CompleteRecords, RefuseWhatNothingFollowsFrom) {
  const Scene scene = suite_scene("coverage/shared_edges");
  for (const double odd : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Capture capture = whole_capture(scene);
    capture.derived = {"window.snapped"};
    capture.records.triangles[3].v[1].p_win.y = odd;
    expect_refused(scene, capture, "window.snapped: left out, and the p_win of record 3 is (");
  }
  Capture capture = whole_capture(scene);
  capture.derived = {"vertex.n_eye"};
  capture.records.matrices.push_back(capture.records.matrices.front());
  expect_refused(scene, capture, "vertex.n_eye: left out, and matrices.* are not there for all draws");
  capture = whole_capture(scene);
  capture.derived = {"vertex.n_eye"};
  const std::size_t vertices = capture.records.vertices.size();
  capture.records.vertices.pop_back();
  expect_refused(scene, capture,
                 fmt::format("vertex.*: expected {} vertices, as the scene has, found {}", vertices, vertices - 1));
  capture = whole_capture(scene);
  capture.derived = {"clip.cut"};
  capture.records.vertices.pop_back();
  expect_refused(scene, capture, "clip.cut: left out, and vertex.* are not there for all vertices");
  capture.records.vertices.clear();
  complete_records(scene, capture);
  EXPECT_TRUE(std::ranges::all_of(capture.records.polygons.vertices, &ClipVertex<double>::cut)) << "none is known";
  capture = whole_capture(scene);
  capture.records.triangles[2].primitive = 1u << 31;
  expect_refused(scene, capture, "window.primitive: record 2 is of primitive 2147483648");
  capture = whole_capture(scene);
  capture.derived = {"window.front"};
  constexpr int kMost = (1 << 30) - 1, kLeast = -kMost;
  for (std::size_t k = 0; k < 3; ++k)
    capture.records.triangles[0].v[k].snapped = {k == 1 ? kMost : kLeast, k == 2 ? kMost : kLeast};
  complete_records(scene, capture);
  EXPECT_TRUE(capture.records.triangles[0].front);
  for (const int beyond : {kMost + 1, kLeast - 1, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
    Capture far = whole_capture(scene);
    far.records.triangles[1].v[2].snapped.y = beyond;
    expect_refused(scene, far, "window.snapped: record 1 is at (");
  }
  const auto with_place = [&](double x) {
    Capture out = whole_capture(scene);
    out.derived = {"window.snapped"};
    out.records.triangles[1].v[2].p_win.x = x;
    return out;
  };
  for (const double x : {0x1p22 + 1, -1e300}) {
    expect_refused(scene, with_place(x), "window.snapped: left out, and the p_win of record 1 is (");
    Capture beyond = with_place(x), without = beyond;
    beyond.records.polygons.vertices[0].p_clip = {0x1p20, 0, 0, 0x1p-4};
    complete_records(scene, beyond);
    EXPECT_TRUE(beyond.records.triangles.empty() && beyond.records.covered.empty() && beyond.records.shaded.empty());
    EXPECT_FALSE(beyond.records.polygons.polygons.empty());
    EXPECT_TRUE(std::ranges::equal(beyond.planes.color.values(), whole_capture(scene).planes.color.values()));
    without.records.polygons = {};
    complete_records(scene, without);
    EXPECT_TRUE(without.records.triangles.empty()) << "nobody knows how far its polygons reach";
  }
  Capture within = with_place(0x1p22 - 1);
  complete_records(scene, within);
  EXPECT_FALSE(within.records.triangles.empty() || within.records.covered.empty());
  for (const std::uint32_t width : {0u, 65u}) {
    capture = whole_capture(scene);
    capture.records.triangles[1].width = width;
    expect_refused(scene, capture, fmt::format("window.width: record 1: expected 1 to 64, found {}", width));
  }
}

// A vertex of the mesh may be a few roundings off, where clip positions are kept in another form.
TEST(CompleteRecords, TellCutsFromVerticesWithinFourRoundings) {
  const Scene scene = suite_scene("coverage/shared_edges");
  const auto cut = [&](double roundings) {
    Capture capture = whole_capture(scene);
    capture.derived = {"clip.cut"};
    glm::dvec4& p = capture.records.polygons.vertices.at(0).p_clip;
    const glm::dvec4 size = glm::abs(p);
    p.z += roundings * 0x1p-24 * std::max({size.x, size.y, size.z, size.w});
    complete_records(scene, capture);
    return capture.records.polygons.vertices.at(0).cut;
  };
  EXPECT_FALSE(cut(0));
  EXPECT_FALSE(cut(3.9));
  EXPECT_TRUE(cut(4.1));
}

TEST(CompleteRecords, SnapToTheGridOfTheConventions) {
  const Scene scene = suite_scene("cull/both_windings");
  const auto derived = [&](int bits, Conventions::Rounding rounding) {
    Capture capture = whole_capture(scene);
    capture.derived = {"window.snapped"};
    capture.records.triangles[0].v[0].p_win = {10.5 + 100.7 / 256, 20.5 - 100.7 / 256, 0.5};
    Conventions conventions;
    conventions.subpixel_bits = bits;
    conventions.subpixel_rounding = rounding;
    complete_records(scene, capture, conventions);
    return capture.records.triangles[0].v[0].snapped - glm::ivec2(2560, 5120);
  };
  using enum Conventions::Rounding;
  EXPECT_EQ(derived(8, nearest), glm::ivec2(101, -101));
  EXPECT_EQ(derived(8, down), glm::ivec2(100, -101));
  EXPECT_EQ(derived(4, nearest), glm::ivec2(96, -96));
  EXPECT_EQ(derived(4, up), glm::ivec2(112, -96));
  EXPECT_EQ(derived(Conventions::kFloat, down), glm::ivec2(101, -101));
  EXPECT_EQ(derived(12, down), glm::ivec2(101, -101));
}

TEST(CompleteRecords, ClearTheVaryingsThatADrawDoesNotCarry) {
  const Scene scene = suite_scene("fog/per_draw");
  const Capture was = whole_capture(scene);
  Capture capture = was;
  const auto fill = [](auto& column, auto value) {
    for (auto& record : column) record = record == decltype(value){} ? value : record;
  };
  constexpr Vec4<double> kLeft(1, 2, 3, 4);
  auto& position = capture.records.varyings[Varying::position];
  fill(position.vertices, kLeft), fill(position.clipped, kLeft), fill(position.fragments, kLeft);
  fill(position.triangles, std::array{kLeft, kLeft, kLeft});
  EXPECT_EQ(differing_records(was, capture).size(), 4u) << "some draw has no fog";
  complete_records(scene, capture);
  EXPECT_THAT(differing_records(was, capture), IsEmpty());
}

// A step of 1/256 pixel above the base, or below it; snapped to half a pixel, it lies on the base.
TEST(CompleteRecords, FaceWhatIsNotCulled) {
  Scene scene = suite_scene("coverage/shared_edges");
  const Capture whole = whole_capture(scene);
  const auto front = [&](double steps, int bits, Cull cull) {
    scene.draws[0].cull = cull;
    Capture capture = whole;
    capture.records.triangles.resize(1);
    capture.records.covered.clear();
    WindowTriangle<double>& t = capture.records.triangles[0];
    t.corners = 3, t.width = 1;
    t.v[0].p_win = {10, 20, 0.5}, t.v[1].p_win = {20, 20, 0.5}, t.v[2].p_win = {15, 20 + steps / 256, 0.5};
    capture.derived = {"window.front", "window.snapped"};
    Conventions conventions;
    conventions.subpixel_bits = bits;
    complete_records(scene, capture, conventions);
    return capture.records.triangles[0].front;
  };
  for (const Cull cull : {Cull::none, Cull::front, Cull::back}) {
    EXPECT_TRUE(front(2, 8, cull)) << "as on the grid, culled or not";
    EXPECT_FALSE(front(-2, 8, cull));
  }
  EXPECT_FALSE(front(2, 1, Cull::none)) << "no area on the grid";
  EXPECT_TRUE(front(2, 1, Cull::back));
  EXPECT_FALSE(front(2, 1, Cull::front));
  EXPECT_FALSE(front(0.02, Conventions::kFloat, Cull::front)) << "by equation 3.6 in float";
  EXPECT_TRUE(front(0.04, Conventions::kFloat, Cull::front));
}

TEST(CompleteRecords, RefuseToGuessTheFacingOfOutlines) {
  const Scene scene = suite_scene("polygon_mode/wireframe");
  for (const char* column : {"window.front", "window.corners"}) {
    Capture capture = whole_capture(scene);
    capture.derived = {column};
    expect_refused(scene, capture, std::string(column) + ": left out, and a draw's polygons are not filled");
  }
}

}  // namespace
}  // namespace plumbline
