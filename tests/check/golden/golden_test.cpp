// Goldens: what their hashes see, what is told from what, who may vouch, and that an update happens in one moment.
#include "check/golden/golden.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>
#include <chrono>
#include <cmath>
#include <random>
#include <set>

#include "base/atomic_path.h"
#include "base/temporary_path.h"
#include "capture/files/image_file.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

namespace fs = std::filesystem;

const fs::path kGoldens = PLUMBLINE_SOURCE_DIR "/golden";

class Goldens : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = temporary_files() / fmt::format("plumb-golden-{}-{}", ::getpid(),
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "golden");
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Writes what is drawn as the scene's golden.
  void bless(const Scene& scene, const Fingerprint& drawn) {
    GoldenSet set(folder_ / "golden", GoldenSet::Access::update);
    std::map<std::string, std::string> files;
    GoldenManifest next = set.manifest();
    next.versions["00000000"] = {};
    const std::map<std::string, std::string> versions = {{"ours", "1"}};
    next.versions[key_of(versions)] = versions;
    Golden golden = make_golden(scene, drawn, files);
    golden.producer = "ours 1";
    golden.versions = key_of(versions);
    next.scenes[scene.name] = golden;
    set.write(next, files);
  }
  GoldenDifference compare(const Scene& scene) {
    return compare_golden(scene, *ours_, GoldenSet(folder_ / "golden", GoldenSet::Access::read));
  }

  fs::path folder_;
  std::unique_ptr<Renderer> ours_ = pipeline::make_pipeline();
};

TEST(golden_hash, EveryBitCounts) {
  const auto of = [](float value) {
    Hasher hasher;
    hasher.add_value(value);
    return hasher.done();
  };
  EXPECT_EQ(of(1.0f), of(1.0f));
  EXPECT_NE(of(0.0f), of(-0.0f));
  EXPECT_NE(of(NAN), of(-NAN));
  EXPECT_NE(of(1.0f), of(std::nextafter(1.0f, 2.0f)));
  // Of the file format's documentation: XXH3, 128 bits, of nothing.
  EXPECT_EQ(to_string(hash_of("")), "99aa06d3014798d86001c324468d497f");
}

TEST(golden_hash, TextIs32DigitsAndNothingElse) {
  const Hash hash = hash_of("plumbline");
  EXPECT_EQ(parse_hash(to_string(hash)), hash);
  for (const char* bad : {"", "0", "99aa06d3014798d86001c324468d497", "99aa06d3014798d86001c324468d497f0",
                          "99AA06D3014798D86001C324468D497F", "99aa06d3014798d8-001c324468d497f"}) {
    EXPECT_FALSE(parse_hash(bad)) << bad;
  }
}

TEST_F(Goldens, SceneHashSeesTheFileWhatItIncludesMeshesAndTexels) {
  const auto write = [&](const std::string& name, const std::string& text) { write_file(folder_ / name, text); };
  const auto hash = [&] { return scene_hash(load_scene(folder_ / "a.json")); };
  write("a.json", R"({"include": ["b.part.json"], "description": "d", "textures": {"t": {"image": {"file": "t.png"}}},
                      "draws": [{"mesh": {"file": "m.obj"}}]})");
  write("b.part.json", R"({"frame": {"width": 8, "height": 8}})");
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("t.png", encode_png("t.png", Plane<glm::vec4>(2, 2, glm::vec4(0.5f))));
  std::set<std::string> hashes = {to_string(hash())};
  EXPECT_EQ(hashes, std::set{to_string(hash())}) << "twice the same";
  write("b.part.json", R"({"frame": {"width": 8, "height": 9}})");
  EXPECT_TRUE(hashes.insert(to_string(hash())).second) << "an included part";
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1.0000001 0\nf 1 2 3\n");
  EXPECT_TRUE(hashes.insert(to_string(hash())).second) << "a vertex";
  write("t.png", encode_png("t.png", Plane<glm::vec4>(2, 2, glm::vec4(0.5f, 0.5f, 0.5f, 0.51f))));
  EXPECT_TRUE(hashes.insert(to_string(hash())).second) << "a texel";
  write("a.json", R"({"include": ["b.part.json"], "description": "e", "textures": {"t": {"image": {"file": "t.png"}}},
                      "draws": [{"mesh": {"file": "m.obj"}}]})");
  EXPECT_TRUE(hashes.insert(to_string(hash())).second) << "the description";
}

