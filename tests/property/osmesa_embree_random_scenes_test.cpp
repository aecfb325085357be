// Random scenes against all references: whatever is drawn, nothing is different.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include "tests/extent.h"
#include "tests/property/random_scene.h"
#include "tests/property/scene_text.h"
#include "tests/property/scene_trial.h"

namespace plumbline {
namespace {

constexpr std::uint64_t kRandomSeeds = 20000;

// As rapidcheck would draw it in a property; the same for the same seed.
Scene random_scene(std::uint64_t seed) {
  return rc::gen::exec([] { return test::random_scene(); })(rc::Random(seed), rc::kNominalSize).value();
}

TEST(RandomScenes, HoldAgainstAllReferences) {
  for (std::uint64_t seed = 1; seed <= kRandomSeeds; seed += one_of(200)) {
    const Scene scene = random_scene(seed);
    const auto file = test::findings_folder() / "random" / fmt::format("{:05}.json", seed);
    test::expect_holds(scene, seed, file, test::scene_text(scene, fmt::format("Random scene {}.", seed)));
  }
}

// A finding's file is the scene, up to what the format refuses: triangles of no area, coordinates beyond 1e6.
TEST(RandomScenes, AreWrittenAsTheyAre) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("plumb-random-{}", getpid());
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Scene scene = random_scene(seed);
    for (Mesh& mesh : scene.meshes) {
      for (glm::vec3& p : mesh.positions) p = glm::clamp(p, -1e6f, 1e6f);
      std::erase_if(mesh.triangles, [](glm::uvec3 t) { return t.x == t.y || t.y == t.z || t.z == t.x; });
      if (mesh.triangles.empty()) mesh.triangles = {{0, 1, 2}};
    }
    test::write_text(folder / "scene.json", test::scene_text(scene, "Random."));
    const Scene read = load_scene(folder / "scene.json");
    const Capture a = pipeline::make_pipeline()->capture(scene, {}), b = pipeline::make_pipeline()->capture(read, {});
    EXPECT_EQ(a.planes.color.values(), b.planes.color.values()) << seed;
    EXPECT_EQ(a.planes.depth.values(), b.planes.depth.values()) << seed;
  }
  std::filesystem::remove_all(folder);
}

RC_GTEST_PROP(RandomScenes, AntialiasedHoldAgainstAllReferences, ()) {
  if (*test::evenly(0, 8) != 0) return;  // one in eight: each is drawn up to six times, by Mesa with code made anew
  Scene scene = test::random_scene();
  scene.frame.antialias = *rc::gen::weightedElement<Antialias>({{3, {Antialias::Kind::multisample, 1}},
                                                                {1, {Antialias::Kind::supersample, 3}},
                                                                {1, {Antialias::Kind::taps, 1}}});
  const std::string failed = test::failures(test::judge_by_all(scene));
  if (!failed.empty()) RC_FAIL(failed);
}

bool finite(const glm::vec4& v) { return std::isfinite(v.x + v.y + v.z + v.w); }

RC_GTEST_PROP(RandomScenes, OfNumbersOfAnySizeLeaveNoNaN, ()) {
  const Scene scene = test::random_scene(test::any_float());
  for (const auto& renderer : {pipeline::make_pipeline(), exact::make_exact()}) {
    const Capture drawn = renderer->capture(scene, {});
    for (const glm::vec4& c : drawn.planes.color.values()) RC_ASSERT(finite(c));
    for (double z : drawn.planes.depth.values()) RC_ASSERT(z >= 0 && z <= 1);
  }
}

// The references may decline such scenes; none may crash or hang.
RC_GTEST_PROP(RandomScenes, OfNumbersOfAnySizeAreJudged, ()) {
  const Scene scene = test::random_scene(test::any_float());
  for (const check::Comparison& c : test::judge_by_all(scene).comparisons) {
    if (c.outcome == check::Outcome::failed) RC_FAIL(title_of(c.judge) + ": " + c.note);
  }
}

}  // namespace
}  // namespace plumbline
