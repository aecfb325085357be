// The oracle's parts: two independent ways of finding triangles come to the same legal answers, which are as narrow as
// the geometry says they should be.
#include <gtest/gtest.h>

#include "reference/embree/embree.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/pixel_hit.h"
#include "tests/cross/embree_scenes.h"
#include "tests/extent.h"

namespace plumbline {
namespace {

Legal by_rays(const Scene& scene) {
  Request request;
  request.legal = true;
  return embree::make_embree()->capture(scene, request).legal;
}

bool same(const LegalAnswer& a, const LegalAnswer& b) {
  return a.primitive == b.primitive && a.z_lo == b.z_lo && a.z_hi == b.z_hi && a.color == b.color &&
         a.color_bound == b.color_bound;
}

void expect_same(const Legal& a, const Legal& b, const std::string& name) {
  EXPECT_EQ(a.certain.values(), b.certain.values()) << name;
  EXPECT_EQ(a.possible.values(), b.possible.values()) << name;
  EXPECT_EQ(a.first, b.first) << name;
  ASSERT_EQ(a.answers.size(), b.answers.size()) << name;
  EXPECT_TRUE(std::equal(a.answers.begin(), a.answers.end(), b.answers.begin(), same)) << name;
  EXPECT_EQ(a.predicted_ambiguous, b.predicted_ambiguous) << name;
}

double ambiguous(const Legal& legal) {
  double count = 0;
  for (std::size_t i = 0; i + 1 < legal.first.size(); ++i) count += legal.first[i + 1] - legal.first[i] > 1 ? 1 : 0;
  return count;
}

class Finders : public ::testing::TestWithParam<int> {};

TEST_P(Finders, RaysAndBoxesComeToTheSameAnswers) {
  for (unsigned seed = 1; seed <= 25; seed += static_cast<unsigned>(one_of(8))) {
    const Scene scene = test::small_scene(GetParam(), seed);
    expect_same(by_rays(scene), math::legal_by_boxes(scene, Request{}), scene.name);
  }
}

// Sums over all scenes of a kind: a single small scene has too few ambiguous pixels.
TEST_P(Finders, AmbiguousPixelsAreAtMostTwiceThePrediction) {
  double counted = 0, predicted = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Scene scene = test::small_scene(GetParam(), seed);
    const Legal legal = math::legal_by_boxes(scene, Request{});
    counted += ambiguous(legal);
    predicted += legal.predicted_ambiguous;
  }
  std::printf("kind %d: %.0f counted, %.0f predicted\n", GetParam(), counted, predicted);
  EXPECT_GT(counted, 20);
  EXPECT_LE(counted, 2 * predicted);
  EXPECT_GE(counted, 0.1 * predicted);  // a prediction of anything would prove nothing
}
INSTANTIATE_TEST_SUITE_P(Kinds, Finders, ::testing::Range(0, test::kSceneKinds));

/// Pixels that a closed mesh covers, by double's planes, and those of them where the background may be seen.
struct Leaks {
  long covered = 0, leaking = 0, ambiguous = 0;
  double predicted = 0;
};
Leaks leaks(const Scene& scene) {
  Request request;
  request.legal = true;
  const Capture capture = embree::make_embree()->capture(scene, request);
  Leaks out;
  out.predicted = capture.legal.predicted_ambiguous;
  for (int y = 0; y < scene.frame.height; ++y) {
    for (int x = 0; x < scene.frame.width; ++x) {
      const auto answers = capture.legal.at(x, y);
      out.ambiguous += answers.size() > 1 ? 1 : 0;
      if (capture.planes.id(x, y) == kBackground) continue;
      ++out.covered;
      out.leaking += answers.front().primitive == kBackground ? 1 : 0;
    }
  }
  return out;
}

// A silhouette is open to the background within delta; its pixels are about 2 pi r delta of the pi r^2 covered, so that
// a sphere that fills the frame's height h leaks on 4 delta / h of them: 2e-5 at 512. Edges within it must not.
class ClosedMesh : public ::testing::TestWithParam<Cull> {};

TEST_P(ClosedMesh, TheBackgroundShowsThroughUnderOneHundredthPercentOfIt) {
  Scene scene = test::sphere_scene(512, 512, 60, 90, GetParam());
  const Leaks out = leaks(scene);
  std::printf("%ld covered, %ld leaking, %ld ambiguous, %.1f predicted\n", out.covered, out.leaking, out.ambiguous,
              out.predicted);
  EXPECT_GT(out.covered, 100000);
  EXPECT_LT(static_cast<double>(out.leaking), 1e-4 * static_cast<double>(out.covered));
  EXPECT_LE(static_cast<double>(out.ambiguous), 2 * out.predicted);
  EXPECT_GT(out.ambiguous, 100);  // shared edges: either side
}
INSTANTIATE_TEST_SUITE_P(Culls, ClosedMesh, ::testing::Values(Cull::none, Cull::back, Cull::front));

/// A triangle facing the viewer, given in pixels of a width x height frame, at window depth z.
void add_triangle(Scene& scene, std::array<glm::dvec2, 3> p, double z, DepthFunc func = DepthFunc::less) {
  Mesh mesh;
  for (const glm::dvec2& at : p) {
    test::add_vertex(mesh, glm::vec3(at, -1 - 2 * z), {0, 0, 1}, {1, 0, 0, 1});
  }
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  scene.draws.push_back(test::unlit(static_cast<std::uint32_t>(scene.meshes.size() - 1), Cull::none, func));
}
Scene flat_scene(int width, int height) {
  Scene scene = test::frame_of(width, height);
  scene.camera.eye = {0, 0, 0};
  scene.camera.center = {0, 0, -1};
  scene.projection = Orthographic{0, static_cast<double>(width), 0, static_cast<double>(height), 1, 3};
  return scene;
}
std::vector<int> ids(const Legal& legal, int x, int y) {
  std::vector<int> out;
  for (const LegalAnswer& a : legal.at(x, y)) out.push_back(a.primitive);
  return out;
}
using Ids = std::vector<int>;

// Two triangles in one place, both moved beyond depth 0, or one triangle drawn twice: a tie, which is no ambiguity, and
// none is predicted. Where the format does not tell the depths of two triangles apart it is one, and is.
TEST(Prediction, KnowsTiesOfClampedDepths) {
  const auto legal_of = [](float units, double nearer) {
    Scene scene = flat_scene(40, 40);
    scene.frame.depth = DepthFormat::z16;
    for (const double z : {0.5, nearer}) {
      add_triangle(scene, {{{2.3, 2.3}, {37.1, 2.7}, {3.9, 36.3}}}, z);
      scene.draws.back().polygon_offset.units = units;
    }
    return math::legal_by_boxes(scene, Request{});
  };
  constexpr double kCovered = 585;
  const Legal tied = legal_of(-1e6f, 0.25), apart = legal_of(0, 0.25), open = legal_of(0, 0.500001),
              again = legal_of(0, 0.5);
  EXPECT_LT(ambiguous(tied), 20);
  EXPECT_LT(tied.predicted_ambiguous, 20) << "nor would the budget allow all of them to be open";
  EXPECT_EQ(ids(tied, 12, 12), (Ids{0})) << "the first";
  EXPECT_EQ(ids(apart, 12, 12), (Ids{1})) << "the nearer";
  EXPECT_LT(ambiguous(again), 20);
  EXPECT_LT(again.predicted_ambiguous, 20);
  EXPECT_EQ(ids(again, 12, 12), (Ids{0})) << "the first";
  EXPECT_GE(ambiguous(open), kCovered);
  EXPECT_GE(open.predicted_ambiguous, kCovered);
}

// An edge 0.8 pixels below the window, with corners so far away that float may move it by several pixels: the rows that
// it may reach are ambiguous, and predicted.
TEST(Prediction, CountsTheBandsOfEdgesOutsideTheWindow) {
  const auto legal_of = [](double far) {
    Scene scene = flat_scene(16, 16);
    add_triangle(scene, {{{-far, -0.8}, {far, -0.8}, {0, far}}}, 0.5);
    return by_rays(scene);
  };
  const Legal legal = legal_of(1e7), near = legal_of(1e4);
  EXPECT_GE(ambiguous(legal), 16);
  EXPECT_LE(ambiguous(legal), 2 * legal.predicted_ambiguous);
  EXPECT_LE(legal.predicted_ambiguous, 2 * ambiguous(legal));
  EXPECT_EQ(ambiguous(near), 0);
  EXPECT_LT(near.predicted_ambiguous, 0.01);
}

TEST(HandKnown, InsideOutsideAndNearAnEdge) {
  Scene scene = flat_scene(16, 8);
  add_triangle(scene, {{{0, 0}, {8.5 - 0.002, 0}, {8.5 - 0.002, 8}}}, 0.5);  // its right edge: 0.002 short of centres
  const Legal legal = by_rays(scene);
  EXPECT_EQ(ids(legal, 6, 2), (Ids{0}));
  EXPECT_EQ(ids(legal, 8, 2), (Ids{-1, 0}));
  EXPECT_EQ(ids(legal, 9, 2), (Ids{-1}));
  EXPECT_EQ(legal.certain(6, 2), 1u);
  EXPECT_EQ(legal.certain(8, 2), 0u);
  EXPECT_EQ(legal.possible(8, 2), 2u) << "its corners lie on the frame's sides: two pieces of a fan may meet here";
  EXPECT_EQ(legal.possible(9, 2), 0u);
  EXPECT_NEAR(legal.at(6, 2)[0].z_lo, 0.5, 1e-5);
  EXPECT_NEAR(legal.at(6, 2)[0].z_hi, 0.5, 1e-5);

  Scene apart = flat_scene(16, 8);
  add_triangle(apart, {{{0, 0}, {8.5 - 0.004, 0}, {8.5 - 0.004, 8}}}, 0.5);  // beyond sqrt(2)/512 = 0.0028
  EXPECT_EQ(ids(by_rays(apart), 8, 2), (Ids{-1}));
}

TEST(HandKnown, ASharedEdgeShowsEitherSideAndNothingElse) {
  Scene scene = flat_scene(8, 8);
  Mesh mesh;
  const double z = -2;
  for (const glm::dvec2 p : {glm::dvec2(0, 0), glm::dvec2(8, 0), glm::dvec2(8, 8), glm::dvec2(0, 8)}) {
    test::add_vertex(mesh, glm::vec3(p, z), {0, 0, 1}, {1, 1, 1, 1});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};  // the diagonal passes through the centres (i, i)
  scene.meshes = {mesh};
  scene.draws = {test::unlit(0, Cull::back)};
  Legal legal = by_rays(scene);
  EXPECT_EQ(ids(legal, 3, 3), (Ids{0, 1}));
  EXPECT_EQ(legal.certain(3, 3), 1u);
  EXPECT_EQ(legal.possible(3, 3), 4u);
  EXPECT_EQ(ids(legal, 5, 2), (Ids{0}));
  // Folded over the diagonal, both lie on one side of it: a silhouette.
  scene.meshes[0].positions[3] = {8, 0, -2.1f};
  scene.draws[0].cull = Cull::none;
  legal = by_rays(scene);
  EXPECT_EQ(ids(legal, 3, 3).front(), -1);
}

TEST(HandKnown, AVertexOfAFanOnACentreIsCovered) {
  Scene scene = flat_scene(8, 8);
  Mesh mesh;
  test::add_vertex(mesh, {3.5f, 3.5f, -2}, {0, 0, 1}, {1, 1, 1, 1});
  const std::array<glm::vec2, 5> rim{{{7, 4}, {4, 7}, {1, 6}, {1, 1}, {6, 1}}};
  for (const glm::vec2& p : rim) test::add_vertex(mesh, {p, -2}, {0, 0, 1}, {1, 1, 1, 1});
  for (std::uint32_t i = 0; i < 5; ++i) mesh.triangles.push_back({0, i + 1, (i + 1) % 5 + 1});
  scene.meshes = {mesh};
  scene.draws = {test::unlit(0)};
  EXPECT_EQ(ids(by_rays(scene), 3, 3), (Ids{0, 1, 2, 3, 4}));
  scene.meshes[0].triangles.pop_back();
  EXPECT_EQ(ids(by_rays(scene), 3, 3), (Ids{-1, 0, 1, 2, 3}));
}

TEST(HandKnown, NearerWinsAndCoplanarDuplicatesStayOpen) {
  Scene scene = flat_scene(8, 8);
  const std::array<glm::dvec2, 3> all{{{-20, -20}, {40, -20}, {-20, 40}}};
  add_triangle(scene, all, 0.5);
  add_triangle(scene, all, 0.25);
  EXPECT_EQ(ids(by_rays(scene), 4, 4), (Ids{1}));
  add_triangle(scene, all, 0.25);
  EXPECT_EQ(ids(by_rays(scene), 4, 4), (Ids{1, 2}));
  add_triangle(scene, all, 0.75, DepthFunc::always);
  EXPECT_EQ(ids(by_rays(scene), 4, 4), (Ids{3}));
}

TEST(HandKnown, BeforeTheNearPlaneAndBehindTheFarOneIsNothing) {
  Scene scene = flat_scene(8, 8);
  const std::array<glm::dvec2, 3> all{{{-20, -20}, {40, -20}, {-20, 40}}};
  add_triangle(scene, all, -0.01);
  add_triangle(scene, all, 1.01);
  EXPECT_EQ(ids(by_rays(scene), 4, 4), (Ids{-1}));
  add_triangle(scene, all, 0);  // on the plane itself
  EXPECT_EQ(ids(by_rays(scene), 4, 4), (Ids{-1, 2}));
}

TEST(HandKnown, AReportedWinnerThatIsNotThereIsOutsideTheSet) {
  const Scene scene = test::sphere_scene(96, 96, 12, 18, Cull::back);
  const Legal legal = by_rays(scene);
  const Capture capture = embree::make_embree()->capture(scene, Request{});
  long right = 0, caught = 0;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      const std::int32_t id = capture.planes.id(x, y);
      if (id == kBackground) continue;
      const Ids legal_ids = ids(legal, x, y);
      right += std::count(legal_ids.begin(), legal_ids.end(), id);
      caught += std::count(legal_ids.begin(), legal_ids.end(), id ^ 1) == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(right, 3000);
  EXPECT_GT(caught, right * 99 / 100);  // but on the edge that the two share
}

TEST(Displacement, GrowsWithThePositionsSize) {
  Scene near = test::sphere_scene(64, 64, 4, 6, Cull::none);
  near.draws[0].transforms.clear();
  Scene far = near;
  for (glm::vec3& p : far.meshes[0].positions) p.x += 1e5f;  // in the mesh: matrices' offsets cancel in double
  far.camera.eye.x += 1e5;
  far.camera.center.x += 1e5;
  const double a = math::project(near).triangles[10].reach, b = math::project(far).triangles[10].reach;
  EXPECT_LT(a, 0.003);
  EXPECT_GT(b, 1);
}

TEST(Budget, TooManyPairsAreAnErrorInWords) {
  const Scene scene = test::sphere_scene(256, 256, 40, 60, Cull::none);
  Request request;
  request.legal = true;
  constexpr std::size_t kPair = sizeof(math::Candidate) + sizeof(std::uint32_t), kPlenty = std::size_t{1} << 40;
  const std::size_t fixed = kPlenty - kPair * math::candidate_budget(scene, kPlenty);
  request.memory_budget = fixed + 10000 * kPair;  // the sphere covers more pixels than that
  EXPECT_THROW(embree::make_embree()->capture(scene, request), OverBudget);
  EXPECT_THROW(math::legal_by_boxes(scene, request), OverBudget);
  request.memory_budget = 1 << 20;
  EXPECT_THROW(math::legal_by_boxes(scene, request), OverBudget);
}

}  // namespace
}  // namespace plumbline