// One scene of each pair of formats that the suite has.
TEST_F(Goldens, FilesHoldEveryFormatWithoutLoss) {
  std::set<std::string> seen;
  for (const fs::path& file : suite_files()) {
    if (file.parent_path().stem() == "models") continue;
    const Scene scene = load_scene(file);
    if (!seen.insert(std::string(name_of(scene.frame.color))).second &&
        !seen.insert(std::string(name_of(scene.frame.depth))).second)
      continue;
    bless(scene, fingerprint(scene, *ours_));
    const GoldenDifference d = compare(scene);
    EXPECT_FALSE(d.any()) << scene.name << "\n" << describe(d);
    EXPECT_EQ(d.color.items, d.drawn.color.size());
  }
  EXPECT_EQ(seen, (std::set<std::string>{"rgba8", "rgba12", "rgba16", "rgba32f", "z8", "z16", "z24", "z32f"}));
}

TEST_F(Goldens, ImagesOfOtherChannelsOrNumbersAreRefused) {
  const auto stored = [&](const std::string& name, const std::string& bytes) {
    write_file(folder_ / name, bytes);
    return read_stored(folder_ / name);
  };
  const Plane<glm::vec4> grey(2, 2, glm::vec4(0.5f));
  const StoredImage codes = stored("a.png", encode_png("a.png", grey));
  const StoredImage depth = stored("z.exr", encode_depth_codes("z.exr", Plane<double>(2, 2, 1), DepthFormat::z16));
  EXPECT_EQ(frame_color("a.png", codes, ColorFormat::rgba8)(0, 0).r, 128.0f / 255.0f);
  EXPECT_EQ(frame_depth("z.exr", depth, DepthFormat::z16)(0, 0), 1.0);
  EXPECT_THROW(frame_color("a.png", codes, ColorFormat::rgba16), ImageError);
  EXPECT_THROW(frame_color("a.png", codes, ColorFormat::rgba32f), ImageError);
  EXPECT_THROW(frame_color("z.exr", depth, ColorFormat::rgba32f), ImageError);
  EXPECT_THROW(frame_depth("a.png", codes, DepthFormat::z16), ImageError);
}

TEST_F(Goldens, ALastBitOfColourOfDepthOrOfAStageIsTold) {
  for (const char* name : {"cull/both_windings.json", "frame/rgba16.json", "frame/one_pixel_float.json"}) {
    const Scene scene = load_scene(suite_folder() / name);
    const Fingerprint drawn = fingerprint(scene, *ours_);

    Fingerprint color = drawn;
    const double scale = color_scale(scene.frame.color);
    const int x = scene.frame.width / 2;
    float& value = color.color(x, 0).g;
    value = scale > 0 ? (std::round(value * static_cast<float>(scale)) + 1) / static_cast<float>(scale)
                      : std::nextafter(value, 2.0f);
    bless(scene, color);
    const GoldenDifference c = compare(scene);
    EXPECT_EQ(c.color.differing, 1u) << name;
    EXPECT_EQ(to_string(c.color.worst.place), fmt::format("pixel {},0 g", x));
    EXPECT_EQ(c.depth.differing, 0u);
    EXPECT_NE(describe(c).find("1 of"), std::string::npos) << describe(c);

    Fingerprint depth = drawn;
    const double steps = depth_scale(scene.frame.depth);
    double& z = depth.depth(x, 0);
    z = steps > 0 ? (std::round(z * steps) - 1) / steps
                  : static_cast<double>(std::nextafter(static_cast<float>(z), -1.f));
    bless(scene, depth);
    EXPECT_EQ(compare(scene).depth.differing, 1u) << name;
    EXPECT_EQ(compare(scene).color.differing, 0u);

    Fingerprint stage = drawn;
    stage.stages[static_cast<std::size_t>(Stage::window)]->low ^= 1;
    bless(scene, stage);
    EXPECT_EQ(compare(scene).stages, std::vector{Stage::window});
    EXPECT_NE(describe(compare(scene)).find("first stage that differs: window"), std::string::npos);
    const auto rows = golden_rows(scene, *ours_, GoldenSet(folder_ / "golden", GoldenSet::Access::read));
    for (const Comparison& row : rows) {
      EXPECT_EQ(row.outcome, row.stage == Stage::window ? Outcome::different : Outcome::equal) << name_of(row.stage);
    }
  }
}

class Broken : public Renderer {
 public:
  RendererInfo info() const override { return {"broken", "1", {}, false}; }
  Capture capture(const Scene&, const Request&) override { throw RendererFailed("it fell over"); }
};

TEST_F(Goldens, ARendererThatFailsIsADifferenceNotTheEnd) {
  const Scene scene = suite_scene("cull/both_windings");
  bless(scene, fingerprint(scene, *ours_));
  Broken broken;
  const GoldenSet set(folder_ / "golden", GoldenSet::Access::read);
  EXPECT_EQ(compare_golden(scene, broken, set).why, "broken failed: it fell over");
  const auto rows = golden_rows(scene, broken, set);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].outcome, Outcome::failed);
}

// Its stages are right; what it draws when nobody watches them is not.
class OtherwiseUnwatched : public Renderer {
 public:
  RendererInfo info() const override { return ours_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    Capture out = ours_->capture(scene, request);
    if (request.planes == WantedPlanes::picture) out.planes.color(1, 0).r += 1.0f / 255.0f;
    return out;
  }

 private:
  std::unique_ptr<Renderer> ours_ = pipeline::make_pipeline();
};

TEST_F(Goldens, ThePictureIsTheOneThatIsDrawnUnwatched) {
  for (const char* name : {"clip/behind_eye.json", "antialias/samples_cut.json"}) {
    const Scene scene = load_scene(suite_folder() / name, {});
    bless(scene, fingerprint(scene, *ours_));
    OtherwiseUnwatched renderer;
    const GoldenSet set(folder_ / "golden", GoldenSet::Access::read);
    const GoldenDifference d = compare_golden(scene, renderer, set);
    EXPECT_TRUE(d.stages.empty()) << name;
    EXPECT_EQ(d.color.differing, 1u) << name;
    EXPECT_NE(describe(d).find("drawn with nothing watched, differs"), std::string::npos) << describe(d);
    EXPECT_EQ(golden_rows(scene, renderer, set).back().outcome, Outcome::different) << name;
    EXPECT_EQ(describe(compare(scene)).find("nothing watched"), std::string::npos) << name;
  }
}

TEST_F(Goldens, TheGoldenIsNoJudge) {
  SceneVerdict verdict{"group/scene", "", {judged("group/scene", {"golden", Kind::golden}, Stage::light, {})}, 0};
  EXPECT_EQ(std::ranges::count(unjudged_stages(verdict), Stage::light), 1);
  verdict.comparisons.push_back(judged("group/scene", "exact", Stage::light, {}));
  EXPECT_EQ(std::ranges::count(unjudged_stages(verdict), Stage::light), 0);
}

TEST_F(Goldens, MinusZeroIsNotZero) {
  Scene scene = suite_scene("cull/both_windings");
  scene.frame.color = ColorFormat::rgba32f;
  Fingerprint drawn = fingerprint(scene, *ours_);
  float& black = drawn.color(0, 0).r;
  ASSERT_EQ(black, 0.0f);
  black = -0.0f;
  bless(scene, drawn);
  EXPECT_EQ(compare(scene).color.differing, 1u);
}

// A row for each of three references and each stage, all of them agreeing.
SceneVerdict agreeing() {
  SceneVerdict out{"group/scene", "", {}, 0};
  for (const JudgeId& judge : {JudgeId("osmesa"), JudgeId("embree"), JudgeId("exact", Kind::per_stage)}) {
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      const auto stage = static_cast<Stage>(i);
      if (stage != Stage::texture && stage != Stage::resolve)
        out.comparisons.push_back(judged("group/scene", judge, stage, {}));
    }
  }
  return out;
}

TEST_F(Goldens, ASetBeginsInAnEmptyFolderAndLeavesOtherSetsAlone) {
  const Scene scene = suite_scene("cull/both_windings");
  const Fingerprint drawn = fingerprint(scene, *ours_);
  bless(scene, drawn);
  const auto files = [&] {
    std::set<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) out.insert(entry.path().string());
    return out;
  };
  const std::set<std::string> before = files();
  EXPECT_THROW(GoldenSet(folder_, GoldenSet::Access::update), GoldenError) << "it holds a folder";
  fs::rename(folder_ / "golden/manifest.json", folder_ / "kept");
  EXPECT_THROW(GoldenSet(folder_ / "golden", GoldenSet::Access::update), GoldenError) << "it has lost its manifest";
  fs::rename(folder_ / "kept", folder_ / "golden/manifest.json");
  EXPECT_EQ(files(), before);
  fs::copy(folder_ / "golden", folder_ / "inner", fs::copy_options::recursive);
  fs::rename(folder_ / "inner", folder_ / "golden/inner");
  bless(scene, drawn);
  EXPECT_TRUE(GoldenSet(folder_ / "golden/inner", GoldenSet::Access::read).strays().leftovers.empty());
  EXPECT_FALSE(compare_golden(scene, *ours_, GoldenSet(folder_ / "golden/inner", GoldenSet::Access::read)).any());
}

TEST_F(Goldens, ANameThatCouldNotBeReadIsNotWritten) {
  Scene scene = suite_scene("cull/both_windings");
  const Fingerprint drawn = fingerprint(scene, *ours_);
  for (const char* name : {"group/.", "group/..", "../scene", "/scene", "", "group//scene"}) {
    scene.name = name;
    EXPECT_THROW(bless(scene, drawn), GoldenError) << name;
    EXPECT_TRUE(fs::is_empty(folder_ / "golden")) << name;
  }
}

TEST(golden_vouch, ThreeReferencesThatAgreeVouchAndNothingLess) {
  const std::vector<std::string> asked = {"osmesa", "embree", "exact"};
  const Vouch all = vouch(agreeing(), "ours", asked);
  EXPECT_TRUE(all.refusals.empty());
  EXPECT_EQ(all.by, asked);
  EXPECT_EQ(all.references.at("embree").at("equal"),
            "matrices vertex light clip window coverage depth attributes shade visibility merge");

  EXPECT_FALSE(vouch(agreeing(), "ours", std::vector<std::string>{"osmesa", "exact"}).refusals.empty());
  EXPECT_FALSE(vouch(agreeing(), "ours", std::vector<std::string>{"osmesa", "exact", "exact"}).refusals.empty());
  EXPECT_FALSE(vouch(agreeing(), "ours", std::vector<std::string>{"osmesa", "ours", "exact"}).refusals.empty());
  EXPECT_FALSE(vouch(agreeing(), "embree", asked).refusals.empty()) << "the code under test cannot vouch for itself";
}

TEST(golden_vouch, AnyFailureRefusesAndSaysWhy) {
  const std::vector<std::string> asked = {"osmesa", "embree", "exact"};
  for (const Outcome outcome : {Outcome::different, Outcome::missing, Outcome::failed}) {
    SceneVerdict verdict = agreeing();
    verdict.comparisons[5].outcome = outcome;
    const Vouch v = vouch(verdict, "ours", asked);
    ASSERT_EQ(v.refusals.size(), 1u) << name_of(outcome);
    EXPECT_EQ(v.by, (std::vector<std::string>{"embree", "exact"}));
    EXPECT_TRUE(v.refusals[0].starts_with(fmt::format("osmesa, coverage: {}", name_of(outcome)))) << v.refusals[0];
  }
}

TEST(golden_vouch, AStageThatNobodyJudgesOrThatIsOnlyDisputedRefuses) {
  const std::vector<std::string> asked = {"osmesa", "embree", "exact"};
  for (const Outcome outcome : {Outcome::unsupported, Outcome::dispute}) {
    SceneVerdict verdict = agreeing();
    for (Comparison& c : verdict.comparisons) {
      if (c.stage == Stage::depth) c.outcome = outcome;
    }
    const Vouch v = vouch(verdict, "ours", asked);
    ASSERT_EQ(v.refusals.size(), 1u);
    EXPECT_TRUE(v.refusals[0].starts_with("depth: nobody")) << v.refusals[0];
    verdict.comparisons[6] = judged("group/scene", "osmesa", Stage::depth, {});
    EXPECT_TRUE(vouch(verdict, "ours", asked).refusals.empty()) << "one agrees";
  }
  SceneVerdict verdict = agreeing();
  std::erase_if(verdict.comparisons, [](const Comparison& c) { return c.stage == Stage::light; });
  EXPECT_EQ(vouch(verdict, "ours", asked).refusals, std::vector<std::string>{"light: nobody judges it"});
}

TEST(golden_vouch, DisputesAreListed) {
  SceneVerdict verdict = agreeing();
  verdict.comparisons[10].outcome = Outcome::dispute;
  Measurement& m = verdict.comparisons[10].measurement;
  m.items = 96;
  m.disputed = 3;
  m.reason = "why";
  EXPECT_EQ(vouch(verdict, "ours", std::vector<std::string>{"osmesa", "embree", "exact"}).disputed,
            std::vector<std::string>{"osmesa, merge: 3 of 96: why"});
}

TEST(golden_folder, HasAGoldenForEachSceneAndNothingElseUnder20MiB) {
  const GoldenSet set(kGoldens, GoldenSet::Access::read);
  std::set<std::string> scenes, goldens;
  for (const fs::path& file : suite_files())
    scenes.insert((file.parent_path().filename() / file.stem()).generic_string());
  for (const auto& [name, golden] : set.manifest().scenes) goldens.insert(name);
  EXPECT_EQ(goldens, scenes) << "scripts/regenerate_goldens";
  EXPECT_EQ(set.strays().others, std::vector<std::string>{});
  EXPECT_EQ(set.strays().leftovers, std::vector<std::string>{});
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kGoldens)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  EXPECT_LT(bytes, std::uintmax_t{20} << 20);
  for (const auto& [name, golden] : set.manifest().scenes) {
    EXPECT_EQ(std::ranges::count(golden.vouched, "exact"), 1) << name;
    EXPECT_EQ(std::ranges::count(golden.vouched, "ours"), 0) << name;
    for (const auto& [reference, outcomes] : golden.references) {
      for (const char* failure : {"different", "failed", "missing"}) EXPECT_FALSE(outcomes.contains(failure)) << name;
    }
  }
}

}  // namespace
}  // namespace plumbline::check
